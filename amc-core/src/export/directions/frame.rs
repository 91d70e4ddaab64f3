//! How a panel's pattern is laid for the export: turned to its warp, in metres.

use glam::{Affine2, Mat2, Vec2};

use crate::Result;
use crate::direction::{self, Direction, Source, Tangents};
use crate::mesh::Garment;

/// A panel's pattern and what is done with it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// From the UVs to those that are exported first, v up: +u along the warp, +v along the weft, the origin in the middle.
    pub(super) turned: Affine2,
    /// Whether these count metres; else they are as the file has them.
    pub(super) in_metres: bool,
    /// Whether the direction is a field, whatever the pattern.
    pub(super) is_field: bool,
    /// Whether the direction is one in the flat pattern. It is not where it is a field, and where there are no UVs.
    pub(super) follows_pattern: bool,
    /// The warp on the flat cloth in its true proportions, as the UVs draw it: radians counter-clockwise from +u.
    pub(super) grain: Option<f32>,
    /// The yarns, counted in the UVs.
    yarns: [Direction; 2],
}

impl Frame {
    /// Of the panel `index`, in this direction.
    pub(super) fn new(garment: &Garment, index: usize, direction: &Direction, is_field: bool) -> Self {
        let to_cloth = garment.uv_to_drawn_metres(&garment.panels[index]).filter(|_| garment.has_uvs);
        let follows_pattern = to_cloth.is_some() && !is_field;
        let matrix = to_cloth.map_or(Mat2::IDENTITY, |to_cloth| to_cloth.matrix2);
        let along = if follows_pattern { direction.on_cloth(matrix) } else { Vec2::X };
        // Conjugated: the turn that takes the warp to +u.
        let turn = Mat2::from_cols(along, along.perp()).transpose();
        let yarn = |along| Direction::along_cloth(Source::Yarn, along, matrix);
        Self {
            turned: Affine2::from_mat2(turn) * to_cloth.unwrap_or(Affine2::IDENTITY),
            in_metres: to_cloth.is_some(),
            is_field,
            follows_pattern,
            grain: follows_pattern.then(|| along.to_angle()),
            yarns: [along, along.perp()].map(yarn),
        }
    }
}

/// Warp and weft of the draped cloth at every vertex, each in the tangent plane: dP/du and dP/dv of the turned UVs. Where
/// the direction is not one in the pattern the two are meant for nothing.
///
/// # Errors
/// As [`direction::tangents`].
pub(super) fn yarns(garment: &Garment, frames: &[Frame]) -> Result<[Tangents; 2]> {
    let along = |yarn: usize| {
        let directions: Vec<Direction> = frames.iter().map(|frame| frame.yarns[yarn]).collect();
        direction::tangents(garment, &directions)
    };
    Ok([along(0)?, along(1)?])
}
