//! How the flat pattern looks.

use std::collections::BTreeSet;

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Visuals};
use glam::Vec2;
use studio_plugin::Context;

use super::camera::Camera;
use super::{PickedLine, Under, direction_on_sheet, head, shown_degrees};
use crate::sheet::{Piece, Sheet};

/// Points of the names.
const TEXT: f32 = 11.0;
/// Length of an arrow's head, points.
const HEAD: f32 = 9.0;
/// Names are left out of pieces smaller than this, points.
const ROOM_FOR_NAME: f32 = 34.0;

/// What is special in this frame.
pub(super) struct Seen<'a> {
    pub(super) under: Under,
    pub(super) picked: Option<&'a PickedLine>,
    /// The first of two points.
    pub(super) first_point: Option<Vec2>,
    /// The place under the pointer in the viewport, on the sheet.
    pub(super) marked: Option<Vec2>,
    /// What is seen over each piece.
    pub(super) over: Vec<Vec<Shape>>,
}

pub(super) fn paint(
    painter: &Painter,
    sheet: &Sheet,
    (camera, pane): (Camera, Rect),
    seen: &Seen<'_>,
    visuals: &Visuals,
    studio: &Context<'_>,
) {
    painter.rect_filled(pane, 0.0, visuals.extreme_bg_color);
    let place = |at: Vec2| camera.to_window(at, pane);
    let hovered = studio.selection.hovered.as_deref();
    let visible = |piece: &&Piece| camera.rect(piece.low, piece.high, pane).intersects(pane);
    for (number, piece) in sheet.pieces.iter().enumerate().filter(|(_, piece)| visible(piece)) {
        let panel = sheet.panel(piece);
        let is_selected = studio.selection.panels.contains(&panel.id);
        let is_hovered = hovered == Some(panel.id.as_str());
        let over = seen.over.get(number).cloned().unwrap_or_default();
        paint_piece(painter, (piece, over), &place, (is_selected, is_hovered), visuals);
    }
    paint_seams(painter, sheet, &place, seen, studio, visuals);
    for piece in sheet.pieces.iter().filter(visible) {
        paint_grain(painter, sheet, piece, (camera, pane), (visuals, !seen.over.is_empty()), studio);
    }
    let accent = visuals.selection.bg_fill;
    if let Some(picked) = seen.picked {
        painter.line(picked.line.iter().map(|&at| place(at)).collect(), Stroke::new(3.0, accent));
    }
    for &at in seen.first_point.iter().chain(seen.picked.iter().flat_map(|it| it.line.first())) {
        painter.circle_filled(place(at), 3.5, accent);
    }
    if let Some((piece, edge)) = seen.under.edge {
        let line = sheet.pieces[piece].edges[edge].line.iter().map(|&at| place(at)).collect();
        painter.line(line, Stroke::new(2.0, visuals.strong_text_color()));
    }
    if let Some(at) = seen.marked {
        painter.circle_stroke(place(at), 5.0, Stroke::new(2.0, accent));
        painter.circle_filled(place(at), 1.5, visuals.strong_text_color());
    }
}

fn paint_piece(
    painter: &Painter,
    (piece, over): (&Piece, Vec<Shape>),
    place: &impl Fn(Vec2) -> Pos2,
    (is_selected, is_hovered): (bool, bool),
    visuals: &Visuals,
) {
    let accent = visuals.selection.bg_fill;
    let cloth = visuals.widgets.inactive.bg_fill;
    let color = match (is_selected, is_hovered) {
        (true, _) => mixed(cloth, accent, 0.45),
        (false, true) => mixed(cloth, accent, 0.2),
        (false, false) => cloth,
    };
    let vertex = |&at: &Vec2| Vertex { pos: place(at), uv: WHITE_UV, color };
    let mesh = Mesh {
        indices: piece.fill.clone(),
        vertices: piece.outlines.iter().flatten().map(vertex).collect(),
        ..Mesh::default()
    };
    painter.add(Shape::mesh(mesh));
    painter.extend(over);
    let line =
        if is_selected { Stroke::new(2.0, accent) } else { Stroke::new(1.0, visuals.weak_text_color()) };
    // Edge by edge: a line that turns back on itself, as at a slit, would have a spike there.
    for edge in &piece.edges {
        painter.line(edge.line.iter().map(|&at| place(at)).collect(), line);
    }
}

