//! Which part of the flat pattern its pane shows.

use egui::{Pos2, Rect, Vec2 as Points, pos2};
use glam::Vec2;

/// Free space round the whole, of the pane's size.
const MARGIN: f32 = 0.03;
/// The nearest, points per metre, and the farthest.
const SCALES: (f32, f32) = (1.0, 1e5);

/// From the sheet (metres, y up) to the window (points, y down).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Camera {
    /// What is in the middle of the pane.
    pub(crate) middle: Vec2,
    /// Points per metre.
    pub(crate) scale: f32,
}

impl Camera {
    /// So that a sheet of this size fills a pane.
    pub(crate) fn fit(size: Vec2, pane: Points) -> Self {
        let room = Vec2::new(pane.x, pane.y) * (1.0 - 2.0 * MARGIN);
        let scale = (room / size.max(Vec2::splat(1e-3))).min_element().clamp(SCALES.0, SCALES.1);
        Self { middle: size / 2.0, scale }
    }

    pub(crate) fn to_window(self, at: Vec2, pane: Rect) -> Pos2 {
        let from_middle = (at - self.middle) * self.scale;
        pane.center() + egui::vec2(from_middle.x, -from_middle.y)
    }

    pub(crate) fn to_sheet(self, at: Pos2, pane: Rect) -> Vec2 {
        let from_middle = at - pane.center();
        self.middle + Vec2::new(from_middle.x, -from_middle.y) / self.scale
    }

    /// What is under the pointer moves with it.
    pub(crate) fn pan(&mut self, by: Points) {
        self.middle -= Vec2::new(by.x, -by.y) / self.scale;
    }

    /// What is at `at` stays there.
    pub(crate) fn zoom(&mut self, factor: f32, at: Pos2, pane: Rect) {
        let before = self.to_sheet(at, pane);
        self.scale = (self.scale * factor).clamp(SCALES.0, SCALES.1);
        self.middle += before - self.to_sheet(at, pane);
    }

    /// A box of the sheet in the window.
    pub(crate) fn rect(self, low: Vec2, high: Vec2, pane: Rect) -> Rect {
        let (a, b) = (self.to_window(low, pane), self.to_window(high, pane));
        Rect::from_min_max(pos2(a.x, b.y), pos2(b.x, a.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_fits_and_the_place_under_the_pointer_stays() {
        let pane = Rect::from_min_size(pos2(30.0, 20.0), egui::vec2(400.0, 300.0));
        let mut camera = Camera::fit(Vec2::new(2.0, 1.0), pane.size());
        assert!(pane.contains_rect(camera.rect(Vec2::ZERO, Vec2::new(2.0, 1.0), pane)));
        let at = pos2(100.0, 200.0);
        let place = camera.to_sheet(at, pane);
        camera.zoom(3.0, at, pane);
        assert!((camera.to_sheet(at, pane) - place).length() < 1e-5);
        camera.pan(egui::vec2(10.0, -4.0));
        assert!((camera.to_window(place, pane) - pos2(110.0, 196.0)).length() < 1e-2);
    }
}
