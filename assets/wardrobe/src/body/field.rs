//! Signed distances, exact or sampled on a grid.

use glam::{DVec3, IVec3};
use rayon::prelude::*;

/// A box of space, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Space {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

/// Distance between samples, metres.
const SPACING: f64 = 0.01;
/// Beyond this distance from the surface the function's own value is good enough, metres.
const BAND: f64 = 0.06;
/// Half the step of the gradient's central differences, metres.
const STEP: f64 = 0.001;

#[derive(Debug, Clone)]
pub(super) enum Field {
    Ball { centre: DVec3, radius: f64 },
    Sampled(Grid),
}

/// Samples of a distance, x fastest, then y.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    low: DVec3,
    counts: IVec3,
    samples: Vec<f32>,
}

impl Field {
    pub(super) fn ball(centre: DVec3, radius: f64) -> Self {
        Self::Ball { centre, radius }
    }

    /// Samples a function whose zero is the surface, and divides it by its gradient near there: that is the distance
    /// to first order.
    pub(super) fn sampled(space: &Space, function: impl Fn(DVec3) -> f64 + Sync) -> Self {
        let counts = ((space.high - space.low) / SPACING).ceil().as_ivec3() + IVec3::ONE;
        let row = counts.x.unsigned_abs() as usize;
        let mut samples =
            vec![0.0; row * counts.y.unsigned_abs() as usize * counts.z.unsigned_abs() as usize];
        samples.par_chunks_mut(row).enumerate().for_each(|(line, samples)| {
            let (y, z) = (line % counts.y.unsigned_abs() as usize, line / counts.y.unsigned_abs() as usize);
            for (x, sample) in samples.iter_mut().enumerate() {
                let point = space.low + DVec3::new(x as f64, y as f64, z as f64) * SPACING;
                *sample = near_distance(&function, point) as f32;
            }
        });
        Self::Sampled(Grid { low: space.low, counts, samples })
    }

    pub(super) fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Ball { centre, radius } => point.distance(*centre) - radius,
            Self::Sampled(grid) => grid.surface(point).0,
        }
    }

    pub(super) fn surface(&self, point: DVec3) -> (f64, DVec3) {
        match self {
            Self::Ball { centre, radius } => {
                let arm = point - *centre;
                (arm.length() - radius, arm.normalize_or(DVec3::Y))
            }
            Self::Sampled(grid) => {
                let (distance, gradient) = grid.surface(point);
                (distance, gradient.normalize_or(DVec3::Y))
            }
        }
    }
}

fn near_distance(function: &impl Fn(DVec3) -> f64, point: DVec3) -> f64 {
    let value = function(point);
    if value.abs() > BAND {
        return value;
    }
    let slope = |axis: DVec3| (function(point + axis * STEP) - function(point - axis * STEP)) / (2.0 * STEP);
    value / DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).length().max(0.2)
}

impl Grid {
    /// The trilinear value and its gradient; outside the grid those of its nearest place, with the way there added.
    fn surface(&self, point: DVec3) -> (f64, DVec3) {
        let most = (self.counts - IVec3::ONE).as_dvec3();
        let wanted = (point - self.low) / SPACING;
        let place = wanted.clamp(DVec3::ZERO, most);
        let cell = place.floor().min(most - DVec3::ONE);
        let t = place - cell;
        let corner = cell.as_ivec3();
        let at = |x: i32, y: i32, z: i32| {
            let index = ((corner.z + z) * self.counts.y + corner.y + y) * self.counts.x + corner.x + x;
            f64::from(self.samples[index.unsigned_abs() as usize])
        };
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let x00 = [at(0, 0, 0), at(1, 0, 0)];
        let x10 = [at(0, 1, 0), at(1, 1, 0)];
        let x01 = [at(0, 0, 1), at(1, 0, 1)];
        let x11 = [at(0, 1, 1), at(1, 1, 1)];
        let line = |e: [f64; 2]| mix(e[0], e[1], t.x);
        let face = [mix(line(x00), line(x10), t.y), mix(line(x01), line(x11), t.y)];
        let rise = |e: [f64; 2]| e[1] - e[0];
        let gradient = DVec3::new(
            mix(mix(rise(x00), rise(x10), t.y), mix(rise(x01), rise(x11), t.y), t.z),
            mix(line(x10) - line(x00), line(x11) - line(x01), t.z),
            face[1] - face[0],
        ) / SPACING;
        (mix(face[0], face[1], t.z) + wanted.distance(place) * SPACING, gradient)
    }
}
