//! Sewing and draping.

use glam::DVec3;

/// A garment sewn and at rest: for each piece, where its vertices came to lie, metres, y up.
#[derive(Debug, Clone)]
pub struct Draped {
    /// `[piece][vertex]`, as [`crate::cut::CutPiece::flat`].
    pub positions: Vec<Vec<DVec3>>,
}
