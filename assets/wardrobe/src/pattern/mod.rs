//! Patterns: a garment's flat pieces as data.
//!
//! A pattern file is JSON, one [`Pattern`]. Lengths are metres, angles degrees. A piece is drawn as it lies on the table with the
//! right side of the cloth up: u to the right, v up, its outline counter-clockwise. What a file may hold is said by
//! [`Pattern`], [`Piece`] and [`Seam`], field by field; [`Pattern::unfold`] checks it and writes every piece and seam out whole.

mod check;
mod cloth;
pub(crate) mod crossing;
mod data;
mod hang;
mod line;
mod mirror;
mod path;
mod placement;
mod seam_check;
mod unfold;

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
pub use unfold::{SidePart, Unfolded, WholeFold, WholeNotch, WholePiece, WholeSeam};

/// Shorter distances than this count as none when outlines are closed and lines meet, metres.
pub(crate) const CLOSE: f64 = 1e-4;
