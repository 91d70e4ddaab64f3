//! Texels over a flat panel, and triangles filled in them.

use glam::{Affine2, Mat2, Vec2, Vec3};

use super::FlatPanel;

/// Texels round the panel's box: what lies beyond its edge is looked up, too.
pub(super) const MARGIN: usize = 4;
/// The most texels along a side: what every graphics device holds.
const LONGEST: f32 = 2040.0;

/// Square texels over a flat panel, rows from the top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    /// The top left corner, metres.
    corner: Vec2,
    /// The side of a texel, metres.
    pub(super) texel: f32,
    /// Columns.
    pub(super) width: usize,
    /// Rows.
    pub(super) height: usize,
}

impl Grid {
    /// Over `panel` in texels of this side, metres; in larger ones where there would be too many.
    pub(super) fn over(panel: &FlatPanel, texel: f32) -> Self {
        let size = panel.size();
        let texel = texel.max(size.max_element() / LONGEST).max(1e-6);
        let count = |length: f32| (length / texel).ceil() as usize + 2 * MARGIN;
        let border = MARGIN as f32 * texel;
        let corner = Vec2::new(panel.low.x - border, panel.high.y + border);
        Self { corner, texel, width: count(size.x), height: count(size.y) }
    }

    /// How many texels there are.
    pub(super) fn count(&self) -> usize {
        self.width * self.height
    }

    /// From metres to texels, x to the right and y down: centres are at halves.
    pub(super) fn to_texels(self, at: Vec2) -> Vec2 {
        Vec2::new(at.x - self.corner.x, self.corner.y - at.y) / self.texel
    }

    /// The inverse of [`Grid::to_texels`].
    pub(super) fn to_metres(self, at: Vec2) -> Vec2 {
        self.corner + Vec2::new(at.x, -at.y) * self.texel
    }

    /// The texel at a place in texels; none outside.
    pub(super) fn index(&self, at: Vec2) -> Option<usize> {
        let is_inside =
            at.cmpge(Vec2::ZERO).all() && (at.x as usize) < self.width && (at.y as usize) < self.height;
        is_inside.then(|| at.y as usize * self.width + at.x as usize)
    }

    /// From metres to a picture of these texels, as [`amc_core::render::LaidPrint`] has it.
    pub(super) fn to_picture(self) -> Affine2 {
        let size = Vec2::new(self.width as f32, self.height as f32) * self.texel;
        let flip = Mat2::from_diagonal(Vec2::new(1.0, -1.0) / size);
        Affine2::from_mat2(flip) * Affine2::from_translation(-self.corner)
    }

    /// Gives every texel whose centre is in a triangle what `value` mixes of its corners: it gets the triangle and how much each
    /// corner counts.
    pub(super) fn fill<T>(
        &self,
        panel: &FlatPanel,
        into: &mut [T],
        mut value: impl FnMut([u32; 3], Vec3) -> T,
    ) {
        for &triangle in &panel.triangles {
            let corners = panel.corners(triangle).map(|at| self.to_texels(at));
            let [a, b, c] = corners;
            let area = (b - a).perp_dot(c - a);
            if area == 0.0 || !area.is_finite() {
                continue;
            }
            let (low, high) = (a.min(b).min(c) - 0.5, a.max(b).max(c) - 0.5);
            let range = |low: f32, high: f32, count: usize| {
                (low.ceil().max(0.0) as usize)..((high.floor() + 1.0).max(0.0) as usize).min(count)
            };
            for row in range(low.y, high.y, self.height) {
                for column in range(low.x, high.x, self.width) {
                    let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
                    let share = |from: Vec2, to: Vec2| (to - from).perp_dot(at - from) / area;
                    let shares = Vec3::new(share(b, c), share(c, a), share(a, b));
                    if shares.min_element() >= -1e-4 {
                        into[row * self.width + column] = value(triangle, shares);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::*;

    #[test]
    fn texels_metres_and_pictures_agree() {
        let (_, panel) = sheet(9, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.01);
        for at in [panel.low, panel.high, Vec2::new(0.13, 0.4)] {
            let texels = grid.to_texels(at);
            assert!((grid.to_metres(texels) - at).length() < 1e-5);
            let picture = grid.to_picture().transform_point2(at);
            let wanted = texels / Vec2::new(grid.width as f32, grid.height as f32);
            assert!((picture - wanted).length() < 1e-5, "{picture} {wanted}");
        }
        assert_eq!(grid.index(Vec2::new(-0.1, 2.0)), None);
        assert_eq!(grid.index(Vec2::new(2.5, 1.5)), Some(grid.width + 2));
        assert!(Grid::over(&panel, 1e-9).width <= 2048);
    }

    #[test]
    fn triangles_are_filled_without_gaps_and_mixed_linearly() {
        let (_, panel) = sheet(7, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.013);
        let mut places = vec![Vec2::NAN; grid.count()];
        grid.fill(&panel, &mut places, |triangle, shares| {
            let [a, b, c] = panel.corners(triangle);
            a * shares.x + b * shares.y + c * shares.z
        });
        for (index, place) in places.iter().enumerate() {
            let centre = Vec2::new((index % grid.width) as f32 + 0.5, (index / grid.width) as f32 + 0.5);
            let at = grid.to_metres(centre);
            let is_inside = at.cmpgt(panel.low + 1e-5).all() && at.cmplt(panel.high - 1e-5).all();
            if is_inside {
                assert!((*place - at).length() < 1e-4, "{place} {at}");
            } else if at.cmplt(panel.low - 1e-3).any() || at.cmpgt(panel.high + 1e-3).any() {
                assert!(place.is_nan());
            }
        }
    }
}
