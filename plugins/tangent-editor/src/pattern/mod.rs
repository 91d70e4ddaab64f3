//! The flat pattern's pane: pieces, seams, grain, beside the garment and linked with it.

pub(crate) mod camera;
mod on_sheet;
mod paint;
mod picked;

use amc_core::mesh::SurfacePlace;
use egui::{Rect, Response, Sense, pos2, vec2};
use glam::Vec2;
use studio_plugin::Context;

use self::camera::Camera;
use self::on_sheet::OnSheet;
pub(crate) use self::picked::PickedLine;
use crate::comb::{self, Stylus};
use crate::grain;
use crate::grain::arrow::{self, Arrow, TIP};
use crate::seeing_view::SeeingView;
use crate::sheet::{Piece, Sheet, line};
use crate::splitting::{self, Cutter};
use crate::texts::{self, comb as comb_texts};

/// How near the pointer must be to an edge or a seam, points.
const REACH: f32 = 7.0;
/// How fast the wheel zooms.
const WHEEL: f32 = 0.004;

/// What the pane remembers from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct PatternPane {
    /// None: the whole is to be shown.
    camera: Option<Camera>,
    held: Option<Arrow>,
    /// The first of two points, and its panel.
    first_point: Option<(usize, Vec2)>,
}

/// What is under the pointer.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Under {
    piece: Option<usize>,
    edge: Option<(usize, usize)>,
    seam: Option<(usize, usize)>,
}

/// What is worked with in the pane: the edge that was picked, the hand of each tool, what is seen over the pieces.
pub(crate) type Hands<'a> = (&'a mut Option<PickedLine>, &'a mut Stylus, &'a mut Cutter, &'a mut SeeingView);

impl PatternPane {
    /// From the next frame on the whole pattern is shown.
    pub(crate) fn fit(&mut self) {
        self.camera = None;
    }

    /// Draws it; gives the place on the garment under the pointer. `marked`: the place that is under the pointer in the viewport.
    pub(crate) fn show(
        &mut self,
        ui: &mut egui::Ui,
        sheet: &Sheet,
        (picked, stylus, cutter, seeing): Hands<'_>,
        marked: Option<SurfacePlace>,
        studio: &mut Context<'_>,
    ) -> Option<SurfacePlace> {
        ui.horizontal_wrapped(|ui| {
            if ui.button(texts::FIT_BUTTON).on_hover_text(texts::FIT_TIP).clicked() {
                self.fit();
            }
            let is_combing = studio.holds(comb::TOOL);
            let draw = ui.add(egui::Button::new(comb_texts::DRAW).selected(is_combing));
            if draw.on_hover_text(comb_texts::DRAW_TIP).clicked() {
                studio.take(comb::TOOL);
            }
            let split =
                ui.add(egui::Button::new(texts::SPLIT_BUTTON).selected(studio.holds(splitting::TOOL)));
            if split.on_hover_text(texts::SPLIT_TIP).clicked() {
                studio.take(splitting::TOOL);
            }
            seeing.choice(ui);
            if !is_combing {
                ui.weak(texts::SHORT_HELP).on_hover_text(texts::HELP);
            }
        });
        let (pane, background) =
            ui.allocate_exact_size(ui.available_size().max(vec2(40.0, 40.0)), Sense::click_and_drag());
        let mut camera = self.camera.unwrap_or_else(|| Camera::fit(sheet.size, pane.size()));
        let (is_combing, is_splitting) = (studio.holds(comb::TOOL), studio.holds(splitting::TOOL));
        let has_tool = is_combing || is_splitting;
        self.move_camera(ui, &mut camera, pane, (&background, has_tool));
        let pointer = ui
            .input(|input| input.pointer.hover_pos())
            .filter(|at| pane.contains(*at) && background.contains_pointer());
        let at = pointer.map(|at| camera.to_sheet(at, pane));
        let under = at.map(|at| under(sheet, at, REACH / camera.scale)).unwrap_or_default();
        let finder = OnSheet { sheet, camera, pane };
        if is_combing {
            stylus.use_in(&background, &finder, sheet, studio);
        } else if is_splitting {
            cutter.use_in(&background, &finder, sheet, studio);
        } else if background.clicked() {
            self.click((ui, sheet), at, (under, REACH / camera.scale), picked, studio);
        }
        pick(ui, sheet, (camera, pane), under, studio);
        if !has_tool {
            self.turn_arrows(ui, sheet, (camera, pane), studio);
        }
        let marked_at = marked.and_then(|place| on_sheet(sheet, &place));
        let over = seeing.shapes(ui.ctx(), sheet, (camera, pane));
        let seen = paint::Seen {
            under,
            picked: picked.as_ref(),
            first_point: self.first_point.map(|(_, at)| at),
            marked: marked_at,
            over,
        };
        paint::paint(&ui.painter_at(pane), sheet, (camera, pane), &seen, ui.visuals(), studio);
        let place = |place: &SurfacePlace| Some(camera.to_window(on_sheet(sheet, place)?, pane));
        for piece in &sheet.pieces {
            let panel = (&*sheet.garment, piece.panel);
            comb::marks::paint(&ui.painter_at(pane), &finder, panel, stylus.chosen, place, studio);
        }
        explain(ui, pane, sheet, seeing, studio);
        let piece = &sheet.pieces[under.piece?];
        piece.locator.locate(&sheet.garment, piece.uv_to_sheet.inverse().transform_point2(at?))
    }

