//! Pieces cut flat: triangulated, with seams as pairs of vertices.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::body::Figure;
use crate::pattern::{Cloth, Placement};

/// A garment's pieces, triangulated flat and not yet sewn.
#[derive(Debug, Clone)]
pub struct CutGarment {
    /// The garment's name, as its pattern has it.
    pub name: String,
    /// What it is draped on.
    pub figure: Figure,
    /// How its cloth resists; a piece may have its own.
    pub cloth: Cloth,
    /// The pieces.
    pub pieces: Vec<CutPiece>,
    /// What is sewn or buttoned to what.
    pub joins: Vec<Join>,
}

/// One piece of cloth, flat.
#[derive(Debug, Clone)]
pub struct CutPiece {
    /// Its name, as its pattern has it: the panel's name.
    pub name: String,
    /// Its vertices, metres, as drawn from the cloth's right side, v up. These are its UVs.
    pub flat: Vec<DVec2>,
    /// Corners, counter-clockwise as drawn: indices of `flat`.
    pub triangles: Vec<[u32; 3]>,
    /// The warp's direction, radians counter-clockwise from +u.
    pub grain: f64,
    /// Its own cloth, where it is another than the garment's (an interfaced collar).
    pub cloth: Option<Cloth>,
    /// Where it lies before it is sewn.
    pub placement: Placement,
    /// Every named edge of its outline, and every named line inside: vertices in order, both ends included.
    pub lines: BTreeMap<String, Vec<u32>>,
    /// Lines along which it is folded.
    pub folds: Vec<CutFold>,
    /// The piece of which this is the mirror image: its index.
    pub mirror: Option<usize>,
}

/// A line along which a piece is folded.
#[derive(Debug, Clone)]
pub struct CutFold {
    /// Its vertices in order; neighbours share a triangle's edge.
    pub vertices: Vec<u32>,
    /// How far it is folded, radians: 0 flat, positive where the two right sides move apart (the fold points to the right
    /// side, as a shirt collar's), negative where they move together.
    pub angle: f64,
}

/// A vertex of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct At {
    /// Index of the piece.
    pub piece: u32,
    /// Index of the vertex in [`CutPiece::flat`].
    pub vertex: u32,
}

/// Vertices that are brought together.
#[derive(Debug, Clone)]
pub struct Join {
    /// The seam's name, as the pattern has it.
    pub name: String,
    /// Sewn or buttoned.
    pub kind: JoinKind,
    /// Which vertex meets which, in order along the seam. The two sides have equally many vertices: ease is spread by
    /// where they lie.
    pub pairs: Vec<(At, At)>,
    /// The named lines that are joined: piece, line.
    pub sides: [Vec<(usize, String)>; 2],
}

/// How two lines are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JoinKind {
    /// The vertices become one.
    Sewn,
    /// The vertices stay two, one layer of cloth apart: a button, a pocket's topstitch.
    Layered,
}
