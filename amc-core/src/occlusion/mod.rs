//! Ambient occlusion per vertex: how much of the sky the cloth leaves open, on its front and on its back.
//!
//! Source: the paper's section 6.1, which multiplies the MatCap's colour by it. Rays over the hemisphere of a vertex's
//! normal, more of them where the cosine is larger, so the share that meets nothing is the cosine-weighted open sky.
//! Cloth is seen from both sides, and a fold that hides one leaves the other open: so both are measured.

mod cache;
#[cfg(test)]
mod tests;

pub use cache::cached;

use std::f32::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::mesh::Garment;
use crate::mesh::ray_tree::{Placement, RayTree};
use crate::{Error, Progress, Result};

/// How occlusion is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Rays per vertex, 1 to [`MOST_RAYS`]. The error falls a little slower than their number grows: 128, the default,
    /// leave about 0.02.
    pub rays: u32,
}

/// The most rays a vertex can be given.
pub const MOST_RAYS: u32 = 65_536;

impl Default for Options {
    fn default() -> Self {
        Self { rays: 128 }
    }
}

/// Vertices between two looks at the progress.
const CHUNK: usize = 256;
/// How far a ray's origin leaves its vertex, as a share of the distance to the middle of its triangles, both towards
/// that middle and along the normal.
const STEP: f32 = 0.02;
/// The least step along the normal, in the scaled garment: some hundred roundings.
const LEAST_STEP: f32 = 0.04;

/// The open share of the sky at every vertex, 0 (closed) to 1 (open), on the side of its normal and on the other; the
/// cloth blocks from both sides and at any distance.
///
/// A ray starts a little off the surface on its side, and a little towards the middle of the vertex's
/// triangles: a vertex at the foot of a wall stands clear of it, on its own side. Vertices at the same position use the
/// same rays, so seams do not show. The same garment gives the same numbers on any machine with the same arithmetic.
///
/// # Errors
/// Cancelled, [`Options::rays`] out of range, or indices that reach past the vertices.
pub fn compute(garment: &Garment, options: Options, progress: &Progress<'_>) -> Result<Vec<Vec2>> {
    check(garment, options)?;
    if garment.triangles.is_empty() {
        return Ok(vec![Vec2::ONE; garment.positions.len()]);
    }
    progress.step("occlusion", 0, garment.positions.len())?;
    let scene = Scene::new(garment);
    let samples = samples(options.rays);
    let done = AtomicUsize::new(0);
    let mut open = vec![Vec2::ONE; garment.positions.len()];
    open.par_chunks_mut(CHUNK).enumerate().try_for_each(|(chunk, open)| {
        for (open, vertex) in open.iter_mut().zip(chunk * CHUNK..) {
            let [front, back] = scene.origins[vertex];
            let normal = garment.normals[vertex];
            open.x = scene.open_sky(front, normal, &samples);
            open.y = scene.open_sky(back, -normal, &samples);
        }
        let done = done.fetch_add(open.len(), Ordering::Relaxed) + open.len();
        progress.step("occlusion", done, garment.positions.len())
    })?;
    Ok(open)
}

fn check(garment: &Garment, options: Options) -> Result<()> {
    if !(1..=MOST_RAYS).contains(&options.rays) {
        return Err(Error::invalid(format!(
            "{} rays per vertex: 1 to {MOST_RAYS} are possible",
            options.rays
        )));
    }
    let count = garment.positions.len();
    if garment.normals.len() != count {
        return Err(Error::invalid("not one normal per vertex"));
    }
    if !garment.positions.iter().chain(&garment.normals).all(|v| v.is_finite()) {
        return Err(Error::invalid("a position or normal is not finite"));
    }
    if garment.triangles.as_flattened().iter().any(|&corner| corner as usize >= count) {
        return Err(Error::invalid("a triangle refers to a vertex that is not there"));
    }
    Ok(())
}

/// Points of the unit square spread evenly (Hammersley's).
fn samples(count: u32) -> Vec<Vec2> {
    let point = |k: u32| Vec2::new((k as f32 + 0.5) / count as f32, unit(k.reverse_bits()));
    (0..count).map(point).collect()
}

/// 32 bits as a number in [0, 1).
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

/// The garment, placed as its tree wants it.
struct Scene {
    tree: RayTree,
    /// Where each vertex's rays start, on the side of its normal and on the other.
    origins: Vec<[Vec3; 2]>,
}

impl Scene {
    fn new(garment: &Garment) -> Self {
        let placement = Placement::of(&garment.positions);
        let positions: Vec<Vec3> = garment.positions.iter().map(|&p| placement.place(p)).collect();
        let tree = RayTree::new(&positions, &garment.triangles);
        Self { tree, origins: origins(garment, &positions) }
    }

    fn open_sky(&self, origin: Vec3, normal: Vec3, samples: &[Vec2]) -> f32 {
        let (right, up) = normal.any_orthonormal_pair();
        let shift = scramble(origin);
        let open = samples.iter().filter(|&&sample| {
            // Cosine-weighted: the disc, evenly filled, lifted to the hemisphere.
            let [radius_squared, turn] = (sample + shift).fract().to_array();
            let (sin, cos) = (turn * TAU).sin_cos();
            let radius = radius_squared.sqrt();
            let direction =
                (right * cos + up * sin) * radius + normal * (1.0 - radius_squared).max(0.0).sqrt();
            self.tree.is_open(origin, direction)
        });
        open.count() as f32 / samples.len() as f32
    }
}

fn origins(garment: &Garment, positions: &[Vec3]) -> Vec<[Vec3; 2]> {
    let mut middles = vec![(Vec3::ZERO, 0.0f32); positions.len()];
    for corners in &garment.triangles {
        let sum: Vec3 = corners.iter().map(|&corner| positions[corner as usize]).sum();
        for &corner in corners {
            let middle = &mut middles[corner as usize];
            *middle = (middle.0 + sum / 3.0, middle.1 + 1.0);
        }
    }
    let origin = |((&position, &normal), (sum, count)): ((&Vec3, &Vec3), (Vec3, f32))| {
        let to_middle = if count > 0.0 { sum / count - position } else { Vec3::ZERO };
        [normal, -normal].map(|normal| {
            // On a bulge the middle lies below the surface: never towards that.
            let to_middle = to_middle - normal * to_middle.dot(normal).min(0.0);
            // As far along the normal as towards the middle: above the vertex's own triangles, whatever their slope.
            position + to_middle * STEP + normal * (to_middle.length() * STEP).max(LEAST_STEP)
        })
    };
    positions.iter().zip(&garment.normals).zip(middles).map(origin).collect()
}

/// A shift of the samples that differs from place to place, so that their pattern does not show, and is the same for
/// vertices at (nearly) the same place.
fn scramble(place: Vec3) -> Vec2 {
    let cell = (place * 0.25).round().as_ivec3();
    let mut state = 0x9e37_79b9_u32;
    let mut next = |word: u32| {
        // A multiply-and-shift mix after each word (constants of the usual 32-bit finishers).
        state = (state ^ word).wrapping_mul(0x85eb_ca6b);
        state = (state ^ (state >> 15)).wrapping_mul(0xc2b2_ae35);
        state ^= state >> 13;
        state
    };
    next(cell.x as u32);
    next(cell.y as u32);
    Vec2::new(unit(next(cell.z as u32)), unit(next(1)))
}
