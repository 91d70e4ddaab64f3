//! Patterns written out whole.

use glam::DVec2;

use super::{Cloth, Line, LineKind, Placement, SeamKind, crossing};
use crate::body::Figure;

/// A pattern, checked, with every piece and every seam written out whole.
#[derive(Debug, Clone)]
pub struct Unfolded {
    /// The garment's name.
    pub name: String,
    /// What it is draped on.
    pub figure: Figure,
    /// The cloth of every piece that has none of its own.
    pub cloth: Cloth,
    /// The pieces.
    pub pieces: Vec<WholePiece>,
    /// The seams, mirror images after their originals.
    pub seams: Vec<WholeSeam>,
}

/// A whole piece.
#[derive(Debug, Clone)]
pub struct WholePiece {
    /// Its name.
    pub name: String,
    /// The warp's direction, radians counter-clockwise from +u.
    pub grain: f64,
    /// Its lines: the edges of the outline first, counter-clockwise, then the lines and the points inside.
    pub lines: Vec<Line>,
    /// The marks on its edges.
    pub notches: Vec<WholeNotch>,
    /// Where it is folded.
    pub folds: Vec<WholeFold>,
    /// Where it lies before it is sewn.
    pub placement: Placement,
    /// Its own cloth.
    pub cloth: Option<Cloth>,
    /// The piece of which it is the mirror image: its index.
    pub mirror: Option<usize>,
}

/// A mark on an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeNotch {
    /// Its name; may be empty.
    pub name: String,
    /// The edge: an index of [`WholePiece::lines`].
    pub line: usize,
    /// How far along the edge, metres.
    pub along: f64,
}

/// A line along which a piece is folded.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeFold {
    /// The line: an index of [`WholePiece::lines`].
    pub line: usize,
    /// How far, radians: positive where the two right sides move apart.
    pub angle: f64,
}

/// A seam between lines of whole pieces.
#[derive(Debug, Clone)]
pub struct WholeSeam {
    /// Its name.
    pub name: String,
    /// How it is joined.
    pub kind: SeamKind,
    /// The two sides, in the order of sewing.
    pub sides: [Vec<SidePart>; 2],
    /// Where the ease starts and ends: which side is longer, and the distances along it, metres. `None`: evenly spread.
    pub between: Option<(usize, [f64; 2])>,
    /// Whether it is closed only once the others are.
    pub late: bool,
}

/// A part of a line on one side of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SidePart {
    /// Index of the piece.
    pub piece: usize,
    /// Index of the line in [`WholePiece::lines`].
    pub line: usize,
    /// The part's lower end, metres along the line.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// Whether it is sewn from `to` to `from`.
    pub backwards: bool,
}

impl SidePart {
    /// Its length, metres.
    pub fn length(&self) -> f64 {
        self.to - self.from
    }
}

impl WholeSeam {
    /// The length of each side, metres.
    pub fn lengths(&self) -> [f64; 2] {
        self.sides.each_ref().map(|side| side.iter().map(SidePart::length).sum())
    }
}

impl WholePiece {
    /// The edges of its outline, counter-clockwise.
    pub fn outline(&self) -> &[Line] {
        let count = self.lines.iter().take_while(|line| line.kind == LineKind::Edge).count();
        &self.lines[..count]
    }

    /// Its area, square metres.
    pub fn area(&self) -> f64 {
        crossing::area(&self.polygon())
    }

    /// The outline's points, each once.
    pub fn polygon(&self) -> Vec<DVec2> {
        self.outline().iter().flat_map(|edge| &edge.points[..edge.points.len() - 1]).copied().collect()
    }
}
