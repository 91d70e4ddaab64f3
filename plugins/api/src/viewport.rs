//! The viewport, as overlays and tools see it.

use std::collections::BTreeSet;

use amc_core::mesh::Picker;
use amc_core::render::{Ray, View};
use egui::Pos2;
use glam::{Vec2, Vec3};

/// What is seen in the viewport, and where.
#[derive(Debug, Clone, Copy)]
pub struct ViewportView<'a> {
    /// Where it is in the window, points.
    pub rect: egui::Rect,
    /// From where the garment is seen, in pixels of the viewport.
    pub view: View,
    /// Pixels per point.
    pub pixels_per_point: f32,
    /// Finds panels.
    pub picker: &'a Picker,
    /// Numbers of the panels that are not drawn.
    pub hidden: &'a BTreeSet<usize>,
}

/// A tool in the person's hand, and what it does in this frame.
#[derive(Debug, Clone, Copy)]
pub struct Hand<'a> {
    /// Where it works.
    pub viewport: ViewportView<'a>,
    /// Clicks, drags and where the pointer is. The left button is the tool's.
    pub response: &'a egui::Response,
}

impl ViewportView<'_> {
    /// Where a point of the garment (object space, metres) is seen in the window; none behind the eye. It may be outside of
    /// the viewport, or hidden by the garment.
    pub fn to_window(&self, point: Vec3) -> Option<Pos2> {
        let clip = self.view.view_to_clip() * self.view.object_to_view * point.extend(1.0);
        if clip.w <= 0.0 {
            return None;
        }
        let place = (Vec2::new(clip.x, -clip.y) / clip.w + 1.0) / 2.0;
        let pixel = place * Vec2::new(self.view.width as f32, self.view.height as f32);
        let point = pixel / self.pixels_per_point;
        Some(self.rect.min + egui::vec2(point.x, point.y))
    }

    /// The line of sight through a point of the window, in object space.
    pub fn ray(&self, at: Pos2) -> Ray {
        let point = at - self.rect.min;
        self.view.ray(Vec2::new(point.x, point.y) * self.pixels_per_point)
    }

    /// The number of the panel that is seen at a point of the window.
    pub fn panel_at(&self, at: Pos2) -> Option<usize> {
        self.picker.first(self.ray(at), |panel| self.hidden.contains(&panel))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use amc_core::render::{Cloth, Draw, Drawing, Projection, Vertex};
    use glam::Mat4;

    use super::*;

    #[test]
    fn points_of_the_garment_and_of_the_window_belong_together() {
        let vertex = |(x, y)| Vertex { position: Vec3::new(x, y, 0.0), normal: Vec3::Z, ..Vertex::default() };
        let drawing = Drawing {
            vertices: Arc::new([(0.0, 0.0), (0.5, 0.0), (0.0, 0.5)].map(vertex).to_vec()),
            tangents: Arc::new(vec![Vec3::X; 3]),
            triangles: Arc::new(vec![[0, 1, 2]]),
            draws: vec![Draw { triangles: 0..1, cloth: Cloth::Plain }],
            fabrics: Vec::new(),
        };
        let picker = Picker::new(&drawing).unwrap();
        for projection in
            [Projection::Orthographic { half_height: 1.0 }, Projection::Perspective { fov_y: 0.9 }]
        {
            let object_to_view = Mat4::from_translation(Vec3::new(0.0, 0.0, -3.0));
            let shift = Vec2::ZERO;
            let view =
                View { object_to_view, projection, width: 400, height: 200, near: 1.0, far: 5.0, shift };
            let rect = egui::Rect::from_min_size(Pos2::new(30.0, 20.0), egui::vec2(200.0, 100.0));
            let hidden = BTreeSet::new();
            let seen = ViewportView { rect, view, pixels_per_point: 2.0, picker: &picker, hidden: &hidden };
            assert!((seen.to_window(Vec3::ZERO).unwrap() - rect.center()).length() < 1e-3);
            let inside = seen.to_window(Vec3::new(0.1, 0.1, 0.0)).unwrap();
            assert!(inside.x > rect.center().x && inside.y < rect.center().y);
            assert_eq!(seen.panel_at(inside), Some(0));
            assert_eq!(seen.panel_at(rect.min), None);
            let none = BTreeSet::from([0]);
            assert_eq!(ViewportView { hidden: &none, ..seen }.panel_at(inside), None);
        }
    }
}
