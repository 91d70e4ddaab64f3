//! Resistance to bending over the edge between two triangles.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::colour::Acts;
use super::points::Points;

/// An edge and the corners opposite to it. The energy is `stiffness/2 (angle - rest)^2`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hinge {
    /// The edge's ends, counter-clockwise in the first triangle, then the first and the second triangle's far corners.
    corners: [u32; 4],
    /// Radians; positive where the two right sides move apart.
    rest: f64,
    /// Newton metres.
    stiffness: f64,
    /// How far the cloth's own friction gives before it slips, radians.
    give: f64,
}

/// Cloth does not bend to and fro along one curve: its yarns rub on each other, and hold a moment of about the bending stiffness times
/// this curvature, 1/metres (the hysteresis 2HB that fabric tests give, over 2B, is of this order for shirtings).
const HELD_CURVATURE: f64 = 37.0;
/// How many times stiffer than the bending itself the yarns hold on before they slip.
const HOLD: f64 = 20.0;

impl Hinge {
    /// A hinge whose lengths are those of the flat cloth: the edge's `length`, metres, the two triangles' `area` together, square
    /// metres. `bending` is the cloth's, newton metres.
    ///
    /// The stiffness is `bending length^2 / area`. On equilateral triangles bent round a cylinder that gives the plate's energy
    /// `bending/2 curvature^2` per area, whichever way the cylinder's axis lies (averaged over the three edges).
    pub(super) fn new(corners: [u32; 4], length: f64, area: f64, bending: f64, rest: f64) -> Self {
        // Two thirds of the mean height lie between the two triangles' centres.
        let give = HELD_CURVATURE / HOLD * 2.0 * area / (3.0 * length);
        Self { corners, rest, stiffness: bending * length * length / area, give }
    }

    /// One pass (XPBD, as the membrane's); the dihedral angle's gradient after Bridson, Marino and Fedkiw 2003. `held`: at which angle from
    /// its rest the cloth's own friction holds it, radians.
    #[inline]
    pub(super) fn solve(&self, points: &Points, inverse_mass: &[f64], step: f64, held: Option<f64>) {
        let x = self.corners.map(|corner| points.get(corner));
        let edge = x[1] - x[0];
        let first = edge.cross(x[2] - x[0]);
        let second = (x[3] - x[0]).cross(edge);
        let (length2, first2, second2) =
            (edge.length_squared(), first.length_squared(), second.length_squared());
        if length2 < 1e-14 || first2 < 1e-18 || second2 < 1e-18 {
            return;
        }
        let length = length2.sqrt();
        let wrong = turn(first.cross(second).dot(edge) / length, first.dot(second), self.rest);
        let (wrong, stiffness) = match held {
            None => (wrong, self.stiffness),
            Some(held) => (wrong - held * (HOLD / (1.0 + HOLD)), self.stiffness * (1.0 + HOLD)),
        };
        let far_first = first * (-length / first2);
        let far_second = second * (-length / second2);
        let (foot_first, foot_second) =
            ((x[2] - x[0]).dot(edge) / length2, (x[3] - x[0]).dot(edge) / length2);
        let gradients = [
            -(far_first * (1.0 - foot_first) + far_second * (1.0 - foot_second)),
            -(far_first * foot_first + far_second * foot_second),
            far_first,
            far_second,
        ];
        let w = self.corners.map(|corner| inverse_mass[corner as usize]);
        let weight: f64 = w.iter().zip(&gradients).map(|(w, g)| w * g.length_squared()).sum();
        let multiplier = -wrong / (weight + 1.0 / (stiffness * step * step));
        for i in 0..4 {
            points.set(self.corners[i], x[i] + gradients[i] * (multiplier * w[i]));
        }
    }

    /// How far it is from its rest, radians.
    fn wrong(&self, points: &Points) -> f64 {
        let x = self.corners.map(|corner| points.get(corner));
        let edge = x[1] - x[0];
        let first = edge.cross(x[2] - x[0]);
        let second = (x[3] - x[0]).cross(edge);
        let direction: DVec3 = edge.normalize_or_zero();
        turn(first.cross(second).dot(direction), first.dot(second), self.rest)
    }

    /// Elastic energy, joules.
    pub(super) fn energy(&self, points: &Points) -> f64 {
        let wrong = self.wrong(points);
        0.5 * self.stiffness * wrong * wrong
    }

    /// Where the cloth's own friction holds it now, as [`Self::solve`] wants it: as it is, or where it did `before` unless that has slipped.
    pub(super) fn held(&self, points: &Points, before: Option<f64>) -> f64 {
        let wrong = self.wrong(points);
        before.map_or(wrong, |held| held.clamp(wrong - self.give, wrong + self.give))
    }
}

/// How far the angle of (`sine`, `cosine`) is from `rest`, -PI to PI about a rest of 0; a fold does not jump through itself.
fn turn(sine: f64, cosine: f64, rest: f64) -> f64 {
    let angle = sine.atan2(cosine);
    let angle = if rest > 0.5 * PI && angle < rest - 1.5 * PI {
        angle + TAU
    } else if rest < -0.5 * PI && angle > rest + 1.5 * PI {
        angle - TAU
    } else {
        angle
    };
    angle - rest
}

impl Acts for Hinge {
    fn particles(&self) -> impl Iterator<Item = u32> {
        self.corners.into_iter()
    }
}
