//! Tangent frames of vertices.

use faer::c64;
use glam::{DVec3, Vec3};

use super::Complex;

/// Normals further apart than the angle whose cosine this is have no least rotation.
const OPPOSED: f64 = -1.0 + 1e-9;

/// A right-handed frame: `x`, `normal x x`, `normal`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) normal: DVec3,
    pub(super) x: DVec3,
}

impl Frame {
    /// `normal` is a unit vector.
    pub(super) fn new(normal: DVec3) -> Self {
        Self { normal, x: normal.any_orthonormal_vector() }
    }

    /// The part of a vector in the tangent plane.
    pub(super) fn coordinates(&self, vector: DVec3) -> Complex {
        c64::new(vector.dot(self.x), vector.dot(self.normal.cross(self.x)))
    }

    /// The direction of a vector's part in the tangent plane; none where there is next to nothing of it.
    pub(super) fn direction(&self, vector: DVec3) -> Option<Complex> {
        unit(self.coordinates(vector.try_normalize()?))
    }

    /// The tangent of given coordinates, object space.
    pub(super) fn vector(&self, z: Complex) -> DVec3 {
        self.x * z.re + self.normal.cross(self.x) * z.im
    }

    /// What takes coordinates in this frame to those in `other` by the least rotation between the normals; `along` goes from
    /// here to there, and says how to turn where the normals are opposed, as across a sharp fold.
    pub(super) fn turn_to(&self, other: &Self, along: DVec3) -> Complex {
        let turned = turn(self.x, self.normal, other.normal, along);
        unit(other.coordinates(turned)).unwrap_or(c64::new(1.0, 0.0))
    }
}

/// `tangent`, perpendicular to the unit vector `from`, turned by the least rotation that takes `from` to the unit vector `to`.
pub(super) fn turn(tangent: DVec3, from: DVec3, to: DVec3, along: DVec3) -> DVec3 {
    let cos = from.dot(to);
    if cos > OPPOSED {
        return tangent - (from + to) * (to.dot(tangent) / (1.0 + cos));
    }
    // Half a turn about the fold, which runs across the way taken.
    let ahead = (along - from * from.dot(along)).try_normalize();
    let ahead = ahead.unwrap_or_else(|| from.any_orthonormal_vector());
    tangent - ahead * (2.0 * ahead.dot(tangent))
}

/// [`turn`] of single-precision normals, made perpendicular to the second.
pub(super) fn turn_onto(tangent: DVec3, from: DVec3, to: Vec3) -> Vec3 {
    crate::view_space::perpendicular(turn(tangent, from, to.as_dvec3(), DVec3::ZERO).as_vec3(), to)
}

/// The complex number of length 1 with the same angle; none for what is next to zero, or not finite.
pub(super) fn unit(z: Complex) -> Option<Complex> {
    let length = z.re.hypot(z.im);
    (length > 1e-9 && length.is_finite()).then(|| z / length)
}
