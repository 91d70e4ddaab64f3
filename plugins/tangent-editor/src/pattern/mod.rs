//! The flat pattern's pane: pieces, seams, grain, beside the garment and linked with it.

pub(crate) mod camera;
mod paint;

use amc_core::direction::Direction;
use amc_core::direction::comb::{Path, Stroke};
use amc_core::mesh::SurfacePlace;
use egui::{CursorIcon, Rect, Response, Sense, pos2, vec2};
use glam::Vec2;
use studio_plugin::Context;
use studio_plugin::document::Gesture;

use self::camera::Camera;
use crate::comb::{self, Finder, Stylus};
use crate::grain;
use crate::seeing_view::SeeingView;
use crate::sheet::{Piece, Sheet, line};
use crate::texts::{self, comb as comb_texts};

/// How near the pointer must be to an edge or a seam, points.
const REACH: f32 = 7.0;
/// Half the side of what is dragged at an arrow's tip, points.
const TIP: f32 = 9.0;
/// With Shift, grains turn in such steps, radians.
const STEP: f32 = std::f32::consts::PI / 12.0;
/// Within this a dragged grain falls on a line of its piece, radians.
const SNAP: f32 = 0.026;
/// How fast the wheel zooms.
const WHEEL: f32 = 0.004;

/// What the pane remembers from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct PatternPane {
    /// None: the whole is to be shown.
    camera: Option<Camera>,
    dragged: Option<Turn>,
}

/// An arrow in the hand.
#[derive(Debug, Clone, Copy)]
struct Turn {
    panel: usize,
    gesture: Gesture,
}

/// An edge of a piece.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PickedEdge {
    /// The panel's number.
    pub(crate) panel: usize,
    /// Its number among the piece's edges.
    pub(crate) edge: usize,
    /// Along it, on the cloth laid flat as the UVs draw it.
    pub(crate) along: Vec2,
}

/// What is under the pointer.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Under {
    piece: Option<usize>,
    edge: Option<(usize, usize)>,
    seam: Option<(usize, usize)>,
}

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
        (picked_edge, stylus, seeing): (&mut Option<PickedEdge>, &mut Stylus, &mut SeeingView),
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
            seeing.choice(ui);
            if !is_combing {
                ui.weak(texts::SHORT_HELP).on_hover_text(texts::HELP);
            }
        });
        let (pane, background) =
            ui.allocate_exact_size(ui.available_size().max(vec2(40.0, 40.0)), Sense::click_and_drag());
        let mut camera = self.camera.unwrap_or_else(|| Camera::fit(sheet.size, pane.size()));
        let is_combing = studio.holds(comb::TOOL);
        self.move_camera(ui, &mut camera, pane, (&background, is_combing));
        let pointer = ui
            .input(|input| input.pointer.hover_pos())
            .filter(|at| pane.contains(*at) && background.contains_pointer());
        let at = pointer.map(|at| camera.to_sheet(at, pane));
        let under = at.map(|at| under(sheet, at, REACH / camera.scale)).unwrap_or_default();
        let finder = OnSheet { sheet, camera, pane };
        if is_combing {
            stylus.use_in(&background, &finder, sheet, studio);
        } else if background.clicked() {
            *picked_edge = click(ui, sheet, under, studio);
        }
        pick(ui, sheet, (camera, pane), under, studio);
        if !is_combing {
            self.turn_arrows(ui, sheet, (camera, pane), studio);
        }
        let marked_at = marked.and_then(|place| on_sheet(sheet, &place));
        let over = seeing.shapes(ui.ctx(), sheet, (camera, pane));
        let seen = paint::Seen { under, picked_edge: picked_edge.as_ref(), marked: marked_at, over };
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

    fn move_camera(
        &mut self,
        ui: &egui::Ui,
        camera: &mut Camera,
        pane: Rect,
        (background, is_combing): (&Response, bool),
    ) {
        let before = *camera;
        // The left button is the comb's while it is in the hand.
        let is_tool = is_combing && background.dragged_by(egui::PointerButton::Primary);
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
        if background.double_clicked() && !is_combing {
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
            let panel = sheet.panel(piece);
            let along = direction_on_sheet(sheet, piece, studio);
            let tip = camera.to_window(piece.middle + along * piece.half_arrow(along), pane);
            let rect = Rect::from_center_size(tip, vec2(2.0 * TIP, 2.0 * TIP));
            if !pane.contains(rect.center()) {
                continue;
            }
            let response = ui.interact(rect, ui.scope_id().with(("arrow", piece.panel)), Sense::drag());
            response.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Slider, true, texts::arrow(&panel.name))
            });
            if response.hovered() || response.dragged() {
                ui.set_cursor_icon(CursorIcon::Grab);
            }
            if response.drag_started() {
                self.dragged = Some(Turn { panel: piece.panel, gesture: Gesture::begin() });
            }
            let turn = self.dragged.filter(|turn| turn.panel == piece.panel && response.dragged());
            if let (Some(turn), Some(at)) = (turn, response.interact_pointer_pos()) {
                let wanted = (camera.to_sheet(at, pane) - piece.middle).to_angle();
                let wanted = match ui.input(|input| input.modifiers.shift) {
                    true => grain::snap::to_step(wanted, STEP),
                    false => grain::snap::to_lines(wanted, lines(sheet, piece), SNAP),
                };
                let matrix = piece.uv_to_sheet.matrix2;
                let now = grain::direction(panel, studio.document.project());
                let new = Direction::along_cloth(now.source, Vec2::from_angle(wanted), matrix);
                let is_picked = studio.selection.panels.contains(&panel.id);
                let panels =
                    if is_picked { grain::picked(&sheet.garment, studio) } else { vec![piece.panel] };
                let by = new.angle - now.angle;
                if by != 0.0 {
                    grain::turn(&panels, by, Some(turn.gesture), &sheet.garment, studio);
                }
            }
            if response.drag_stopped() {
                self.dragged = None;
            }
        }
    }
}

