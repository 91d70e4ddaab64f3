//! The shading functions. Each has a twin of the same name in `shaders/`, and a test compares their pictures.

use glam::{Vec2, Vec3, Vec4};

use super::{Perspective, View};
use crate::color::linear_from_srgb;
use crate::view_space::{Azimuth, perpendicular, turn_to_z};

/// The grey of parts without a fabric, linear.
pub const PLAIN_GREY: f32 = 0.35;

/// A normal and a tangent in the frame a table is looked up in. Not of unit length in mode `paper`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnedFrame {
    /// The normal.
    pub n: Vec3,
    /// The tangent.
    pub t: Vec3,
}

/// Turns the unit normal `n` and the tangent `t` at the view-space position `p` for perspective (DESIGN: "Perspective
/// in rendering"; the paper's equation 4 in mode `paper`). Orthographic: none.
pub fn perspective_turn(view: &View, mode: Perspective, p: Vec3, n: Vec3, t: Vec3) -> TurnedFrame {
    let v = view.towards_eye(p);
    let orthographic = matches!(view.projection, super::Projection::Orthographic { .. });
    match mode {
        _ if orthographic => TurnedFrame { n, t },
        Perspective::Off => TurnedFrame { n, t },
        Perspective::Paper => TurnedFrame { n: paper_turn(p, n), t: paper_turn(p, t) },
        Perspective::Full => TurnedFrame { n: turn_to_z(n, v), t: turn_to_z(t, v) },
        Perspective::Half => {
            let half = (v + Vec3::Z).try_normalize().unwrap_or(Vec3::Z);
            TurnedFrame { n: turn_to_z(n, half), t: turn_to_z(t, half) }
        }
    }
}

/// Equation 4 of the paper with `p` in view space (in normalised device coordinates, as printed, it is wrong); z is kept.
fn paper_turn(p: Vec3, x: Vec3) -> Vec3 {
    let slope = p.truncate() / p.z.min(-1e-6);
    let turn = |value: f32, slope: f32| (value - slope * x.z) / (1.0 + slope * slope).sqrt();
    Vec3::new(turn(x.x, slope.x), turn(x.y, slope.y), x.z)
}

/// `(n_x, n_y)` to look up: where the turned normal looks away from the viewer, or leaves the disc, the disc's rim.
pub fn disc_normal(n: Vec3) -> Vec2 {
    let xy = n.truncate();
    let length = xy.length();
    if n.z < 0.0 || length > 1.0 { xy / length.max(1e-6) } else { xy }
}

/// `kappa = R phi / (2 pi)`, in turns of the table's axis, unbounded.
pub fn kappa(azimuth: Azimuth, symmetry: u32, frame: TurnedFrame) -> f32 {
    symmetry as f32 * azimuth.of(frame.n, frame.t) / std::f32::consts::TAU
}

/// `kappa mod 1` in [0, 1) and its twin `kappa - floor(kappa - 1/2)` in [1/2, 3/2): paper, section 6.2 (whose text has
/// lost the floor signs).
pub fn cyclic_pair(kappa: f32) -> Vec2 {
    Vec2::new(kappa - kappa.floor(), kappa - (kappa - 0.5).floor())
}

/// The one of an interpolated pair whose absolute derivative is smaller; `width` is `|d/dx| + |d/dy|` of each.
pub fn cyclic_choice(pair: Vec2, width: Vec2) -> f32 {
    if width.y < width.x { pair.y } else { pair.x }
}

/// What the vertex stage sends for the azimuth: the cyclic pair for the front (x, y) and for the back (z, w), where
/// the normal is negated. `n`, `t` in view space, of unit length and perpendicular, at the view-space position `p`.
pub fn vertex_kappa(
    view: &View,
    mode: Perspective,
    azimuth: Azimuth,
    symmetry: u32,
    p: Vec3,
    n: Vec3,
    t: Vec3,
) -> Vec4 {
    let pair = |n: Vec3| cyclic_pair(kappa(azimuth, symmetry, perspective_turn(view, mode, p, n, t)));
    let (front, back) = (pair(n), pair(-n));
    Vec4::new(front.x, front.y, back.x, back.y)
}

