//! From places in a panel's flat pattern to the surface.

use glam::{Vec2, Vec3};

use super::{Garment, Panel};

/// Cells along each side of the grid, for so many triangles that there is about one in each.
const MOST_CELLS: f32 = 512.0;

/// Finds the triangles of a panel by their UVs. Building it looks at every triangle once.
#[derive(Debug, Clone)]
pub struct FlatLocator {
    low: Vec2,
    /// Cells per unit of the UVs.
    scale: Vec2,
    columns: usize,
    rows: usize,
    /// The triangles that reach into each cell, by [`Garment::triangles`].
    cells: Vec<Vec<u32>>,
}

/// A place on a garment's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePlace {
    /// Index into [`Garment::triangles`].
    pub triangle: u32,
    /// How much each of its corners counts; the sum is 1.
    pub shares: Vec3,
}

impl FlatLocator {
    /// Of a panel whose UVs have an area; else nothing is ever found.
    pub fn new(garment: &Garment, panel: &Panel) -> Self {
        let uvs = |triangle: u32| corner_uvs(garment, triangle);
        let corners = || panel.triangles.clone().flat_map(uvs);
        let (low, high) = corners()
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), uv| (low.min(uv), high.max(uv)));
        let side = (panel.triangles.len() as f32).sqrt().clamp(1.0, MOST_CELLS).floor();
        let size = high - low;
        let scale = if size.is_finite() && size.min_element() > 0.0 { side / size } else { Vec2::ZERO };
        let (columns, rows) = (side as usize, side as usize);
        let mut locator = Self { low, scale, columns, rows, cells: vec![Vec::new(); columns * rows] };
        for triangle in panel.triangles.clone() {
            let [a, b, c] = uvs(triangle);
            let (from, to) = (locator.cell(a.min(b).min(c)), locator.cell(a.max(b).max(c)));
            for row in from.1..=to.1 {
                for column in from.0..=to.0 {
                    locator.cells[row * columns + column].push(triangle);
                }
            }
        }
        locator
    }

    /// The place of `uv` on the surface; none outside of the panel. Where the flat pattern overlaps itself, one of them.
    pub fn locate(&self, garment: &Garment, uv: Vec2) -> Option<SurfacePlace> {
        if self.scale == Vec2::ZERO || !uv.is_finite() {
            return None;
        }
        let (column, row) = self.cell(uv);
        let inside = |&&triangle: &&u32| {
            shares(corner_uvs(garment, triangle), uv).is_some_and(|it| it.min_element() >= -1e-4)
        };
        let triangle = *self.cells[row * self.columns + column].iter().find(inside)?;
        Some(SurfacePlace { triangle, shares: shares(corner_uvs(garment, triangle), uv)? })
    }

    fn cell(&self, uv: Vec2) -> (usize, usize) {
        let at = ((uv - self.low) * self.scale).max(Vec2::ZERO);
        ((at.x as usize).min(self.columns - 1), (at.y as usize).min(self.rows - 1))
    }
}

impl SurfacePlace {
    /// The place where a line from `origin` along `direction` goes through `triangle`'s plane.
    pub fn on_line(garment: &Garment, triangle: u32, origin: Vec3, direction: Vec3) -> Option<Self> {
        let [a, b, c] =
            garment.triangles.get(triangle as usize)?.map(|vertex| garment.positions[vertex as usize]);
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - origin) / normal.dot(direction);
        let at = origin + direction * t;
        let share = |from: Vec3, to: Vec3| (to - from).cross(at - from).dot(normal) / normal.length_squared();
        let shares = Vec3::new(share(b, c), share(c, a), share(a, b));
        shares.is_finite().then_some(Self { triangle, shares })
    }

    /// Where it is, metres.
    pub fn position(&self, garment: &Garment) -> Vec3 {
        self.mix(garment, |vertex| garment.positions[vertex])
    }

    /// The unit normal there.
    pub fn normal(&self, garment: &Garment) -> Vec3 {
        self.mix(garment, |vertex| garment.normals[vertex]).normalize_or(Vec3::Z)
    }

    /// Its place in the flat pattern.
    pub fn uv(&self, garment: &Garment) -> Vec2 {
        self.mix(garment, |vertex| garment.uvs[vertex].extend(0.0)).truncate()
    }

    fn mix(&self, garment: &Garment, value: impl Fn(usize) -> Vec3) -> Vec3 {
        let Some(corners) = garment.triangles.get(self.triangle as usize) else { return Vec3::ZERO };
        let [a, b, c] = corners.map(|vertex| value(vertex as usize));
        a * self.shares.x + b * self.shares.y + c * self.shares.z
    }
}

fn corner_uvs(garment: &Garment, triangle: u32) -> [Vec2; 3] {
    let corners = garment.triangles.get(triangle as usize).copied().unwrap_or_default();
    corners.map(|vertex| garment.uvs.get(vertex as usize).copied().unwrap_or_default())
}

/// How much each corner counts at `at`; none where the triangle has no area.
fn shares([a, b, c]: [Vec2; 3], at: Vec2) -> Option<Vec3> {
    let area = (b - a).perp_dot(c - a);
    let shares =
        Vec3::new((c - b).perp_dot(at - b), (a - c).perp_dot(at - c), (b - a).perp_dot(at - a)) / area;
    shares.is_finite().then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::tests::{flat, garment_of};
    use crate::pseudo_random::PseudoRandom;
    use glam::Quat;

    #[test]
    fn places_of_the_flat_pattern_are_found_on_the_surface_and_back() {
        let tilt = Quat::from_rotation_y(0.6);
        let garment = garment_of(&[flat(tilt, |p| p * 0.25 + 3.0)]);
        let locator = FlatLocator::new(&garment, &garment.panels[0]);
        let mut numbers = PseudoRandom::new(5);
        for _ in 0..200 {
            let p = Vec2::new(0.5 + 5.0 * numbers.unit(), 0.5 + 5.0 * numbers.unit());
            let uv = p * 0.25 + 3.0;
            let place = locator.locate(&garment, uv).unwrap();
            assert!((place.position(&garment) - tilt * p.extend(0.0)).length() < 1e-4);
            assert!(
                (place.uv(&garment) - uv).length() < 1e-4
                    && (place.normal(&garment) - tilt * Vec3::Z).length() < 1e-5
            );
            let along = Vec3::new(0.3, -0.2, -1.0);
            let again =
                SurfacePlace::on_line(&garment, place.triangle, place.position(&garment) - along, along)
                    .unwrap();
            assert!((again.shares - place.shares).abs().max_element() < 1e-3);
        }
        for outside in [Vec2::ZERO, Vec2::splat(99.0), Vec2::NAN, Vec2::INFINITY] {
            assert_eq!(locator.locate(&garment, outside), None);
        }
    }

    #[test]
    fn without_an_area_nothing_is_found() {
        let garment = garment_of(&[flat(Quat::IDENTITY, |p| Vec2::new(p.x, 0.0))]);
        assert_eq!(FlatLocator::new(&garment, &garment.panels[0]).locate(&garment, Vec2::X), None);
    }
}