    /// Selects what was clicked, and picks the edge that was; with Alt, points, two of which make a line.
    fn click(
        &mut self,
        (ui, sheet): (&egui::Ui, &Sheet),
        at: Option<Vec2>,
        (under, reach): (Under, f32),
        picked: &mut Option<PickedLine>,
        studio: &mut Context<'_>,
    ) {
        let first = self.first_point.take();
        let Some(piece) = under.piece.map(|piece| &sheet.pieces[piece]) else {
            *picked = None;
            return studio.selection.panels.clear();
        };
        if let Some(at) = at.filter(|_| ui.input(|input| input.modifiers.alt)) {
            let point = to_corner(piece, at, reach);
            match first.filter(|(panel, _)| *panel == piece.panel) {
                Some((panel, first)) => *picked = PickedLine::between(panel, first, point),
                None => self.first_point = Some((piece.panel, point)),
            }
            return;
        }
        studio.selection.click(&sheet.panel(piece).id, adds(ui));
        *picked = under.edge.and_then(|(_, edge)| PickedLine::edge(sheet, piece.panel, edge));
    }

    fn move_camera(
        &mut self,
        ui: &egui::Ui,
        camera: &mut Camera,
        pane: Rect,
        (background, has_tool): (&Response, bool),
    ) {
        let before = *camera;
        // The left button is the tool's while one is in the hand.
        let is_tool = has_tool && background.dragged_by(egui::PointerButton::Primary);
        if background.dragged() && !is_tool {
            camera.pan(background.drag_delta());
        }
        if let Some(at) = background.hover_pos() {
            let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = pinch * (wheel * WHEEL).exp();
            if factor != 1.0 {
                camera.zoom(factor, at, pane);
            }
        }
        if *camera != before {
            self.camera = Some(*camera);
        }
        if background.double_clicked() && !has_tool {
            self.camera = None;
        }
    }

    /// The tips of the arrows of the panels that are picked or under the pointer can be dragged.
    fn turn_arrows(
        &mut self,
        ui: &egui::Ui,
        sheet: &Sheet,
        (camera, pane): (Camera, Rect),
        studio: &mut Context<'_>,
    ) {
        for piece in &sheet.pieces {
            let along = direction_on_sheet(sheet, piece, studio);
            let tip = camera.to_window(piece.middle + along * piece.half_arrow(along), pane);
            let rect = Rect::from_center_size(tip, vec2(2.0 * TIP, 2.0 * TIP));
            if !pane.contains(rect.center()) {
                continue;
            }
            let response = ui.interact(rect, ui.scope_id().with(("arrow", piece.panel)), Sense::drag());
            let at = || Some(camera.to_sheet(response.interact_pointer_pos()?, pane));
            arrow::drag(&mut self.held, &response, at, (sheet, piece), studio);
        }
    }
}

/// The legend of what is seen over the pieces, also for who cannot see it.
fn explain(ui: &egui::Ui, pane: Rect, sheet: &Sheet, seeing: &mut SeeingView, studio: &Context<'_>) {
    let about = (&sheet.garment, &*studio.selection);
    let legend = seeing.legend(&ui.painter_at(pane), pane, ui.visuals(), about);
    if let (Some(rect), Some(text)) = (legend, seeing.description()) {
        let response = ui.interact(rect, ui.scope_id().with("legend"), Sense::hover());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &text));
    }
}