/// The azimuth per fragment: `n` is of unit length and faces the viewer's side; `t` is the interpolated tangent.
pub fn fragment_kappa(
    view: &View,
    mode: Perspective,
    azimuth: Azimuth,
    symmetry: u32,
    p: Vec3,
    n: Vec3,
    t: Vec3,
) -> f32 {
    kappa(azimuth, symmetry, perspective_turn(view, mode, p, n, perpendicular(t, n)))
}

/// The unit normal of a fragment from the interpolated one. Cloth is two-sided: on a back face it is negated, and the
/// tangent kept. Where the interpolated normal vanishes there is none: +z.
pub fn facing_normal(n: Vec3, front: bool) -> Vec3 {
    let n = n.try_normalize().unwrap_or(Vec3::Z);
    if front { n } else { -n }
}

/// Of the light that occlusion leaves on the front and on the back, that of the side which is seen.
pub fn seen_light(on_front: f32, on_back: f32, front: bool) -> f32 {
    if front { on_front } else { on_back }
}

/// `(n_x, n_y)` at which tables and MatCap pictures are looked up: the facing normal `n` at the view-space position `p`
/// turned for perspective, then kept on the disc. A front-facing fragment whose interpolated normal looks away from
/// the eye lands on the rim.
pub fn look_up_normal(view: &View, mode: Perspective, p: Vec3, n: Vec3) -> Vec2 {
    disc_normal(perspective_turn(view, mode, p, n, n).n)
}

/// Texture coordinates in a table of `slices` slices: u to the right, v up (both clamped), w along the azimuth
/// (repeating), of the disc's `(n_x, n_y)` and of `kappa` in turns of the axis.
pub fn table_coordinates(xy: Vec2, kappa: f32, slices: u32) -> Vec3 {
    Vec3::new((xy.x + 1.0) / 2.0, (xy.y + 1.0) / 2.0, kappa + 0.5 / slices as f32)
}

/// Texture coordinates in a picture of a ball whose row 0 is the top, of the disc's `(n_x, n_y)`: the how-to's flip.
pub fn picture_coordinates(xy: Vec2) -> Vec2 {
    Vec2::new((xy.x + 1.0) / 2.0, (1.0 - xy.y) / 2.0)
}

/// A unit direction as a colour, sRGB-encoded values: `direction / 2 + 1/2`.
pub fn direction_colour(direction: Vec3) -> Vec3 {
    direction / 2.0 + Vec3::splat(0.5)
}

/// Linear light of sRGB-encoded values: what the views of normals, tangents and UVs store.
pub fn linear_colour(encoded: Vec3) -> Vec3 {
    Vec3::new(linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z))
}

/// The plain grey of a part without a fabric, lit from the viewer: linear. `n_z` of the facing normal, not turned for
/// perspective. Such parts stay grey in the modes `Amc`, `Isotropic` and `MatCap`.
pub fn plain(n_z: f32) -> Vec3 {
    Vec3::splat(PLAIN_GREY * (0.3 + 0.7 * n_z.max(0.0)))
}

/// What multiplies a picture that is shown in place of a fabric: light from the viewer. `n_z` as in [`plain`].
pub fn cover_light(n_z: f32) -> f32 {
    0.45 + 0.55 * n_z.max(0.0)
}

/// The colour of the UV view, sRGB-encoded values: the fractional parts in red and green, a checker of ten squares to
/// the unit in blue.
pub fn uv_colour(uv: Vec2) -> Vec3 {
    let square = (uv * 10.0).floor();
    let odd = (square.x + square.y) - 2.0 * ((square.x + square.y) / 2.0).floor();
    Vec3::new(uv.x - uv.x.floor(), uv.y - uv.y.floor(), 0.25 + 0.5 * odd)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pair_differs_by_whole_turns_and_keeps_its_ranges() {
        for k in -300..300 {
            let kappa = k as f32 / 100.0 + 0.003;
            let pair = cyclic_pair(kappa);
            assert!((0.0..1.0).contains(&pair.x) && (0.5..1.5).contains(&pair.y));
            for value in [pair.x, pair.y] {
                assert!(((value - kappa) - (value - kappa).round()).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn a_normal_that_looks_away_lands_on_the_rim() {
        assert!((disc_normal(Vec3::new(0.3, 0.4, -0.2)).length() - 1.0).abs() < 1e-6);
        assert_eq!(disc_normal(Vec3::new(0.3, 0.4, 0.2)), Vec2::new(0.3, 0.4));
    }
}
