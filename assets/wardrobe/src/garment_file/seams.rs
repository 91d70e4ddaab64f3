//! A garment's joins as the seams of its pieces.

use std::collections::BTreeSet;

use amc_core::mesh::Seam;
use amc_core::{Error, Result};
use glam::Vec2;

use super::uv;
use crate::cut::{At, CutGarment, CutPiece};

/// The seams of every piece. A join along several pieces, as of a sleeve to front and back, is a seam with each. What
/// meets in single points only, as at buttons, is no seam.
///
/// # Errors
/// A join of a piece or vertex that is not there; the error names the join.
pub(super) fn seams(cut: &CutGarment) -> Result<Vec<Vec<Seam<String>>>> {
    let outlines: Vec<BTreeSet<[u32; 2]>> = cut.pieces.iter().map(outline).collect();
    let mut seams = vec![Vec::new(); cut.pieces.len()];
    for join in &cut.joins {
        let is_there =
            |at: At| cut.pieces.get(at.piece as usize).is_some_and(|p| (at.vertex as usize) < p.flat.len());
        if !join.pairs.iter().all(|&(one, other)| is_there(one) && is_there(other)) {
            let message = "joins a vertex that is not there";
            return Err(Error::invalid(message).at_element(format!("seam '{}'", join.name)));
        }
        let same = |a: &(At, At), b: &(At, At)| (a.0.piece, a.1.piece) == (b.0.piece, b.1.piece);
        for run in join.pairs.chunk_by(same).filter(|run| run.len() > 1) {
            let (one, other): (Vec<At>, Vec<At>) = run.iter().copied().unzip();
            for (here, there) in [(&one, &other), (&other, &one)] {
                let piece = here[0].piece as usize;
                let seam = seam(cut, &join.name, here, there, &outlines[piece]);
                seams[piece].push(seam);
            }
        }
    }
    Ok(seams)
}

/// One side of a run of a join: from the end where it begins counter-clockwise.
fn seam(
    cut: &CutGarment,
    name: &str,
    here: &[At],
    there: &[At],
    outline: &BTreeSet<[u32; 2]>,
) -> Seam<String> {
    let backwards = here.windows(2).any(|pair| outline.contains(&[pair[1].vertex, pair[0].vertex]));
    let ends = |side: &[At]| -> [Vec2; 2] {
        let at = |k: usize| uv(cut.pieces[side[k].piece as usize].flat[side[k].vertex as usize]);
        let (first, last) = (at(0), at(side.len() - 1));
        if backwards { [last, first] } else { [first, last] }
    };
    Seam {
        name: name.to_owned(),
        edge: ends(here),
        partner: cut.pieces[there[0].piece as usize].name.clone(),
        partner_edge: ends(there),
    }
}

/// The edges of a piece's outline, counter-clockwise: those of its triangles that no other triangle has the other way.
fn outline(piece: &CutPiece) -> BTreeSet<[u32; 2]> {
    let edges = || piece.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let all: BTreeSet<[u32; 2]> = edges().collect();
    edges().filter(|[a, b]| !all.contains(&[*b, *a])).collect()
}
