//! The direction in the texels of a flat panel.

use glam::Vec2;

use super::{FlatPanel, Grid};

/// A direction in every texel.
#[derive(Debug, Clone)]
pub(super) struct Field {
    /// Its texels.
    pub(super) grid: Grid,
    /// Unit, x to the right and y down; zero outside of the panel and where there is none.
    pub(super) directions: Vec<Vec2>,
}

impl Field {
    /// Of the directions of a panel's vertices, as [`FlatPanel::taken_back`] gives them. Between vertices lines are mixed, not arrows (by
    /// twice their angles): where the corners of a triangle point opposite ways, it is crossed all the same.
    pub(super) fn new(panel: &FlatPanel, grid: Grid, vertices: &[Vec2]) -> Self {
        let doubled: Vec<Vec2> = vertices.iter().map(|&d| twice(Vec2::new(d.x, -d.y))).collect();
        let mut directions = vec![Vec2::ZERO; grid.count()];
        grid.fill(panel, &mut directions, |triangle, shares| {
            let [a, b, c] = triangle.map(|vertex| vertex as usize);
            let line = half(doubled[a] * shares.x + doubled[b] * shares.y + doubled[c] * shares.z);
            let nearest = triangle[shares.max_position()] as usize;
            let arrow = Vec2::new(vertices[nearest].x, -vertices[nearest].y);
            if line.dot(arrow) < 0.0 { -line } else { line }
        });
        Self { grid, directions }
    }

    /// The line at a place in texels, on the side of `heading`; none outside.
    pub(super) fn along(&self, at: Vec2, heading: Vec2) -> Option<Vec2> {
        let line = self.directions[self.grid.index(at)?];
        (line != Vec2::ZERO).then(|| if line.dot(heading) < 0.0 { -line } else { line })
    }

    /// As [`Field::along`] in metres, y up, mixed between texels.
    pub(super) fn along_metres(&self, at: Vec2, heading: Vec2) -> Option<Vec2> {
        let at = self.grid.to_texels(at);
        let heading = Vec2::new(heading.x, -heading.y);
        let here = self.along(at, heading)?;
        let low = (at - 0.5).floor();
        let mut sum = Vec2::ZERO;
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let corner = low + Vec2::new(x, y);
            let weight = Vec2::ONE - (at - 0.5 - corner).abs();
            sum += self.along(corner + 0.5, here).unwrap_or_default() * weight.element_product();
        }
        let mixed = sum.normalize_or(here);
        Some(Vec2::new(mixed.x, -mixed.y))
    }

    /// Whether a texel is on the panel.
    pub(super) fn holds(&self, index: usize) -> bool {
        self.directions[index] != Vec2::ZERO
    }
}

/// The unit vector at twice the angle.
fn twice(d: Vec2) -> Vec2 {
    Vec2::new(d.x * d.x - d.y * d.y, 2.0 * d.x * d.y)
}

/// The unit vector at half the angle; zero of nothing.
fn half(d: Vec2) -> Vec2 {
    if d.length_squared() < 1e-12 { Vec2::ZERO } else { Vec2::from_angle(d.to_angle() / 2.0) }
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::*;

    #[test]
    fn lines_are_mixed_whatever_way_arrows_point() {
        let (_, panel) = sheet(9, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.01);
        let arrows: Vec<Vec2> = (0..panel.places.len())
            .map(|k| Vec2::from_angle(0.4) * if k % 3 == 0 { -1.0 } else { 1.0 })
            .collect();
        let field = Field::new(&panel, grid, &arrows);
        let wanted = Vec2::from_angle(0.4);
        let inside = field.directions.iter().filter(|d| **d != Vec2::ZERO);
        assert!(inside.clone().count() > 1000);
        for line in inside {
            assert!((line.x * wanted.y + line.y * wanted.x).abs() < 1e-3, "{line}");
        }
        let middle = (panel.low + panel.high) / 2.0;
        let along = field.along_metres(middle, -Vec2::X).unwrap();
        assert!((along + wanted).length() < 1e-3, "{along}");
        assert_eq!(field.along_metres(panel.high + 1.0, Vec2::X), None);
    }
}
