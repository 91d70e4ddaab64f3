//! Cuts of one pattern from coarse to fine.

use amc_core::Result;

use crate::cut::{CutGarment, cut};
use crate::pattern::Pattern;

/// Edge length of the coarsest cut, metres.
const COARSEST: f64 = 0.026;
/// How much finer each cut is than the one before, at most.
const FINER: f64 = 2.5;

/// The cuts that [`super::drape`] wants, the last with edges about `edge_length` long, metres.
///
/// # Errors
/// Those of [`cut`].
pub fn levels(pattern: &Pattern, edge_length: f64) -> Result<Vec<CutGarment>> {
    edge_lengths(edge_length).into_iter().map(|edge_length| cut(pattern, edge_length)).collect()
}

fn edge_lengths(edge_length: f64) -> Vec<f64> {
    let steps = ((COARSEST / edge_length).ln() / FINER.ln()).ceil().max(0.0);
    (0..=steps as i32).rev().map(|step| edge_length * (COARSEST / edge_length).max(1.0).powf(f64::from(step) / steps.max(1.0))).collect()
}

/// The edge length at which a pattern has about so many triangles, metres.
///
/// # Errors
/// Those of [`cut`].
pub fn edge_length_for(pattern: &Pattern, triangles: usize) -> Result<f64> {
    let area: f64 = pattern.unfold()?.pieces.iter().map(crate::pattern::WholePiece::area).sum();
    Ok((area / triangles.max(1) as f64 * 4.0 / 3f64.sqrt()).sqrt())
}