/// The corner of a piece within `reach` of a point; else the point.
fn to_corner(piece: &Piece, at: Vec2, reach: f32) -> Vec2 {
    let ends = piece.edges.iter().flat_map(|edge| [edge.line.first(), edge.line.last()]).flatten();
    let nearest = ends.min_by(|a, b| a.distance(at).total_cmp(&b.distance(at)));
    nearest.copied().filter(|corner| corner.distance(at) <= reach).unwrap_or(at)
}

/// Whether a click adds to what is selected.
fn adds(ui: &egui::Ui) -> bool {
    ui.input(|input| input.modifiers.command || input.modifiers.shift)
}

/// Hovering, and what takes the place of clicks for the keyboard and for screen readers: a place for each piece, which the
/// pointer does not need.
fn pick(
    ui: &egui::Ui,
    sheet: &Sheet,
    (camera, pane): (Camera, Rect),
    under: Under,
    studio: &mut Context<'_>,
) {
    if let Some(piece) = under.piece {
        studio.selection.hovered = Some(sheet.panel(&sheet.pieces[piece]).id.clone());
    }
    for (number, piece) in sheet.pieces.iter().enumerate() {
        let rect = camera.rect(piece.low, piece.high, pane).intersect(pane);
        if !rect.is_positive() {
            continue;
        }
        let panel = sheet.panel(piece);
        let response =
            ui.interact(rect, ui.scope_id().with(("piece", number)), Sense::focusable_noninteractive());
        let degrees = shown_degrees(sheet, piece, studio);
        response.widget_info(|| {
            egui::WidgetInfo::labeled(
                egui::Role::Button,
                true,
                texts::piece(studio.document.project().panel_name(panel), degrees),
            )
        });
        let has_focus = response.has_focus();
        let asked = ui.input(|input| {
            let by_key = input.key_pressed(egui::Key::Enter) || input.key_pressed(egui::Key::Space);
            input.has_accesskit_action_request(response.id, egui::accesskit::Action::Click)
                || has_focus && by_key
        });
        if asked {
            studio.selection.click(&panel.id, adds(ui));
        }
    }
}

/// Where a piece's warp runs on the sheet.
fn direction_on_sheet(sheet: &Sheet, piece: &Piece, studio: &Context<'_>) -> Vec2 {
    grain::direction(sheet.panel(piece), studio.document.project()).on_cloth(piece.uv_to_sheet.matrix2)
}

/// The same as people read it, degrees from 0 to 360.
pub(crate) fn shown_degrees(sheet: &Sheet, piece: &Piece, studio: &Context<'_>) -> f32 {
    let angle = direction_on_sheet(sheet, piece, studio).to_angle() - piece.turn;
    let degrees = angle.to_degrees().rem_euclid(360.0);
    // What is rounded up to a whole turn is none.
    if degrees > 359.95 { 0.0 } else { degrees }
}

/// A place on the garment, on the sheet.
fn on_sheet(sheet: &Sheet, place: &SurfacePlace) -> Option<Vec2> {
    let holds = |piece: &&Piece| sheet.panel(piece).triangles.contains(&place.triangle);
    let piece = sheet.pieces.iter().find(holds)?;
    Some(piece.uv_to_sheet.transform_point2(place.uv(&sheet.garment)))
}

/// What is at a point of the sheet; edges and seams within `reach`.
fn under(sheet: &Sheet, at: Vec2, reach: f32) -> Under {
    let near = |piece: &&Piece| (piece.low - reach).cmple(at).all() && at.cmple(piece.high + reach).all();
    for (number, piece) in sheet.pieces.iter().enumerate().filter(|(_, piece)| near(piece)) {
        let nearest = |distances: Vec<f32>| {
            let best = distances.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
            (*best.1 <= reach).then_some((number, best.0))
        };
        let edge = nearest(piece.edges.iter().map(|edge| edge.distance(at)).collect());
        let seam = nearest(piece.seams.iter().map(|seam| line::distance(&seam.line, at)).collect());
        if piece.holds(at) || edge.is_some() {
            return Under { piece: Some(number), edge, seam };
        }
    }
    Under::default()
}

/// The corners of an arrow's head at its tip, points.
pub(crate) fn head(tip: egui::Pos2, along: egui::Vec2, size: f32) -> [egui::Pos2; 3] {
    let across = along.rot90();
    [tip, tip - along * size + across * (0.45 * size), tip - along * size - across * (0.45 * size)]
        .map(|at| pos2(at.x, at.y))
}
