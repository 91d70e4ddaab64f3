//! Patterns: a garment's flat pieces as data.
//!
//! A pattern file is JSON, one [`Pattern`]. Lengths are metres, angles degrees. A piece is drawn as it lies on the table
//! with the right side of the cloth up: u to the right, v up, its outline counter-clockwise. What a file may hold is said
//! by [`Pattern`], [`Piece`] and [`Seam`], field by field; [`Pattern::unfold`] checks it and writes every piece and seam
//! out whole.
//!
//! A skirt of two equal pieces, each given by its right-hand half, which is the wearer's left at the front and the right
//! at the back:
//!
//! ```
//! let pattern = wardrobe::pattern::Pattern::from_json(r#"{
//!   "version": 1, "name": "skirt", "figure": "standing",
//!   "pieces": [
//!     { "name": "front", "mirrored": true, "grain_deg": 90, "start": [0, 0],
//!       "outline": [
//!         { "name": "hem", "path": [[0.35, 0.03]] },
//!         { "name": "left side", "path": [[0.25, 0.4], { "curve": [[0.24, 0.46], [0.22, 0.52], [0.2, 0.56]] }] },
//!         { "name": "waist", "path": [{ "arc": [[0.1, 0.545], [0, 0.54]] }] } ],
//!       "notches": [{ "edge": "left side", "at": 0.7 }],
//!       "placement": { "kind": "around", "limb": "torso", "point": [0, 0.54], "along": 0.4, "angle_deg": 0, "radius": 0.17 } },
//!     { "name": "back", "mirrored": true, "grain_deg": 90, "start": [0, 0],
//!       "outline": [
//!         { "name": "hem", "path": [[0.35, 0.03]] },
//!         { "name": "right side", "path": [[0.25, 0.4], { "curve": [[0.24, 0.46], [0.22, 0.52], [0.2, 0.56]] }] },
//!         { "name": "waist", "path": [{ "arc": [[0.1, 0.545], [0, 0.54]] }] } ],
//!       "placement": { "kind": "around", "limb": "torso", "point": [0, 0.54], "along": 0.4, "angle_deg": 180, "radius": 0.17 } }
//!   ],
//!   "seams": [
//!     { "name": "left side", "mirrored": true, "a": ["front: left side"], "b": ["back: left side"] }
//!   ]
//! }"#)?;
//! let whole = pattern.unfold()?;
//! assert_eq!((whole.pieces.len(), whole.seams.len()), (2, 2));
//! # Ok::<(), amc_core::Error>(())
//! ```

mod check;
mod cloth;
pub(crate) mod crossing;
mod data;
mod draw;
mod halves;
mod hang;
mod line;
mod mirror;
mod path;
mod placement;
mod seam_check;
mod unfold;
mod whole;

#[cfg(test)]
pub(crate) mod tests;

pub use cloth::Cloth;
pub use data::{
    Edge, Fold, FoldPlace, InnerLine, LinePart, Notch, Pattern, Piece, Points, Seam, SeamKind, SeamPart,
    Segment,
};
pub use hang::{Hang, Station};
pub use line::{Line, LineKind};
pub use placement::Placement;
pub use whole::{SidePart, Unfolded, WholeFold, WholeNotch, WholePiece, WholeSeam};

/// Shorter distances than this count as none when outlines are closed and lines meet, metres.
pub(crate) const CLOSE: f64 = 1e-4;
