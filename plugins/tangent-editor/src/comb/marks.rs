//! How strokes and singular points look, in whichever view.

use amc_core::direction::comb::Singularity;
use amc_core::mesh::{Garment, SurfacePlace};
use egui::{Painter, Pos2, Shape, Stroke as Line, Visuals};
use glam::Vec3;
use studio_plugin::Context;

use super::stylus::centre_stroke;
use super::{Chosen, Finder};
use crate::pattern::head;

/// Length of a stroke's head, points.
const HEAD: f32 = 9.0;
/// Half the size of a singular point's mark, points.
const MARK: f32 = 5.0;

/// Paints the strokes of a panel, the point it is combed round, and its singular points.
pub(crate) fn paint(
    painter: &Painter,
    finder: &impl Finder,
    (garment, panel): (&Garment, usize),
    chosen: Option<Chosen>,
    place: impl Fn(&SurfacePlace) -> Option<Pos2>,
    studio: &Context<'_>,
) {
    let visuals = painter.ctx().global_style().visuals.clone();
    let Some(comb) = studio.document.project().comb(&garment.panels[panel].id) else { return };
    for (number, stroke) in comb.strokes.iter().enumerate() {
        let is_chosen = chosen == Some(Chosen { panel, stroke: number });
        paint_stroke(painter, &finder.line(panel, stroke), (is_chosen, stroke.is_on), &visuals);
    }
    for at in centre_stroke(comb).iter().flat_map(|stroke| finder.line(panel, stroke)) {
        painter.circle(at, MARK, visuals.extreme_bg_color, Line::new(2.0, visuals.selection.bg_fill));
    }
    let drawn = studio.stage.directions.as_ref().filter(|drawn| std::ptr::eq(&*drawn.garment, garment));
    let field = drawn.and_then(|drawn| drawn.fields.get(panel)?.as_ref());
    for singularity in field.iter().flat_map(|field| &field.singularities) {
        if let Some(at) = place(&middle(singularity)) {
            paint_singularity(painter, at, singularity.index, &visuals);
        }
    }
}

fn paint_stroke(painter: &Painter, line: &[Pos2], (is_chosen, is_on): (bool, bool), visuals: &Visuals) {
    let [.., before, tip] = line else { return };
    let way = (*tip - *before).normalized();
    let color = match (is_chosen, is_on) {
        (true, _) => visuals.selection.bg_fill,
        (false, true) => visuals.strong_text_color(),
        (false, false) => visuals.weak_text_color(),
    };
    let layers = [(5.0, visuals.extreme_bg_color), (2.5, color)];
    for (width, color) in layers {
        painter.line(line.to_vec(), Line::new(width, color));
    }
    painter.add(Shape::convex_polygon(head(*tip + way * 2.0, way, HEAD).to_vec(), color, Line::NONE));
    if is_chosen {
        for end in [line[0], *tip] {
            painter.circle(end, 3.5, visuals.extreme_bg_color, Line::new(1.5, color));
        }
    }
}

/// A disc where the field turns with the way round, a diamond where it turns against it.
fn paint_singularity(painter: &Painter, at: Pos2, index: f32, visuals: &Visuals) {
    let line = Line::new(1.5, visuals.extreme_bg_color);
    if index > 0.0 {
        painter.circle(at, MARK, visuals.warn_fg_color, line);
    } else {
        let corners = [(0.0, -MARK), (MARK, 0.0), (0.0, MARK), (-MARK, 0.0)];
        let corners = corners.map(|(x, y)| at + egui::vec2(x, y) * 1.2);
        painter.add(Shape::convex_polygon(corners.to_vec(), visuals.error_fg_color, line));
    }
}

/// The middle of a singular triangle.
fn middle(singularity: &Singularity) -> SurfacePlace {
    SurfacePlace { triangle: singularity.triangle, shares: Vec3::splat(1.0 / 3.0) }
}
