//! A sparse Hermitian positive system whose structure stays while its values change.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use super::Complex;
use super::edges::ZERO;
use crate::{Error, Result};

/// Most numbers in a factor: 4 GiB. A panel of some 3 million vertices has that many.
const MOST_NUMBERS: usize = 1 << 28;

/// The structure, the order of elimination, and the last factor.
pub(super) struct System {
    structure: SymbolicSparseColMat<u32>,
    symbolic: SymbolicCholesky<u32>,
    /// Of the last factor; empty before the first.
    values: Vec<Complex>,
    factor: Vec<Complex>,
}

impl std::fmt::Debug for System {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("System").field("factor", &self.factor.len()).finish_non_exhaustive()
    }
}

impl System {
    /// Of the upper half's off-diagonal places: column `j` has the rows `rows[starts[j]..starts[j + 1]]`, ascending, below j.
    ///
    /// # Errors
    /// More places than memory, or 32 bits, can hold.
    pub(super) fn new(starts: &[u32], rows: &[u32]) -> Result<Self> {
        let count = starts.len().saturating_sub(1);
        let (mut column_starts, mut all) = (vec![0u32], Vec::with_capacity(rows.len() + count));
        for column in 0..count {
            all.extend_from_slice(&rows[starts[column] as usize..starts[column + 1] as usize]);
            all.push(column as u32);
            column_starts.push(all.len() as u32);
        }
        let structure = SymbolicSparseColMat::new_checked(count, count, column_starts, None, all);
        let symbolic = factorize_symbolic_cholesky(
            structure.as_ref(),
            Side::Upper,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| too_large(count))?;
        if symbolic.len_val() > MOST_NUMBERS {
            return Err(too_large(count));
        }
        Ok(Self { structure, symbolic, values: Vec::new(), factor: Vec::new() })
    }

    /// Makes ready to solve with the given values, column by column, the diagonal last in each. Does nothing
    /// where they are those of the last time. Returns whether there was something to do.
    ///
    /// # Errors
    /// Too little memory, or a matrix that is not positive, which none is whose vertices all hang on some demand.
    pub(super) fn factor(&mut self, values: Vec<Complex>) -> Result<bool> {
        if !self.factor.is_empty() && self.values == values {
            return Ok(false);
        }
        let count = self.symbolic.nrows();
        // Half a factor must not be taken for a whole one.
        self.values.clear();
        let length = self.symbolic.len_val();
        let mut factor = std::mem::take(&mut self.factor);
        factor.try_reserve_exact(length.saturating_sub(factor.len())).map_err(|_| too_large(count))?;
        factor.clear();
        factor.resize(length, ZERO);
        let matrix = SparseColMatRef::new(self.structure.as_ref(), &values[..]);
        let needs = self.symbolic.factorize_numeric_llt_scratch::<Complex>(Par::Seq, Default::default());
        let mut memory = memory(needs, count)?;
        self.symbolic
            .factorize_numeric_llt(
                &mut factor,
                matrix,
                Side::Upper,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| not_positive())?;
        (self.factor, self.values) = (factor, values);
        Ok(true)
    }

    /// Solves with the last factor, in place.
    ///
    /// # Errors
    /// Too little memory, no factor, or a solution that is not finite.
    pub(super) fn solve(&self, right: &mut [Complex]) -> Result<()> {
        let count = self.symbolic.nrows();
        if self.factor.len() != self.symbolic.len_val() || right.len() != count {
            return Err(not_positive());
        }
        let mut memory = memory(self.symbolic.solve_in_place_scratch::<Complex>(1, Par::Seq), count)?;
        let columns = MatMut::from_column_major_slice_mut(right, count, 1);
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            columns,
            Par::Seq,
            MemStack::new(&mut memory),
        );
        if right.iter().all(|z| z.re.is_finite() && z.im.is_finite()) { Ok(()) } else { Err(not_positive()) }
    }
}

fn memory(needs: StackReq, count: usize) -> Result<MemBuffer> {
    MemBuffer::try_new(needs).map_err(|_| too_large(count))
}

fn too_large(count: usize) -> Error {
    Error::too_large(format!("the panel's {count} vertices are too many to be combed: comb a coarser mesh"))
}

fn not_positive() -> Error {
    Error::invalid(
        "the strokes ask for things too far apart in scale: make weights, radii and the reach more alike",
    )
}
