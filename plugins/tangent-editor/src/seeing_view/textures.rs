//! Pictures over the flat pieces, as egui draws them.

use std::collections::HashMap;
use std::sync::Arc;

use amc_core::render::{LaidPrint, Print};
use egui::epaint::{Mesh, Vertex};
use egui::{Color32, ColorImage, Rect, Shape, TextureHandle, TextureOptions, pos2};
use glam::{Affine2, Vec2};

use super::SeeingView;
use crate::pattern::camera::Camera;
use crate::seeing::Seen;
use crate::sheet::{Piece, Sheet};

/// Levels of pictures that were shown, by the picture and the level's number.
#[derive(Default)]
pub(super) struct Textures(HashMap<(usize, usize), TextureHandle>);

impl std::fmt::Debug for Textures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.0.keys()).finish()
    }
}

impl Textures {
    /// Lets go of all pictures that are not seen any more.
    pub(super) fn keep_only(&mut self, seen: &Seen) {
        let prints = seen.panels.iter().flatten().map(|panel| &panel.laid.print);
        let known: Vec<usize> = prints.map(key).collect();
        self.0.retain(|(print, _), _| known.contains(print));
    }

    fn get(&mut self, context: &egui::Context, laid: &LaidPrint, number: usize) -> Option<egui::TextureId> {
        let place = (key(&laid.print), number);
        if let Some(known) = self.0.get(&place) {
            return Some(known.id());
        }
        let level = laid.print.levels().get(number)?;
        let pixels = level.texels.iter().map(|&[r, g, b, _]| Color32::from_rgb(r, g, b)).collect();
        let image = ColorImage::new([level.width as usize, level.height as usize], pixels);
        let options = if laid.is_repeated { TextureOptions::LINEAR_REPEAT } else { TextureOptions::LINEAR };
        let handle = context.load_texture("cloth", image, options);
        let id = handle.id();
        self.0.insert(place, handle);
        Some(id)
    }
}

/// A picture's place in memory: as long as it is seen, no other is there.
fn key(print: &Arc<Print>) -> usize {
    Arc::as_ptr(print).addr()
}

impl SeeingView {
    /// What is seen over each piece of the sheet; nothing where nothing is.
    pub(crate) fn shapes(
        &mut self,
        context: &egui::Context,
        sheet: &Sheet,
        (camera, pane): (Camera, Rect),
    ) -> Vec<Vec<Shape>> {
        let Some(seen) = self.seen_of(&sheet.garment).cloned() else { return Vec::new() };
        let textures = &mut self.textures;
        let of = |piece: &Piece| {
            let is_visible = camera.rect(piece.low, piece.high, pane).intersects(pane);
            let panel = seen.panels.get(piece.panel).and_then(Option::as_ref).filter(|_| is_visible);
            panel.map(|panel| over(textures, context, &panel.laid, piece, (camera, pane))).unwrap_or_default()
        };
        sheet.pieces.iter().map(of).collect()
    }
}

/// A picture over a piece: the level that is as fine as the screen, and over it the next smaller, as far as the screen is coarser.
fn over(
    textures: &mut Textures,
    context: &egui::Context,
    laid: &LaidPrint,
    piece: &Piece,
    (camera, pane): (Camera, Rect),
) -> Vec<Shape> {
    let Some(largest) = laid.print.levels().first() else { return Vec::new() };
    let to_picture = laid.uv_to_picture * piece.uv_to_sheet.inverse();
    let size = Vec2::new(largest.width as f32, largest.height as f32);
    let pixel = 1.0 / (camera.scale * context.pixels_per_point());
    let steps = [Vec2::X, Vec2::Y].map(|way| (to_picture.transform_vector2(way * pixel) * size).length());
    let last = laid.print.levels().len() - 1;
    let level = steps[0].max(steps[1]).max(1.0).log2().clamp(0.0, last as f32);
    let (fine, share) = (level as usize, level.fract());
    let mut shapes = Vec::new();
    for (number, alpha) in [(fine, 1.0), ((fine + 1).min(last), share)] {
        if alpha <= 0.0 {
            continue;
        }
        let Some(texture) = textures.get(context, laid, number) else { continue };
        let color = Color32::from_white_alpha((alpha * 255.0) as u8);
        shapes.push(Shape::mesh(mesh(piece, to_picture, (camera, pane), texture, color)));
    }
    shapes
}

fn mesh(
    piece: &Piece,
    to_picture: Affine2,
    (camera, pane): (Camera, Rect),
    texture: egui::TextureId,
    color: Color32,
) -> Mesh {
    let vertex = |&at: &Vec2| {
        let uv = to_picture.transform_point2(at);
        Vertex { pos: camera.to_window(at, pane), uv: pos2(uv.x, uv.y), color }
    };
    Mesh {
        indices: piece.fill.clone(),
        vertices: piece.outlines.iter().flatten().map(vertex).collect(),
        texture_id: texture,
    }
}
