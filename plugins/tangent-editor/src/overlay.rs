//! What the editor draws over the garment.

use amc_core::direction::comb;
use amc_core::mesh::{Garment, SurfacePlace};
use egui::{Painter, Shape, Stroke};
use glam::{Vec2, Vec3};
use studio_plugin::{Context, ViewportView};

use crate::comb::{Chosen, Finder, marks};
use crate::grain;
use crate::grain::arrow::{self, Arrow, TIP};
use crate::pattern::head;
use crate::sheet::{Piece, Sheet};

/// Points along an arrow.
const POINTS: usize = 13;
/// Points of a stroke on the garment.
const LINE_POINTS: usize = 32;
/// What lies on top of a panel, as a pocket or a placket does, is no farther above it than this, metres.
const LAYER: f32 = 0.015;
/// Length of its head, points.
const HEAD: f32 = 10.0;

/// The grain of the panels that are picked or under the pointer, as arrows that lie on the cloth.
pub(crate) fn arrows(
    painter: &Painter,
    view: &ViewportView<'_>,
    sheet: &Sheet,
    held: &mut Option<Arrow>,
    studio: &mut Context<'_>,
) {
    for piece in &sheet.pieces {
        let panel = sheet.panel(piece);
        let is_hovered = studio.selection.hovered.as_ref() == Some(&panel.id);
        let is_picked = studio.selection.panels.contains(&panel.id);
        if view.hidden.contains(&piece.panel) || !(is_hovered || is_picked) {
            continue;
        }
        let along = grain::direction(panel, studio.document.project()).on_cloth(piece.uv_to_sheet.matrix2);
        let line = line(&sheet.garment, piece, along);
        let seen: Vec<egui::Pos2> = line
            .iter()
            .filter_map(|place| is_seen(&sheet.garment, place.position(&sheet.garment), view))
            .collect();
        // Only whole arrows: one that goes round the body is seen from one side.
        if seen.len() < line.len() || seen.len() < 2 {
            continue;
        }
        let visuals = painter.ctx().global_style().visuals.clone();
        let (tip, before) = (seen[seen.len() - 1], seen[seen.len() - 2]);
        let way = (tip - before).normalized();
        for (width, color) in [(4.5, visuals.extreme_bg_color), (2.0, visuals.selection.bg_fill)] {
            painter.line(seen.clone(), Stroke::new(width, color));
            painter.add(Shape::convex_polygon(
                head(tip + way * 2.0, way, HEAD).to_vec(),
                color,
                Stroke::NONE,
            ));
        }
        if is_picked {
            drag_tip(painter.ctx(), view, tip, (sheet, piece), held, studio);
        }
    }
}

/// Lets the hand take the tip of an arrow. It is above the garment, which is turned beside it.
fn drag_tip(
    ctx: &egui::Context,
    view: &ViewportView<'_>,
    tip: egui::Pos2,
    (sheet, piece): (&Sheet, &Piece),
    held: &mut Option<Arrow>,
    studio: &mut Context<'_>,
) {
    let area = egui::Area::new(egui::Id::unique(("grain on the garment", piece.panel)));
    let area = area.order(egui::Order::Middle).fixed_pos(tip - egui::Vec2::splat(TIP)).constrain(false);
    let shown = area
        .movable(false)
        .show(ctx, |ui| ui.allocate_response(egui::Vec2::splat(2.0 * TIP), egui::Sense::drag()));
    let at = || on_sheet(view, ctx.pointer_interact_pos()?, sheet, piece);
    arrow::drag(held, &shown.inner, at, (sheet, piece), studio);
}

/// The place of the sheet at a point of the window: on the panel, and beside it on the plane that touches the panel at the middle of
/// its arrow.
fn on_sheet(view: &ViewportView<'_>, at: egui::Pos2, sheet: &Sheet, piece: &Piece) -> Option<Vec2> {
    let garment = &*sheet.garment;
    let on_panel =
        place_at(view, at, garment).filter(|place| sheet.panel(piece).triangles.contains(&place.triangle));
    let place = on_panel.or_else(|| {
        let uv = piece.uv_to_sheet.inverse().transform_point2(piece.middle);
        let ray = view.ray(at);
        let middle = piece.locator.locate(garment, uv)?;
        SurfacePlace::on_line(garment, middle.triangle, ray.origin, ray.direction)
    })?;
    Some(piece.uv_to_sheet.transform_point2(place.uv(garment)))
}

