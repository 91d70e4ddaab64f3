//! What a reader hands over: arrays as the file has them, not yet checked.

use std::ops::Range;

use glam::{Vec2, Vec3};

use super::{NAME_LIMIT, Part};
use crate::{Error, Result};

/// Largest coordinate, in metres or whatever the file counts in: beyond it areas leave the range of `f32`.
pub(super) const COORDINATE_LIMIT: f32 = 1e8;

/// A mesh as read: every index in range, every position and UV finite; nothing else is sure.
#[derive(Debug, Default)]
pub(super) struct Draft {
    /// Within [`COORDINATE_LIMIT`].
    pub(super) positions: Vec<Vec3>,
    /// One per position; zeros where there are none.
    pub(super) normals: Vec<Vec3>,
    /// One per position; zeros where there are none.
    pub(super) uvs: Vec<Vec2>,
    /// Indices into all positions.
    pub(super) triangles: Vec<[u32; 3]>,
    /// One after the other, without gaps, in the order of their vertices and triangles.
    pub(super) parts: Vec<DraftPart>,
    pub(super) file_vertices: usize,
    pub(super) notices: Vec<String>,
}

/// A part of a [`Draft`]: its triangles use its vertices only.
#[derive(Debug, Default)]
pub(super) struct DraftPart {
    pub(super) part: Part,
    pub(super) vertices: Range<usize>,
    pub(super) triangles: Range<usize>,
    pub(super) has_normals: bool,
    pub(super) has_uvs: bool,
}

/// Refuses a position that is not finite or beyond the limit.
pub(super) fn check_position(position: Vec3) -> Result<()> {
    if !position.is_finite() {
        return Err(Error::invalid("a position that is not a finite number"));
    }
    if !is_within_limit(position) {
        return Err(Error::invalid(format!("a coordinate beyond the limit of {COORDINATE_LIMIT:e}")));
    }
    Ok(())
}

/// Whether a position is finite and within the limit.
pub(super) fn is_within_limit(position: Vec3) -> bool {
    // What is not a number fails the comparison too.
    position.abs().cmple(Vec3::splat(COORDINATE_LIMIT)).all()
}

/// A name from a file, fit to be shown: one line, no control characters, not too long.
pub(super) fn clean_name(name: &str) -> String {
    let shown: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).take(NAME_LIMIT).collect();
    shown.trim().to_owned()
}
