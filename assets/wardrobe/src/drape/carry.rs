//! Places carried from a coarse cut to a finer one of the same pattern.

use amc_core::{Error, Result};
use glam::{DVec2, DVec3};

use super::Draped;
use super::grid::CellGrid;
use crate::cut::{CutGarment, CutPiece};

/// Where the finer cut's vertices lie on the coarse cut as it was draped: linear in each coarse triangle, and beyond its outline
/// as in the nearest triangle.
pub(super) fn carry(coarse: &CutGarment, draped: &Draped, fine: &CutGarment) -> Result<Vec<Vec<DVec3>>> {
    if coarse.pieces.len() != fine.pieces.len() {
        return Err(Error::invalid("the levels are cut from different patterns"));
    }
    let pieces = coarse.pieces.iter().zip(&draped.positions).zip(&fine.pieces);
    Ok(pieces.map(|((coarse, places), fine)| carry_piece(coarse, places, fine)).collect())
}

fn carry_piece(coarse: &CutPiece, places: &[DVec3], fine: &CutPiece) -> Vec<DVec3> {
    let edge = mean_edge(coarse);
    let grow = DVec3::new(edge, edge, 0.0);
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| coarse.flat[corner as usize]);
    let bounds = |triangle: &[u32; 3]| {
        let [a, b, c] = corners(triangle).map(|corner| corner.extend(0.0));
        (a.min(b).min(c) - grow, a.max(b).max(c) + grow)
    };
    let boxes: Vec<_> = coarse.triangles.iter().map(bounds).collect();
    let grid = CellGrid::new(&boxes, 2.0 * edge);
    let everywhere: Vec<u32> = (0..coarse.triangles.len() as u32).collect();
    let place = |flat: &DVec2| {
        let near: Vec<u32> = grid.at(flat.extend(0.0)).collect();
        let candidates = if near.is_empty() { &everywhere } else { &near };
        let mut best = (f64::NEG_INFINITY, DVec3::ZERO);
        for index in candidates {
            let triangle = &coarse.triangles[*index as usize];
            let Some(shares) = shares(*flat, corners(triangle)) else { continue };
            let inside = shares.iter().copied().fold(f64::INFINITY, f64::min);
            if inside > best.0 {
                best = (inside, (0..3).map(|i| places[triangle[i] as usize] * shares[i]).sum());
            }
        }
        best.1
    };
    fine.flat.iter().map(place).collect()
}

fn mean_edge(piece: &CutPiece) -> f64 {
    let lengths =
        piece.triangles.iter().map(|[a, b, _]| piece.flat[*a as usize].distance(piece.flat[*b as usize]));
    (lengths.sum::<f64>() / piece.triangles.len().max(1) as f64).max(1e-4)
}

/// Barycentric coordinates.
fn shares(point: DVec2, [a, b, c]: [DVec2; 3]) -> Option<[f64; 3]> {
    let area = (b - a).perp_dot(c - a);
    if area.abs() < 1e-14 {
        return None;
    }
    let (at_b, at_c) = ((point - a).perp_dot(c - a) / area, (b - a).perp_dot(point - a) / area);
    Some([1.0 - at_b - at_c, at_b, at_c])
}