/// The strokes and singular points of the panels that are picked or under the pointer.
pub(crate) fn strokes(
    painter: &Painter,
    view: &ViewportView<'_>,
    sheet: &Sheet,
    chosen: Option<Chosen>,
    studio: &Context<'_>,
) {
    let selection = &*studio.selection;
    for (panel, of) in sheet.garment.panels.iter().enumerate() {
        let is_meant = selection.hovered.as_ref() == Some(&of.id) || selection.panels.contains(&of.id);
        if is_meant && !view.hidden.contains(&panel) {
            let place = |place: &SurfacePlace| is_seen(&sheet.garment, place.position(&sheet.garment), view);
            let finder = OnGarment { view, sheet };
            marks::paint(painter, &finder, (&sheet.garment, panel), chosen, place, studio);
        }
    }
}

/// Finds strokes on the garment.
pub(crate) struct OnGarment<'a> {
    pub(crate) view: &'a ViewportView<'a>,
    pub(crate) sheet: &'a Sheet,
}

impl Finder for OnGarment<'_> {
    fn place(&self, at: egui::Pos2) -> Option<SurfacePlace> {
        place_at(self.view, at, &self.sheet.garment)
    }

    fn line(&self, panel: usize, stroke: &comb::Stroke) -> Vec<egui::Pos2> {
        let garment = &*self.sheet.garment;
        let seen = |at: Vec3| is_seen(garment, at, self.view);
        match (&stroke.path, self.sheet.piece(panel)) {
            (comb::Path::Pattern(points), Some(piece)) => finer(points)
                .filter_map(|uv| seen(piece.locator.locate(garment, uv)?.position(garment)))
                .collect(),
            (comb::Path::Pattern(_), None) => Vec::new(),
            (comb::Path::Space(points), _) => points.iter().filter_map(|&at| seen(at)).collect(),
        }
    }
}

/// A line with points between its own where they are few: it is bent on the garment.
fn finer(points: &[Vec2]) -> impl Iterator<Item = Vec2> {
    let steps = (LINE_POINTS / points.len().max(1)).max(1);
    let between = move |ends: &[Vec2]| {
        let [from, to] = [ends[0], ends[1]];
        (0..steps).map(move |k| from.lerp(to, k as f32 / steps as f32))
    };
    points.windows(2).flat_map(between).chain(points.last().copied())
}

/// A ring at a place on the garment.
pub(crate) fn mark(painter: &Painter, view: &ViewportView<'_>, garment: &Garment, place: &SurfacePlace) {
    if let Some(at) = view.to_window(place.position(garment)) {
        let visuals = painter.ctx().global_style().visuals.clone();
        painter.circle_stroke(at, 6.0, Stroke::new(4.0, visuals.extreme_bg_color));
        painter.circle_stroke(at, 6.0, Stroke::new(2.0, visuals.selection.bg_fill));
    }
}

/// The place on the garment under the pointer.
pub(crate) fn place_at(view: &ViewportView<'_>, at: egui::Pos2, garment: &Garment) -> Option<SurfacePlace> {
    let ray = view.ray(at);
    let hit = view.picker.hit(ray, |panel| view.hidden.contains(&panel))?;
    SurfacePlace::on_line(garment, hit.triangle, ray.origin, ray.direction)
}

/// The places of a piece's arrow on the garment, as far as they are on the piece.
fn line(garment: &Garment, piece: &Piece, along: Vec2) -> Vec<SurfacePlace> {
    let (to_uvs, half) = (piece.uv_to_sheet.inverse(), piece.half_arrow(along));
    let place = |k: usize| {
        let share = k as f32 / (POINTS - 1) as f32 * 2.0 - 1.0;
        let at = piece.middle + along * (share * half);
        piece.locator.locate(garment, to_uvs.transform_point2(at))
    };
    (0..POINTS).filter_map(place).collect()
}

/// Where a place (object space) is seen in the window; none where something is before it by more than a layer of cloth.
fn is_seen(garment: &Garment, place: Vec3, view: &ViewportView<'_>) -> Option<egui::Pos2> {
    let at = view.to_window(place).filter(|at| view.rect.contains(*at))?;
    let first = place_at(view, at, garment)?.position(garment);
    ((place - first).dot(view.ray(at).direction) <= LAYER).then_some(at)
}
