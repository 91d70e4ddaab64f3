//! Surfaces of revolution: sphere, torus, cylinder.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::grid::{self, Point};
use crate::mesh::Mesh;

/// Radius 1, pole +y. u runs along the parallels, eastwards, so +x where the sphere faces +z; v to the north. The seam is
/// at -z. Turned by `--roll a` it is the ball on its turntable at angle a, the warp horizontal at 0.
pub(super) fn sphere() -> Mesh {
    grid::mesh("sphere", [256, 128], [true, true], |s, t| {
        let (longitude, latitude) = ((s - 0.5) * TAU, (t - 0.5) * PI);
        // At the poles themselves, rounding would leave a small circle.
        let parallel = if t == 0.0 || t == 1.0 { 0.0 } else { latitude.cos() };
        let p = DVec3::new(longitude.sin() * parallel, latitude.sin(), longitude.cos() * parallel);
        Point { position: p.as_vec3(), normal: p.as_vec3(), uv: DVec2::new(longitude, latitude).as_vec2() }
    })
}

/// The radius of the torus's circle of centres, metres.
const MAJOR: f64 = 0.7;
/// The radius of its tube.
const MINOR: f64 = 0.3;

/// The ring faces +z: radii 0.7 and 0.3. u runs around the ring, counter-clockwise as the viewer sees it.
pub(super) fn torus() -> Mesh {
    grid::mesh("torus", [240, 96], [false; 2], |s, t| torus_point(s, t, DVec2::new))
}

/// The same torus, vertex by vertex; u runs around the tube.
pub(super) fn torus_poloidal() -> Mesh {
    grid::mesh("torus-poloidal", [240, 96], [false; 2], |s, t| {
        torus_point(s, t, |around, tube| DVec2::new(tube, -around))
    })
}

fn torus_point(s: f64, t: f64, uv: impl Fn(f64, f64) -> DVec2) -> Point {
    // The tube's angle from outwards, towards +z; its seam is at the back.
    let (around, tube) = (s * TAU, (t - 0.25) * TAU);
    let out = DVec3::new(around.cos(), around.sin(), 0.0);
    let normal = out * tube.cos() + DVec3::Z * tube.sin();
    let position = out * MAJOR + normal * MINOR;
    Point {
        position: position.as_vec3(),
        normal: normal.as_vec3(),
        uv: uv(around * MAJOR, tube * MINOR).as_vec2(),
    }
}

/// An open tube about y, radius 0.5, from y = -0.8 to 0.8. u runs around it, v up; the seam is at -z.
pub(super) fn cylinder() -> Mesh {
    const RADIUS: f64 = 0.5;
    grid::mesh("cylinder", [192, 64], [false; 2], |s, t| {
        let (longitude, height) = ((s - 0.5) * TAU, (t - 0.5) * 1.6);
        let normal = DVec3::new(longitude.sin(), 0.0, longitude.cos());
        Point {
            position: (normal * RADIUS + DVec3::Y * height).as_vec3(),
            normal: normal.as_vec3(),
            uv: DVec2::new(longitude * RADIUS, height).as_vec2(),
        }
    })
}
