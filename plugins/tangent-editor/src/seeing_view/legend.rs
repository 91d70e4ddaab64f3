//! What colours and lines mean.

use std::sync::Arc;

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Visuals, pos2, vec2};
use studio_plugin::Selection;

use super::SeeingView;
use crate::seeing::{ColorScale, Seen, Show};
use crate::texts;

/// Points of the text.
const TEXT: f32 = 11.0;
/// The bar of colours, points.
const BAR: egui::Vec2 = vec2(190.0, 10.0);
/// Round the text, and between lines, points.
const GAP: f32 = 6.0;
/// Steps of the bar.
const STEPS: usize = 48;

/// What is said.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Told {
    title: String,
    scale: Option<(ColorScale, Show)>,
    lines: Vec<String>,
}

impl SeeingView {
    /// What the legend says, in one line for who cannot see it.
    pub(crate) fn description(&self) -> Option<String> {
        let (_, told) = self.told.as_ref()?;
        Some(std::iter::once(&told.title).chain(&told.lines).cloned().collect::<Vec<_>>().join(". "))
    }

    /// Paints the legend into the lower left corner of what is seen. The percentiles are those of the selected panels, where any are.
    pub(crate) fn legend(
        &mut self,
        painter: &Painter,
        rect: Rect,
        visuals: &Visuals,
        (garment, selection): (&Arc<amc_core::mesh::Garment>, &Selection),
    ) -> Option<Rect> {
        let seen = Arc::clone(self.seen_of(garment)?);
        let is_told = self.told.as_ref().is_some_and(|(panels, _)| *panels == selection.panels);
        if !is_told {
            self.told = Some((selection.panels.clone(), told(&seen, selection)));
        }
        let (_, told) = self.told.as_ref()?;
        Some(paint(painter, rect, visuals, told))
    }
}

fn told(seen: &Seen, selection: &Selection) -> Told {
    let id = |number: usize| seen.garment.panels.get(number).map(|panel| &panel.id);
    let is_selected = |number: usize| id(number).is_some_and(|id| selection.panels.contains(id));
    let mut lines = Vec::new();
    if let Some(shares) = seen.percentiles(is_selected) {
        let covered =
            (0..seen.panels.len()).filter(|&number| is_selected(number) && seen.panels[number].is_some());
        lines.push(texts::percentiles_of(covered.count()));
        lines.push(texts::percentiles(seen.show, shares));
    }
    let unit = seen.scale.map(|_| texts::unit(seen.show));
    let title = match unit {
        Some(unit) => format!("{}, {unit}", texts::show(seen.show)),
        None => texts::show(seen.show).to_owned(),
    };
    match seen.show {
        Show::Weave => {
            lines.push(texts::weave(&seen.settings.weave));
            let drawn = seen.panels.iter().flatten().map(|panel| panel.enlargement).fold(0.0, f32::max);
            if drawn > seen.settings.weave.enlargement {
                lines.push(texts::drawn_larger(drawn));
            }
        }
        Show::Checker => lines.push(texts::squares(seen.settings.square)),
        Show::WarpStretch | Show::WeftStretch if !seen.has_true_lengths() => {
            lines.push(texts::MEASURED_LENGTHS.to_owned());
        }
        _ => {}
    }
    let without = seen.without_pattern();
    if without > 0 {
        lines.push(texts::without_pattern(without));
    }
    Told { title, scale: seen.scale.map(|scale| (scale, seen.show)), lines }
}

fn paint(painter: &Painter, rect: Rect, visuals: &Visuals, told: &Told) -> Rect {
    let font = FontId::proportional(TEXT);
    let wrap = (rect.width() - 6.0 * GAP).max(80.0);
    let text = |text: &str, color: Color32| painter.layout(text.to_owned(), font.clone(), color, wrap);
    let title = text(&told.title, visuals.strong_text_color());
    let lines: Vec<_> = told.lines.iter().map(|line| text(line, visuals.text_color())).collect();
    let bar =
        if told.scale.is_some() { vec2(BAR.x.min(wrap), BAR.y + TEXT + 2.0 * GAP) } else { egui::Vec2::ZERO };
    let widths = lines.iter().map(|line| line.size().x).fold(title.size().x.max(bar.x), f32::max);
    let height = title.size().y + bar.y + lines.iter().map(|line| line.size().y + 2.0).sum::<f32>();
    let size = vec2(widths, height) + vec2(2.0, 2.0) * GAP;
    let corner = pos2(rect.left() + GAP, rect.bottom() - GAP - size.y);
    let frame = Rect::from_min_size(corner, size);
    painter.rect_filled(frame, 4.0, visuals.panel_fill.gamma_multiply(0.9));
    let mut at = corner + vec2(GAP, GAP);
    let advance = title.size().y;
    painter.galley(at, title, visuals.strong_text_color());
    at.y += advance;
    if let Some((scale, show)) = &told.scale {
        paint_bar(painter, at + vec2(0.0, GAP / 2.0), bar.x, visuals, (scale, *show));
        at.y += bar.y;
    }
    for line in lines {
        let advance = line.size().y + 2.0;
        painter.galley(at, line, visuals.text_color());
        at.y += advance;
    }
    frame
}

/// The colours and the values at their ends and in the middle.
fn paint_bar(
    painter: &Painter,
    corner: Pos2,
    width: f32,
    visuals: &Visuals,
    (scale, show): (&ColorScale, Show),
) {
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let share = step as f32 / STEPS as f32;
        let [r, g, b] =
            scale.color(scale.low + share * (scale.high - scale.low)).map(|it| (it * 255.0).round() as u8);
        let color = Color32::from_rgb(r, g, b);
        for down in [0.0, BAR.y] {
            mesh.vertices.push(Vertex { pos: corner + vec2(share * width, down), uv: WHITE_UV, color });
        }
        if step > 0 {
            let k = 2 * step as u32;
            mesh.indices.extend([k - 2, k - 1, k, k - 1, k, k + 1]);
        }
    }
    painter.add(Shape::mesh(mesh));
    for (share, anchor) in [(0.0, Align2::LEFT_TOP), (0.5, Align2::CENTER_TOP), (1.0, Align2::RIGHT_TOP)] {
        let value = scale.low + share * (scale.high - scale.low);
        let at = corner + vec2(share * width, BAR.y + 1.0);
        painter.text(at, anchor, texts::value(show, value), FontId::proportional(TEXT), visuals.text_color());
    }
}
