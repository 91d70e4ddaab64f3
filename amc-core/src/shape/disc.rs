//! The disc of radius 1 that faces +z, in two grains.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3};

use super::grid::{self, Point};
use crate::mesh::Mesh;

/// Columns around the disc, rows from rim to centre.
const CELLS: [u32; 2] = [256, 32];

/// u runs in circles, counter-clockwise; v towards the centre. (u is the angle times 1 m: true to length at the rim.)
pub(super) fn circular() -> Mesh {
    grid::mesh("disc-circular", CELLS, [false, true], |s, t| {
        point(s, t, |angle, radius| DVec2::new(angle, 1.0 - radius))
    })
}

/// The same disc, vertex by vertex; u runs outwards, v counter-clockwise.
pub(super) fn radial() -> Mesh {
    grid::mesh("disc-radial", CELLS, [false, true], |s, t| {
        point(s, t, |angle, radius| DVec2::new(radius, angle))
    })
}

fn point(s: f64, t: f64, uv: impl Fn(f64, f64) -> DVec2) -> Point {
    let (angle, radius) = (s * TAU, 1.0 - t);
    let position = DVec3::new(angle.cos() * radius, angle.sin() * radius, 0.0);
    Point { position: position.as_vec3(), normal: Vec3::Z, uv: uv(angle, radius).as_vec2() }
}