/// Both sides of the seams of the piece under the pointer; of one seam, where the pointer is at it.
fn paint_seams(
    painter: &Painter,
    sheet: &Sheet,
    place: &impl Fn(Vec2) -> Pos2,
    seen: &Seen<'_>,
    studio: &Context<'_>,
    visuals: &Visuals,
) {
    let hovered = studio.selection.hovered.as_deref();
    let Some(piece) = sheet.pieces.iter().find(|piece| Some(sheet.panel(piece).id.as_str()) == hovered)
    else {
        return;
    };
    let only = seen
        .under
        .seam
        .filter(|(number, _)| std::ptr::eq(&sheet.pieces[*number], piece))
        .map(|(_, seam)| seam);
    let mut names = BTreeSet::new();
    for (number, seam) in
        piece.seams.iter().enumerate().filter(|(number, _)| only.is_none_or(|only| only == *number))
    {
        let width = if only.is_some() { 3.5 } else { 2.0 };
        let stroke = Stroke::new(width, visuals.hyperlink_color);
        let mut lines = vec![&seam.line];
        let across = sheet.piece(seam.partner).map_or(&[][..], |partner| &partner.seams).iter();
        lines.extend(
            across
                .filter(|other| other.name == seam.name && other.partner == piece.panel)
                .map(|other| &other.line),
        );
        for line in lines {
            painter.line(line.iter().map(|&at| place(at)).collect(), stroke);
        }
        if only == Some(number) && names.insert(&seam.name) {
            let at = seam.line.get(seam.line.len() / 2).map_or(Pos2::ZERO, |&at| place(at));
            let font = FontId::proportional(TEXT);
            let text = painter.layout_no_wrap(seam.name.clone(), font, visuals.strong_text_color());
            let rect = Align2::LEFT_BOTTOM.anchor_size(at + egui::vec2(8.0, -8.0), text.size());
            painter.rect_filled(rect.expand(3.0), 3.0, visuals.panel_fill);
            painter.galley(rect.min, text, visuals.strong_text_color());
        }
    }
}

/// The arrow along the warp, and the piece's name.
fn paint_grain(
    painter: &Painter,
    sheet: &Sheet,
    piece: &Piece,
    (camera, pane): (Camera, Rect),
    (visuals, is_covered): (&Visuals, bool),
    studio: &Context<'_>,
) {
    let along = direction_on_sheet(sheet, piece, studio);
    let color = visuals.strong_text_color();
    let half = piece.half_arrow(along);
    let ends = [-half, half].map(|way| camera.to_window(piece.middle + along * way, pane));
    let way = egui::vec2(along.x, -along.y);
    if is_covered {
        // Over a picture of any tone.
        let (back, behind) = (Stroke::new(4.5, visuals.extreme_bg_color), ends[1] + way * 2.0);
        painter.line_segment([ends[0], ends[1] - way * (0.6 * HEAD)], back);
        painter.add(Shape::convex_polygon(head(behind, way, HEAD + 4.0).to_vec(), back.color, Stroke::NONE));
    }
    painter.line_segment([ends[0], ends[1] - way * (0.6 * HEAD)], Stroke::new(1.5, color));
    painter.add(Shape::convex_polygon(head(ends[1], way, HEAD).to_vec(), color, Stroke::NONE));
    let room = camera.rect(piece.low, piece.high, pane);
    if room.width().min(room.height()) < ROOM_FOR_NAME {
        return;
    }
    let panel = sheet.panel(piece);
    let text = format!(
        "{}  {:.1}\u{b0}",
        studio.document.project().panel_name(panel),
        shown_degrees(sheet, piece, studio)
    );
    let galley = painter.layout_no_wrap(text, FontId::proportional(TEXT), color);
    let at = camera.to_window(piece.middle, pane) + egui::vec2(-galley.size().x / 2.0, 0.0);
    // Beside the arrow, on the side where it does not point.
    let aside = if way.x.abs() > way.y.abs() {
        egui::vec2(0.0, 6.0)
    } else {
        egui::vec2(galley.size().x / 2.0 + 8.0, -galley.size().y / 2.0)
    };
    let rect = Rect::from_min_size(at + aside, galley.size());
    if room.contains_rect(rect) {
        if is_covered {
            painter.rect_filled(rect.expand(2.0), 2.0, visuals.extreme_bg_color.gamma_multiply(0.8));
        }
        painter.galley(rect.min, galley, color);
    }
}

/// Between two colours.
fn mixed(from: Color32, to: Color32, share: f32) -> Color32 {
    from.lerp_to_gamma(to, share)
}
