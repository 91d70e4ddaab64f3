//! Directions made without UVs.

use glam::Vec3;

use super::Field;
use crate::{Error, Result};

/// Where the sine of the angle between a field and the normal is below this, the field has no direction there.
const LEAST_SINE: f32 = 1e-5;

impl Field {
    /// Whether it has a direction anywhere.
    ///
    /// # Errors
    /// A number that is not finite, or an axis of length zero.
    pub fn check(self) -> Result<()> {
        let (origin, axis) = match self {
            Self::Around { origin, direction } => (origin, direction),
            Self::Along { direction } => (Vec3::ZERO, direction),
            Self::Radial { origin } => (origin, Vec3::Y),
        };
        if !origin.is_finite() || !axis.is_finite() {
            return Err(Error::invalid("the field's origin or axis is not finite"));
        }
        if axis.try_normalize().is_none() {
            return Err(Error::invalid("the field's axis has no length"));
        }
        Ok(())
    }
}

/// A field and the angle that turns it about the normal, ready to be asked at many points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Procedural {
    field: Field,
    sin: f32,
    cos: f32,
}

impl Procedural {
    pub(super) fn new(field: Field, angle: f32) -> Self {
        let unit = |axis: Vec3| axis.normalize_or_zero();
        let field = match field {
            Field::Around { origin, direction } => Field::Around { origin, direction: unit(direction) },
            Field::Along { direction } => Field::Along { direction: unit(direction) },
            Field::Radial { origin } => Field::Radial { origin },
        };
        let (sin, cos) = angle.sin_cos();
        Self { field, sin, cos }
    }

    /// The unit direction at `position` in the plane perpendicular to the unit `normal`; zero where the field is zero
    /// or runs along the normal.
    pub(super) fn at(&self, position: Vec3, normal: Vec3) -> Vec3 {
        // A field's own length, against which its part in the tangent plane is judged.
        let (vector, length) = match self.field {
            Field::Around { origin, direction } => {
                let arm = position - origin;
                (direction.cross(arm), arm.length())
            }
            Field::Along { direction } => (direction, 1.0),
            Field::Radial { origin } => (position - origin, (position - origin).length()),
        };
        let flat = vector - normal * normal.dot(vector);
        if flat.length() <= LEAST_SINE * length {
            return Vec3::ZERO;
        }
        let unit = flat.normalize_or_zero();
        unit * self.cos + normal.cross(unit) * self.sin
    }
}
