//! Sewing and draping.

mod carry;
mod colour;
pub(crate) mod grid;
mod hinge;
mod layers;
mod levels;
mod membrane;
mod model;
mod phases;
mod place;
mod points;
mod sewing;
mod solver;
mod tangle;
#[cfg(test)]
mod tests;

use amc_core::{Error, Progress, Result};
use glam::DVec3;

use crate::body::Body;
use crate::cut::CutGarment;

pub use levels::{edge_length_for, levels};
pub use phases::{Options, Rest};
pub use solver::Energy;

/// A garment sewn and at rest: for each piece, where its vertices came to lie, metres, y up.
#[derive(Debug, Clone)]
pub struct Draped {
    /// `[piece][vertex]`, as [`crate::cut::CutPiece::flat`].
    pub positions: Vec<Vec<DVec3>>,
}

/// Sews and drapes a garment, and tells how it came to rest.
///
/// `levels` are cuts of one pattern, from coarse to fine: the first is placed, sewn and left to fall, each further one starts where
/// the one before came to lie. The result is of the last. The same cuts give the same places whatever the number of threads.
///
/// # Errors
/// Cancelled; no cut at all; levels of different patterns; a piece wrapped round a limb that the figure does not have; a
/// seam that does not close; a cloth that gives way to nothing (not finite, or not positive).
pub fn drape(
    levels: &[CutGarment],
    body: &Body,
    options: &Options,
    progress: &Progress<'_>,
) -> Result<(Draped, Rest)> {
    let Some((coarsest, finer)) = levels.split_first() else {
        return Err(Error::invalid("there is no garment to drape"));
    };
    levels.iter().try_for_each(check)?;
    // Inside the pool each parallel step is a steal, outside it would be a wake-up.
    rayon::scope(|_| drape_levels(coarsest, finer, body, options, progress))
}

/// Leaves a draped garment lying for `seconds` more, and tells whether it still moves and how its energy goes.
///
/// # Errors
/// Cancelled, places that are not of this cut, or a cloth that flies apart.
pub fn linger(
    garment: &CutGarment,
    draped: &Draped,
    body: &Body,
    seconds: f64,
    options: &Options,
    progress: &Progress<'_>,
) -> Result<Rest> {
    check(garment)?;
    let counts = garment.pieces.iter().map(|piece| piece.flat.len());
    if !counts.eq(draped.positions.iter().map(Vec::len)) {
        return Err(Error::invalid("the places are not of this cut: draped from another one"));
    }
    rayon::scope(|_| phases::linger(garment, draped, body, options, seconds, progress))
}

fn drape_levels(
    coarsest: &CutGarment,
    finer: &[CutGarment],
    body: &Body,
    options: &Options,
    progress: &Progress<'_>,
) -> Result<(Draped, Rest)> {
    let (mut draped, mut rest) = phases::sew_and_drape(coarsest, body, options, progress)?;
    let mut before = coarsest;
    for finer in finer {
        let start = carry::carry(before, &draped, finer)?;
        (draped, rest) = phases::relax(finer, &start, body, options, progress)?;
        before = finer;
    }
    Ok((draped, rest))
}

fn check(garment: &CutGarment) -> Result<()> {
    let cloths = garment
        .pieces
        .iter()
        .map(|piece| (piece.name.as_str(), piece.cloth.as_ref().unwrap_or(&garment.cloth)));
    for (name, cloth) in cloths {
        let positive = [cloth.density, cloth.warp, cloth.weft, cloth.shear, cloth.bending];
        let sound = positive.iter().all(|value| value.is_finite() && *value > 0.0);
        if !sound || !cloth.friction.is_finite() || cloth.friction < 0.0 {
            let what = "density, warp, weft, shear and bending must be positive, friction not negative";
            return Err(Error::invalid(what).at_element(format!("cloth of piece \"{name}\"")));
        }
    }
    Ok(())
}
