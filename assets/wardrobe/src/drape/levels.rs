//! Cuts of one pattern from coarse to fine.

use amc_core::Result;

use crate::cut::{CutGarment, cut};
use crate::pattern::{Pattern, Placement};

/// Edge length of the coarsest cut, metres.
const COARSEST: f64 = 0.026;
/// Edges along a pleat that a piece is hung in, out and back, at least.
const EDGES_PER_PLEAT: f64 = 5.0;
/// How much finer each cut is than the one before, at most.
const FINER: f64 = 2.5;

/// The cuts that [`super::drape`] wants, the last with edges about `edge_length` long, metres.
///
/// # Errors
/// Those of [`cut`].
pub fn levels(pattern: &Pattern, edge_length: f64) -> Result<Vec<CutGarment>> {
    let pleats = pattern.unfold()?.pieces.into_iter().filter_map(|piece| match piece.placement {
        Placement::Hung(hang) => Some(hang.pleat / EDGES_PER_PLEAT),
        _ => None,
    });
    let coarsest = pleats.fold(COARSEST, f64::min);
    edge_lengths(edge_length, coarsest).into_iter().map(|edge_length| cut(pattern, edge_length)).collect()
}

fn edge_lengths(edge_length: f64, coarsest: f64) -> Vec<f64> {
    let steps = ((coarsest / edge_length).ln() / FINER.ln()).ceil().max(0.0);
    (0..=steps as i32)
        .rev()
        .map(|step| edge_length * (coarsest / edge_length).max(1.0).powf(f64::from(step) / steps.max(1.0)))
        .collect()
}

/// The edge length at which a pattern has about so many triangles, metres.
///
/// # Errors
/// Those of [`cut`].
pub fn edge_length_for(pattern: &Pattern, triangles: usize) -> Result<f64> {
    let area: f64 = pattern.unfold()?.pieces.iter().map(crate::pattern::WholePiece::area).sum();
    Ok((area / triangles.max(1) as f64 * 4.0 / 3f64.sqrt()).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_end_with_the_edge_asked_for_in_even_steps() {
        assert_eq!(edge_lengths(0.05, 0.026), [0.05]);
        let lengths = edge_lengths(0.003, 0.026);
        assert!(
            (lengths[0] - 0.026).abs() < 1e-12 && (lengths[lengths.len() - 1] - 0.003).abs() < 1e-12,
            "{lengths:?}"
        );
        for pair in lengths.windows(2) {
            assert!(pair[0] / pair[1] > 1.5 && pair[0] / pair[1] <= FINER + 1e-9, "{lengths:?}");
        }
    }
}
