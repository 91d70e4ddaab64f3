//! What garments are draped on: simple shapes as signed distances.

use serde::{Deserialize, Serialize};

/// What a garment is draped on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// A standing adult, 1.75 m, arms held away from the sides. Feet at y = 0, front towards +z, the wearer's left at +x.
    ///
    /// Limbs to wrap pieces round: `torso` (start: the neck's root), `neck` (start: the chin), `left arm`, `right arm` (start: the shoulder joint), `left leg`,
    /// `right leg` (start: the hip joint).
    Standing,
    /// A ball of 0.3 m radius, centre at y = 1 m. No limbs.
    Ball,
}
