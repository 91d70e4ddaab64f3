//! Quads of 2x2 pixels: interpolation at the pixels' centres, and derivatives across them.

use glam::{Vec2, Vec3, Vec4};

use super::raster::{Coverage, QUAD, WindowTriangle};
use super::vertex::{Corner, Varyings};
use crate::render::LaidPrint;
use crate::render::shade::cyclic_choice;

/// The corners of a triangle and how much each counts at a pixel.
#[derive(Debug)]
pub(super) struct Interpolation<'a> {
    corners: [&'a Varyings; 3],
    inverse_w: [f32; 3],
    coverage: &'a Coverage,
}

impl<'a> Interpolation<'a> {
    /// Over a triangle, whose corners are looked up in `corners`; none where an index is out of range.
    pub(super) fn new(
        triangle: &WindowTriangle,
        coverage: &'a Coverage,
        corners: &'a [Corner],
    ) -> Option<Self> {
        let [a, b, c] = triangle.corners.map(|index| corners.get(index as usize));
        let corners = [&a?.varyings, &b?.varyings, &c?.varyings];
        Some(Self { corners, inverse_w: triangle.inverse_w, coverage })
    }

    /// The perspective-correct shares of the corners at the centre of the pixel `x`, `y`.
    fn shares(&self, x: i32, y: i32) -> [f32; 3] {
        let linear = self.coverage.shares(x, y);
        let [a, b, c] = [0, 1, 2].map(|k| linear[k] * self.inverse_w[k]);
        let sum = a + b + c;
        // Zero where a centre outside of the triangle lies on the horizon of its plane.
        let scale = if sum.abs() > 1e-30 { 1.0 / sum } else { 1e30 };
        [a * scale, b * scale, c * scale]
    }

    /// What is interpolated, at the centre of the pixel `x`, `y`, covered or not.
    pub(super) fn at(&self, x: i32, y: i32) -> Varyings {
        let [a, b, c] = self.shares(x, y);
        let [i, j, k] = self.corners;
        Varyings {
            p: i.p * a + j.p * b + k.p * c,
            n: i.n * a + j.n * b + k.n * c,
            t: i.t * a + j.t * b + k.t * c,
            uv: i.uv * a + j.uv * b + k.uv * c,
            occlusion: i.occlusion * a + j.occlusion * b + k.occlusion * c,
            kappa: i.kappa * a + j.kappa * b + k.kappa * c,
        }
    }

    fn kappa_pair(&self, front: bool, x: i32, y: i32) -> Vec2 {
        let [a, b, c] = self.shares(x, y);
        let [i, j, k] = self.corners.map(|corner| pair_of(corner.kappa, front));
        i * a + j * b + k * c
    }

    /// What `print` multiplies the colour by at the four pixels of a quad, as [`Interpolation::chosen_kappa`] has them.
    pub(super) fn inks(&self, print: &LaidPrint, x: i32, y: i32) -> [Vec3; 4] {
        let uvs = QUAD.map(|(right, down)| self.at(x + right as i32, y + down as i32).uv);
        let across = [uvs[1] - uvs[0], uvs[3] - uvs[2]];
        let down = [uvs[2] - uvs[0], uvs[3] - uvs[1]];
        std::array::from_fn(|lane| print.look_up(uvs[lane], across[lane / 2], down[lane % 2]))
    }

    /// The azimuth's coordinate at the four pixels of the quad with the top left pixel `x`, `y`: of each pair the one
    /// with the smaller derivative. Derivatives are differences within the pixel's own row and column of the quad;
    /// pixels outside of the triangle help.
    pub(super) fn chosen_kappa(&self, front: bool, x: i32, y: i32) -> [f32; 4] {
        let pairs = QUAD.map(|(right, down)| self.kappa_pair(front, x + right as i32, y + down as i32));
        let across = [pairs[1] - pairs[0], pairs[3] - pairs[2]];
        let down = [pairs[2] - pairs[0], pairs[3] - pairs[1]];
        std::array::from_fn(|lane| {
            let width = across[lane / 2].abs() + down[lane % 2].abs();
            cyclic_choice(pairs[lane], width)
        })
    }
}

/// The cyclic pair of the side that is seen.
pub(super) fn pair_of(kappa: Vec4, front: bool) -> Vec2 {
    if front { Vec2::new(kappa.x, kappa.y) } else { Vec2::new(kappa.z, kappa.w) }
}
