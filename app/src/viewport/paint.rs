//! What egui paints around the picture, and the colours it gives.

use amc_core::color::linear_from_srgb;
use eframe::egui;

use super::blit::OutlineUniforms;
use super::gestures::Asked;
use super::input_output::ViewportInput;
use super::texts;

/// Widths of the outlines around selected and hovered panels, points.
const OUTLINES: [f32; 2] = [2.0, 1.25];

/// What a screen reader says of the canvas.
pub(super) fn describe(ui: &egui::Ui, response: &egui::Response) {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, ui.is_enabled(), texts::NAME));
    ui.accesskit_node_builder(response.id, |node| node.set_description(texts::DESCRIPTION));
}

/// Text in place of a picture.
pub(super) fn say(ui: &egui::Ui, rect: egui::Rect, backdrop: egui::Color32, text: &str) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, 0.0, backdrop);
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = (rect.width() - 32.0).max(64.0);
    let galley = painter.layout(text.to_owned(), font, ui.visuals().text_color(), width);
    let corner = rect.center() - galley.size() / 2.0;
    painter.galley(corner, galley, ui.visuals().text_color());
}

pub(super) fn paint_rubber_band(ui: &egui::Ui, rect: egui::Rect, asked: Asked) {
    if let Some(band) = asked.rubber_band {
        let stroke = ui.visuals().selection.stroke;
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        painter.rect(band, 0.0, stroke.color.gamma_multiply(0.15), stroke, egui::StrokeKind::Middle);
    }
}

pub(super) fn linear(color: egui::Color32) -> [f32; 3] {
    [color.r(), color.g(), color.b()].map(|value| linear_from_srgb(f32::from(value) / 255.0))
}

pub(super) fn outline(ui: &egui::Ui, input: &ViewportInput<'_>) -> OutlineUniforms {
    let of = |color, points: f32| {
        let [r, g, b] = linear(color);
        [r, g, b, points * ui.pixels_per_point()]
    };
    [of(input.selected_color, OUTLINES[0]), of(input.hovered_color, OUTLINES[1])]
}
