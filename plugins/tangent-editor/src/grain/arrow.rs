//! The arrow of a piece in the hand, in whichever view.

use amc_core::direction::Direction;
use egui::{CursorIcon, Response};
use glam::Vec2;
use studio_plugin::Context;
use studio_plugin::document::Gesture;

use super::snap;
use crate::sheet::{Piece, Sheet};
use crate::texts;

/// With Shift, grains turn in such steps, radians.
const STEP: f32 = std::f32::consts::PI / 12.0;
/// Within this a dragged grain falls on a line of its piece, radians.
const SNAP: f32 = 0.026;
/// Half the side of what is dragged at an arrow's tip, points.
pub(crate) const TIP: f32 = 9.0;

/// An arrow in the hand.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arrow {
    panel: usize,
    gesture: Gesture,
}

/// Turns the grain of a piece, and of all that are picked with it, after a hand that has the tip of its arrow: `at` is where that
/// is on the sheet.
pub(crate) fn drag(
    held: &mut Option<Arrow>,
    response: &Response,
    at: impl FnOnce() -> Option<Vec2>,
    (sheet, piece): (&Sheet, &Piece),
    studio: &mut Context<'_>,
) {
    let panel = sheet.panel(piece);
    let name = texts::arrow(studio.document.project().panel_name(panel));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, &name));
    if response.hovered() || response.dragged() {
        response.ctx.set_cursor_icon(CursorIcon::Grab);
    }
    if response.drag_started() {
        *held = Some(Arrow { panel: piece.panel, gesture: Gesture::begin() });
    }
    let arrow = held.filter(|arrow| arrow.panel == piece.panel && response.dragged());
    if let Some((arrow, at)) = arrow.and_then(|arrow| Some((arrow, at()?))) {
        let wanted = (at - piece.middle).to_angle();
        let wanted = match response.ctx.input(|input| input.modifiers.shift) {
            true => snap::to_step(wanted - piece.turn, STEP) + piece.turn,
            false => snap::to_lines(wanted, lines(sheet, piece), SNAP),
        };
        let now = super::direction(panel, studio.document.project());
        let new = Direction::along_cloth(now.source, Vec2::from_angle(wanted), piece.uv_to_sheet.matrix2);
        let is_picked = studio.selection.panels.contains(&panel.id);
        let panels = if is_picked { super::picked(&sheet.garment, studio) } else { vec![piece.panel] };
        let by = new.angle - now.angle;
        if by != 0.0 {
            super::turn(&panels, by, Some(arrow.gesture), &sheet.garment, studio);
        }
    }
    if response.drag_stopped() {
        *held = None;
    }
}

/// What a dragged grain falls on: upright, level, the diagonals, the piece's own edges and what its file says.
fn lines(sheet: &Sheet, piece: &Piece) -> Vec<f32> {
    let eighth = std::f32::consts::FRAC_PI_4;
    let mut lines: Vec<f32> = (0..4).map(|k| eighth * k as f32 + piece.turn).collect();
    let panel = sheet.panel(piece);
    lines.push(Direction::along_grain(panel).on_cloth(piece.uv_to_sheet.matrix2).to_angle());
    lines.extend(piece.edges.iter().filter_map(|edge| Some(edge.along()?.to_angle())));
    lines
}
