//! Splitting panels along a line that the hand draws, or through their middle.

use amc_core::mesh::SurfacePlace;
use egui::{Id, LayerId, Order, PointerButton, Pos2, Response, Stroke};
use glam::Vec2;
use studio_plugin::Context;
use studio_plugin::document::{Edit, Gesture};

use crate::assignments::Assignments;
use crate::comb::{Finder, panel_of};
use crate::grain;
use crate::pattern::PickedLine;
use crate::sheet::Sheet;
use crate::texts;

/// The id of the tool.
pub(crate) const TOOL: &str = "split";

/// Places along the line at which is looked for the panel that it crosses.
const SAMPLES: usize = 64;

/// The hand that draws the line.
#[derive(Debug, Default)]
pub(crate) struct Cutter {
    /// Where it came down.
    from: Option<Pos2>,
}

impl Cutter {
    /// What the left button does in a view.
    pub(crate) fn use_in(
        &mut self,
        response: &Response,
        finder: &impl Finder,
        sheet: &Sheet,
        studio: &mut Context<'_>,
    ) {
        let at = response.interact_pointer_pos();
        if response.drag_started_by(PointerButton::Primary) {
            self.from = response.ctx.input(|input| input.pointer.press_origin()).or(at);
        }
        let Some((from, to)) = self.from.zip(at) else { return };
        if response.dragged_by(PointerButton::Primary) {
            let layer = LayerId::new(Order::Foreground, Id::unique("split"));
            let color = response.ctx.global_style().visuals.strong_text_color();
            let painter = response.ctx.layer_painter(layer).with_clip_rect(response.rect);
            painter.line_segment([from, to], Stroke::new(2.0, color));
        }
        if response.drag_stopped() {
            self.from = None;
            match across(from, to, finder, sheet) {
                Some((panel, through)) => split(sheet, panel, through, studio),
                None => studio.notices.note(texts::NOT_ACROSS),
            }
        }
    }
}

/// The panel that most of the line is on, and where the line comes and goes there.
fn across(from: Pos2, to: Pos2, finder: &impl Finder, sheet: &Sheet) -> Option<(usize, [Vec2; 2])> {
    let places = (0..=SAMPLES).filter_map(|k| finder.place(from.lerp(to, k as f32 / SAMPLES as f32)));
    let on = |place: SurfacePlace| Some((panel_of(&sheet.garment, &place)?, place.uv(&sheet.garment)));
    let found: Vec<(usize, Vec2)> =
        places.filter_map(on).filter(|(panel, _)| sheet.piece(*panel).is_some()).collect();
    let count = |panel: usize| found.iter().filter(|it| it.0 == panel).count();
    let panel = found.iter().map(|it| it.0).max_by_key(|&panel| count(panel))?;
    let mut uvs = found.iter().filter(|it| it.0 == panel).map(|it| it.1);
    let first = uvs.next()?;
    Some((panel, [first, uvs.next_back()?]))
}

/// Splits a panel along its warp or across it, through the middle of its piece.
pub(crate) fn through_middle(sheet: &Sheet, panel: usize, across: bool, studio: &mut Context<'_>) {
    let Some(piece) = sheet.piece(panel) else { return };
    let direction = grain::direction(sheet.panel(piece), studio.document.project());
    let along = direction.on_cloth(piece.uv_to_sheet.matrix2);
    let along = if across { along.perp() } else { along };
    let step = along * 0.01 * (piece.high - piece.low).max_element();
    let back = piece.uv_to_sheet.inverse();
    let through = [piece.middle - step, piece.middle + step].map(|at| back.transform_point2(at));
    split(sheet, panel, through, studio);
}

/// Splits a panel along the straight line through the ends of what was picked on its piece.
pub(crate) fn along(sheet: &Sheet, picked: &PickedLine, studio: &mut Context<'_>) {
    let piece = sheet.piece(picked.panel);
    if let (Some(piece), [from, .., to]) = (piece, &picked.line[..]) {
        let back = piece.uv_to_sheet.inverse();
        let through = [from, to].map(|&at| back.transform_point2(at));
        split(sheet, picked.panel, through, studio);
    }
}

/// Splits a panel along the straight line through two places of its flat pattern.
fn split(sheet: &Sheet, panel: usize, through: [Vec2; 2], studio: &mut Context<'_>) {
    let garment = &*sheet.garment;
    let (panel, project) = (&garment.panels[panel], studio.document.project());
    let Some(line) = garment.line_across(panel, through) else {
        return studio.notices.note(texts::NOT_ACROSS);
    };
    if let Err(why) = garment.check_split(panel, line) {
        return studio.notices.note(texts::not_split(project.panel_name(panel), why));
    }
    let into = project.free_panel_ids(&panel.id, garment);
    if project.print(&panel.id).is_some() {
        studio.notices.note(texts::PRINT_MOVES);
    }
    let gesture = Gesture::begin();
    // The halves are locked, linked and laid as the whole was.
    match Assignments::of(project) {
        Ok(known) => {
            let whole = known.panel(&panel.id);
            let edit =
                known.changed(into.iter().map(String::as_str), texts::SPLIT.to_owned(), |half| *half = whole);
            studio.submit_in(gesture, edit);
        }
        Err(error) => studio.notices.failed(error),
    }
    studio.submit_in(gesture, Edit::SplitPanel { panel: panel.id.clone(), line, into });
}
