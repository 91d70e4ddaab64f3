//! Strokes on the sheet.

use amc_core::direction::comb::{Path, Stroke};
use amc_core::mesh::SurfacePlace;
use egui::{Pos2, Rect};
use glam::Vec2;

use super::camera::Camera;
use crate::comb::Finder;
use crate::sheet::Sheet;

/// Finds strokes on the sheet.
pub(super) struct OnSheet<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) camera: Camera,
    pub(super) pane: Rect,
}

impl Finder for OnSheet<'_> {
    fn place(&self, at: Pos2) -> Option<SurfacePlace> {
        let at = self.camera.to_sheet(at, self.pane);
        let piece = self.sheet.pieces.iter().find(|piece| piece.holds(at))?;
        piece.locator.locate(&self.sheet.garment, piece.uv_to_sheet.inverse().transform_point2(at))
    }

    fn line(&self, panel: usize, stroke: &Stroke) -> Vec<Pos2> {
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
