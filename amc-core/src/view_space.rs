//! Directions in view space: right-handed, +x right, +y up, +z towards the viewer.
//!
//! The normal `n` and the tangent `t` are unit vectors; `phi`, the tangent azimuth, is in radians. Every function
//! here has a twin of the same name in `shaders/view_space.wgsl`.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// What the azimuth of a tangent means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Azimuth {
    /// The angle of `t` after the least rotation that takes `n` to +z. A turn of the cloth about its own normal is a
    /// shift along the table's axis, exactly, at every normal. (Ours; the paper has only the other.)
    #[default]
    Transported,
    /// The angle of `t` as it is projected on the picture (Anisotropic MatCap 2016, equation 3).
    Projected,
}

/// The unit vector along `t` made perpendicular to the unit vector `n`.
///
/// Where `t` is parallel to `n` (or zero) there is no such direction: any perpendicular of `n` is returned.
pub fn perpendicular(t: Vec3, n: Vec3) -> Vec3 {
    (t - n * n.dot(t)).try_normalize().unwrap_or_else(|| n.any_orthonormal_vector())
}

/// `x` turned by the least rotation that takes the unit vector `a` to +z.
///
/// Undefined at `a` = -z: there the denominator is held at 1e-6.
pub fn turn_to_z(x: Vec3, a: Vec3) -> Vec3 {
    let a_dot_x = a.dot(x);
    x - (a + Vec3::Z) * ((a_dot_x + x.z) / (1.0 + a.z).max(1e-6)) + Vec3::Z * (2.0 * a_dot_x)
}

/// `x` turned by the least rotation that takes +z to the unit vector `a`: the inverse of [`turn_to_z`].
pub fn turn_from_z(x: Vec3, a: Vec3) -> Vec3 {
    let a_dot_x = a.dot(x);
    x - (a + Vec3::Z) * ((a_dot_x + x.z) / (1.0 + a.z).max(1e-6)) + a * (2.0 * x.z)
}

/// The transported azimuth of the tangent `t` at the normal `n`, in (-pi, pi].
pub fn transported_azimuth(n: Vec3, t: Vec3) -> f32 {
    let s = t.z / (1.0 + n.z).max(1e-6);
    (t.y - n.y * s).atan2(t.x - n.x * s)
}

/// The projected azimuth of the tangent `t`, in (-pi, pi]; 0 where `t` points at the eye.
pub fn projected_azimuth(t: Vec3) -> f32 {
    t.y.atan2(t.x)
}

impl Azimuth {
    /// The azimuth of the tangent `t` at the normal `n`, in (-pi, pi].
    pub fn of(self, n: Vec3, t: Vec3) -> f32 {
        match self {
            Self::Transported => transported_azimuth(n, t),
            Self::Projected => projected_azimuth(t),
        }
    }

    /// The unit tangent perpendicular to `n` (with `n.z >= 0`) whose azimuth is `phi`.
    pub fn tangent(self, n: Vec3, phi: f32) -> Vec3 {
        let (sin, cos) = phi.sin_cos();
        match self {
            Self::Transported => turn_from_z(Vec3::new(cos, sin, 0.0), n),
            // (cos, sin, z) . n = 0, scaled by n.z so that the rim needs no division.
            Self::Projected => Vec3::new(cos * n.z, sin * n.z, -(n.x * cos + n.y * sin))
                .try_normalize()
                .unwrap_or_else(|| perpendicular(Vec3::new(cos, sin, 0.0), n)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    fn normals() -> impl Iterator<Item = Vec3> {
        (0..200).map(|k| {
            // A spiral over the hemisphere that looks at the viewer.
            let z = (k as f32 + 0.5) / 200.0;
            let r = (1.0 - z * z).sqrt();
            let a = k as f32 * 2.399_963;
            Vec3::new(r * a.cos(), r * a.sin(), z)
        })
    }

    #[test]
    fn turning_is_a_rotation_that_takes_a_to_z_and_back() {
        for a in normals() {
            assert!((turn_to_z(a, a) - Vec3::Z).length() < 1e-5);
            assert!((turn_from_z(Vec3::Z, a) - a).length() < 1e-5);
            let x = Vec3::new(0.3, -0.5, 0.8);
            assert!((turn_from_z(turn_to_z(x, a), a) - x).length() < 1e-5);
            // Least rotation: the axis a x z stays where it is.
            let axis = a.cross(Vec3::Z);
            assert!((turn_to_z(axis, a) - axis).length() < 1e-5);
        }
    }

    #[test]
    fn a_tangent_of_an_azimuth_has_that_azimuth() {
        for definition in [Azimuth::Transported, Azimuth::Projected] {
            for n in normals() {
                for k in 0..16 {
                    let phi = k as f32 * PI / 8.0 - PI + 0.01;
                    let t = definition.tangent(n, phi);
                    assert!(t.dot(n).abs() < 1e-5 && (t.length() - 1.0).abs() < 1e-5);
                    let back = definition.of(n, t);
                    assert!(
                        ((back - phi).sin()).abs() < 1e-3 && (back - phi).cos() > 0.0,
                        "{definition:?} {n} {phi} {back}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_turn_of_the_cloth_about_its_normal_shifts_the_transported_azimuth() {
        for n in normals() {
            let t = Azimuth::Transported.tangent(n, 0.4);
            let turned = t * 0.7f32.cos() + n.cross(t) * 0.7f32.sin();
            assert!((transported_azimuth(n, turned) - 1.1).abs() < 1e-4);
        }
    }
}