/// Finds strokes on the sheet.
struct OnSheet<'a> {
    sheet: &'a Sheet,
    camera: Camera,
    pane: Rect,
}

impl Finder for OnSheet<'_> {
    fn place(&self, at: egui::Pos2) -> Option<SurfacePlace> {
        let at = self.camera.to_sheet(at, self.pane);
        let piece = self.sheet.pieces.iter().find(|piece| piece.holds(at))?;
        piece.locator.locate(&self.sheet.garment, piece.uv_to_sheet.inverse().transform_point2(at))
    }

    fn line(&self, panel: usize, stroke: &Stroke) -> Vec<egui::Pos2> {
        match (&stroke.path, self.sheet.piece(panel)) {
            (Path::Pattern(points), Some(piece)) => {
                let place =
                    |&uv: &Vec2| self.camera.to_window(piece.uv_to_sheet.transform_point2(uv), self.pane);
                points.iter().map(place).collect()
            }
            _ => Vec::new(),
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

/// Selects what was clicked; gives the edge that was.
fn click(ui: &egui::Ui, sheet: &Sheet, under: Under, studio: &mut Context<'_>) -> Option<PickedEdge> {
    match under.piece {
        Some(piece) => studio.selection.click(&sheet.panel(&sheet.pieces[piece]).id, adds(ui)),
        None => studio.selection.panels.clear(),
    }
    let (piece, edge) = under.edge?;
    let piece = &sheet.pieces[piece];
    Some(PickedEdge { panel: piece.panel, edge, along: piece.edges[edge].along()? })
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
            egui::WidgetInfo::labeled(egui::Role::Button, true, texts::piece(&panel.name, degrees))
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

/// What a dragged grain falls on: upright, level, the diagonals, the piece's own edges and what its file says.
fn lines(sheet: &Sheet, piece: &Piece) -> Vec<f32> {
    let eighth = std::f32::consts::FRAC_PI_4;
    let mut lines: Vec<f32> = (0..4).map(|k| eighth * k as f32).collect();
    let panel = sheet.panel(piece);
    lines.push(Direction::along_grain(panel).on_cloth(piece.uv_to_sheet.matrix2).to_angle());
    lines.extend(piece.edges.iter().filter_map(|edge| Some(edge.along()?.to_angle())));
    lines
}

/// Where a piece's warp runs on the sheet.
fn direction_on_sheet(sheet: &Sheet, piece: &Piece, studio: &Context<'_>) -> Vec2 {
    grain::direction(sheet.panel(piece), studio.document.project()).on_cloth(piece.uv_to_sheet.matrix2)
}

/// The same as people read it, degrees from 0 to 360.
pub(crate) fn shown_degrees(sheet: &Sheet, piece: &Piece, studio: &Context<'_>) -> f32 {
    let degrees = direction_on_sheet(sheet, piece, studio).to_angle().to_degrees().rem_euclid(360.0);
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
