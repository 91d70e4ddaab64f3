//! Where the viewport is in the window, in whole pixels.

use eframe::egui;
use glam::Vec2;

/// A rectangle of the window: in points, and rounded to pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixels {
    pub(super) rect: egui::Rect,
    pixels_per_point: f32,
    left_top: Vec2,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Pixels {
    /// None where `rect` holds no pixel.
    pub(super) fn of(rect: egui::Rect, pixels_per_point: f32) -> Option<Self> {
        let pixel = |at: egui::Pos2| (Vec2::new(at.x, at.y) * pixels_per_point).round();
        let (left_top, size) = (pixel(rect.min), pixel(rect.max) - pixel(rect.min));
        if !left_top.is_finite() || !size.cmpge(Vec2::ONE).all() {
            return None;
        }
        let [width, height] = size.to_array().map(|side| side as u32);
        Some(Self { rect, pixels_per_point, left_top, width, height })
    }

    /// Left, top, width, height in pixels.
    pub(super) fn viewport(&self) -> [f32; 4] {
        [self.left_top.x, self.left_top.y, self.width as f32, self.height as f32]
    }

    /// Width over height.
    pub(super) fn aspect(&self) -> f32 {
        self.width as f32 / self.height as f32
    }

    /// A point of the window in pixels from this rectangle's top-left corner.
    pub(super) fn pixel(&self, at: egui::Pos2) -> Vec2 {
        Vec2::new(at.x, at.y) * self.pixels_per_point - self.left_top
    }

    /// A point of the window as a place of the picture: from its middle to the right and up, in half heights.
    pub(super) fn place(&self, at: egui::Pos2) -> Vec2 {
        let size = Vec2::new(self.width as f32, self.height as f32);
        (self.pixel(at) * 2.0 - size) / size.y * Vec2::new(1.0, -1.0)
    }

    /// A shift in points as a shift of places.
    pub(super) fn shift(&self, by: egui::Vec2) -> Vec2 {
        Vec2::new(by.x, -by.y) * self.pixels_per_point * 2.0 / self.height as f32
    }
}
