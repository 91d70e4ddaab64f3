//! The direction of the cloth on a garment: a unit tangent per vertex.
//!
//! Source: the paper's section 6 (the gradient of U, or a procedural field). What we add: the yarn source, an angle
//! per panel, means within a panel only, and what is done where the UV map has no area.

pub mod comb;
mod field;
mod fill;
mod kept;
mod orientation;
mod record;
mod tangents;
#[cfg(test)]
pub(crate) mod tests;

pub use kept::{Fineness, KeptTangents, PanelDirection, combed_tangents};
pub use orientation::Orientation;
pub use record::Record;
pub use tangents::{Tangents, tangents};

use glam::{Mat2, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::mesh::Panel;

/// Where a panel's direction comes from.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// `cos a grad U + sin a grad V`: the paper's (section 6).
    #[default]
    Gradient,
    /// `cos a dP/du + sin a dP/dv`: where the draped cloth is sheared, this is where the yarn really goes.
    Yarn,
    /// A procedural field, whatever the UVs say; the angle turns it about the normal.
    Field(Field),
}

/// Directions made without UVs, in object space. The paper's section 6: "or just procedurally".
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Field {
    /// Circles around an axis: `direction x (p - origin)`.
    Around {
        /// A point of the axis, metres.
        origin: Vec3,
        /// The axis.
        direction: Vec3,
    },
    /// Along a fixed direction, projected into the tangent plane.
    Along {
        /// The direction.
        direction: Vec3,
    },
    /// Away from a point, projected into the tangent plane.
    Radial {
        /// The point, metres.
        origin: Vec3,
    },
}

/// A panel's direction.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Direction {
    /// Where it comes from.
    pub source: Source,
    /// Radians in the flat pattern, counter-clockwise from +u as drawn with v up: 0 is the paper's grad U, a quarter
    /// turn swaps warp and weft.
    pub angle: f32,
}

impl Direction {
    /// Where the warp runs on the cloth laid flat: a unit vector. `uv_to_metres` takes UVs to metres there
    /// ([`crate::mesh::Garment::uv_to_metres`]). A procedural field has no one direction: its angle is counted from +u.
    pub fn on_cloth(&self, uv_to_metres: Mat2) -> Vec2 {
        let in_uvs = Vec2::from_angle(self.angle);
        let along = match self.source {
            Source::Gradient => uv_to_metres.inverse().transpose() * in_uvs,
            Source::Yarn | Source::Field(_) => uv_to_metres * in_uvs,
        };
        along.normalize_or(Vec2::X)
    }

    /// The direction of this source that runs along `along` on the cloth laid flat: the inverse of [`Direction::on_cloth`].
    pub fn along_cloth(source: Source, along: Vec2, uv_to_metres: Mat2) -> Self {
        let in_uvs = match source {
            Source::Gradient => uv_to_metres.transpose() * along,
            Source::Yarn | Source::Field(_) => uv_to_metres.inverse() * along,
        };
        Self { source, angle: in_uvs.to_angle() }
    }

    /// The direction of a panel that nobody has given one: along its grain, where the file says it, else along +u.
    pub fn along_grain(panel: &Panel) -> Self {
        Self { source: Source::default(), angle: panel.pattern.grain.unwrap_or_default() }
    }
}
