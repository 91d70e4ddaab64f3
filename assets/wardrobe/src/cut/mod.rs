//! Pieces cut flat: triangulated, with seams as pairs of vertices.

mod breaks;
mod lattice;
mod sample;
mod smooth;
mod triangulate;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use amc_core::{Error, Result};
use glam::DVec2;
use rayon::prelude::*;

use crate::body::Figure;
use crate::pattern::{Cloth, Pattern, Placement, Unfolded, WholePiece};

/// The least and the largest edge length, metres.
const EDGE_LENGTHS: [f64; 2] = [0.0005, 0.2];
/// The most triangles of a garment.
const MOST_TRIANGLES: f64 = 5e6;

/// Cuts a pattern's pieces out of cloth: each is triangulated with edges about `edge_length` long, metres, and vertex meets
/// vertex along every seam.
///
/// Corners, notches, ends of seams and places where a seam's other side has any of these are vertices; between them,
/// vertices are evenly spaced. Lines inside are edges of triangles. Interior vertices are near a regular hexagonal lattice.
///
/// # Errors
/// What [`Pattern::unfold`] finds, an edge length outside 0.5 mm to 0.2 m, or too coarse for a piece, or more than five million
/// triangles.
pub fn cut(pattern: &Pattern, edge_length: f64) -> Result<CutGarment> {
    let whole = pattern.unfold()?;
    check_edge_length(&whole, edge_length)?;
    let sampled = sample::sample(&whole, edge_length)?;
    let pieces: Vec<Result<CutPiece>> = whole
        .pieces
        .par_iter()
        .zip(&sampled.pieces)
        .map(|(piece, sampled)| {
            cut_piece(piece, sampled, edge_length)
                .map_err(|error| error.at_element(format!("piece '{}'", piece.name)))
        })
        .collect();
    let joins = sampled.joins(&whole);
    let Unfolded { name, figure, cloth, .. } = whole;
    Ok(CutGarment { name, figure, cloth, pieces: pieces.into_iter().collect::<Result<_>>()?, joins })
}

fn check_edge_length(whole: &Unfolded, edge_length: f64) -> Result<()> {
    if !(EDGE_LENGTHS[0]..=EDGE_LENGTHS[1]).contains(&edge_length) {
        let [least, most] = EDGE_LENGTHS;
        return Err(Error::invalid(format!(
            "an edge length of {edge_length} m; it is between {least} and {most} m"
        )));
    }
    let area: f64 = whole.pieces.iter().map(WholePiece::area).sum();
    let triangles = area / (edge_length * edge_length * 3f64.sqrt() / 4.0);
    if triangles > MOST_TRIANGLES {
        return Err(Error::too_large(format!("about {triangles:.0} triangles; at most {MOST_TRIANGLES}")));
    }
    Ok(())
}

/// Triangulates a piece between its sampled lines. A mirror image is triangulated as its original is.
fn cut_piece(piece: &WholePiece, sampled: &sample::SampledPiece, edge_length: f64) -> Result<CutPiece> {
    let flip = piece.mirror.is_some();
    let turned =
        |points: &[DVec2]| points.iter().map(|p| if flip { DVec2::new(-p.x, p.y) } else { *p }).collect();
    let mut outline = sampled.outline.clone();
    if flip {
        outline.reverse();
    }
    let boundary = triangulate::Boundary { points: turned(&sampled.points), outline, inner: &sampled.inner };
    let mesh = triangulate::triangulate(&boundary, edge_length)?;
    let triangles = mesh.triangles.iter().map(|&[a, b, c]| if flip { [a, c, b] } else { [a, b, c] });
    Ok(CutPiece {
        name: piece.name.clone(),
        flat: turned(&mesh.points),
        triangles: triangles.collect(),
        grain: piece.grain,
        cloth: piece.cloth,
        placement: piece.placement.clone(),
        lines: piece
            .lines
            .iter()
            .zip(&sampled.lines)
            .map(|(line, v)| (line.name.clone(), v.clone()))
            .collect(),
        folds: piece
            .folds
            .iter()
            .map(|fold| CutFold { vertices: sampled.lines[fold.line].clone(), angle: fold.angle })
            .collect(),
        mirror: piece.mirror,
    })
}

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
    /// Whether it is closed only once the others are.
    pub late: bool,
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
