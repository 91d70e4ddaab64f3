//! Resistance of a triangle to stretch along warp and weft and to shear between them.

use glam::{DVec2, DVec3};

use super::colour::Acts;
use super::points::Points;
use crate::pattern::Cloth;

/// A triangle of cloth. With the place x as a linear function of the flat cloth's coordinates along warp and weft,
/// w_u and w_v are its derivatives, the deformation gradient's columns (Baraff and Witkin 1998, section 4.2). Energies, per
/// area: `warp/2 (|w_u|-1)^2`, `weft/2 (|w_v|-1)^2`, `shear/2 (w_u . w_v)^2`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Membrane {
    corners: [u32; 3],
    /// Per corner: what its place adds to w_u and w_v, 1/metres.
    along: [DVec2; 3],
    area: f64,
    /// Newtons per metre.
    warp: f64,
    weft: f64,
    shear: f64,
}

impl Membrane {
    /// The triangle with these flat corners, metres, cut with the warp at `grain` radians from +u. `None` for one without area.
    pub(super) fn new(corners: [u32; 3], flat: [DVec2; 3], grain: f64, cloth: &Cloth) -> Option<Self> {
        let twice = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        if twice.abs() < 1e-12
            || corners[0] == corners[1]
            || corners[1] == corners[2]
            || corners[2] == corners[0]
        {
            return None;
        }
        let warp_direction = DVec2::from_angle(grain);
        let gradient = |i: usize| {
            let across = (flat[(i + 2) % 3] - flat[(i + 1) % 3]).perp() / twice;
            DVec2::new(across.dot(warp_direction), across.dot(warp_direction.perp()))
        };
        Some(Self {
            corners,
            along: [gradient(0), gradient(1), gradient(2)],
            area: 0.5 * twice.abs(),
            warp: cloth.warp,
            weft: cloth.weft,
            shear: cloth.shear,
        })
    }

    /// w_u and w_v at these corners.
    fn columns(&self, x: &[DVec3; 3]) -> (DVec3, DVec3) {
        let [a, b, c] = self.along;
        (x[0] * a.x + x[1] * b.x + x[2] * c.x, x[0] * a.y + x[1] * b.y + x[2] * c.y)
    }

    /// One pass of the three constraints (XPBD: Macklin, Mueller and Chentanez 2016, equation 18, from a multiplier of zero).
    /// `softness` multiplies the compliances; `step` in seconds.
    #[inline]
    pub(super) fn solve(&self, points: &Points, inverse_mass: &[f64], softness: f64, step: f64) {
        let mut x = self.corners.map(|corner| points.get(corner));
        let w = self.corners.map(|corner| inverse_mass[corner as usize]);
        let scale = softness / (self.area * step * step);
        self.stretch(&mut x, w, |along| along.x, scale / self.warp);
        self.stretch(&mut x, w, |along| along.y, scale / self.weft);
        self.lean(&mut x, w, scale / self.shear);
        for (corner, place) in self.corners.iter().zip(x) {
            points.set(*corner, place);
        }
    }

    #[inline]
    fn stretch(&self, x: &mut [DVec3; 3], w: [f64; 3], part: impl Fn(DVec2) -> f64, compliance: f64) {
        let along = self.along.map(part);
        let column = x[0] * along[0] + x[1] * along[1] + x[2] * along[2];
        let length = column.length();
        if length < 1e-9 {
            return;
        }
        let weight: f64 = w.iter().zip(along).map(|(w, a)| w * a * a).sum();
        let push = column * (-(length - 1.0) / (length * (weight + compliance)));
        for i in 0..3 {
            x[i] += push * (w[i] * along[i]);
        }
    }

    #[inline]
    fn lean(&self, x: &mut [DVec3; 3], w: [f64; 3], compliance: f64) {
        let (warp, weft) = self.columns(x);
        let gradients = self.along.map(|along| weft * along.x + warp * along.y);
        let weight: f64 = w.iter().zip(gradients).map(|(w, g)| w * g.length_squared()).sum();
        let multiplier = -warp.dot(weft) / (weight + compliance);
        for i in 0..3 {
            x[i] += gradients[i] * (multiplier * w[i]);
        }
    }

    /// Elastic energy, joules.
    pub(super) fn energy(&self, points: &Points) -> f64 {
        let (warp, weft) = self.columns(&self.corners.map(|corner| points.get(corner)));
        let square = |value: f64| value * value;
        let stretch = self.warp * square(warp.length() - 1.0) + self.weft * square(weft.length() - 1.0);
        0.5 * self.area * (stretch + self.shear * square(warp.dot(weft)))
    }
}

impl Acts for Membrane {
    fn particles(&self) -> impl Iterator<Item = u32> {
        self.corners.into_iter()
    }
}
