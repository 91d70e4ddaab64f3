//! Folding a table into a rotational symmetry, and unfolding it (paper, sections 4.2 and 5.2).

use rayon::prelude::*;

use super::{Interpolation, LinearTable, Symmetry, TableSize};
use crate::Result;

impl LinearTable {
    /// The table as one of `symmetry`, with as many slices to a turn as it has now (where that is no whole number of
    /// slices, the next larger one).
    ///
    /// # Errors
    /// That many slices are over [`TableSize::LIMIT`].
    pub fn folded(&self, symmetry: Symmetry) -> Result<Self> {
        self.with_symmetry(symmetry, self.slices_of(symmetry))
    }

    /// The table as one of `symmetry` with `slices` slices.
    ///
    /// Slice s becomes the mean, in linear light, of the R directions `phi_s + 2 pi c/R`, each found by interpolation
    /// along the present axis (cubic; for R = 3 few of them fall on a slice). Into a lower symmetry the table is repeated.
    /// Where `slices` is fewer than the table has to that part of the turn, they are averaged down.
    ///
    /// # Errors
    /// `slices` is 0 or over [`TableSize::LIMIT`].
    pub fn with_symmetry(&self, symmetry: Symmetry, slices: u32) -> Result<Self> {
        let size = TableSize::new(self.size.side(), slices)?;
        let dense = TableSize::new(self.size.side(), slices.max(self.slices_of(symmetry)))?;
        let folded = if symmetry == self.symmetry && dense == self.size {
            self.clone()
        } else {
            self.fold_into(symmetry, dense)
        };
        Ok(if dense == size { folded } else { folded.resized(size) })
    }

    fn slices_of(&self, symmetry: Symmetry) -> u32 {
        (self.size.slices() * self.symmetry.order()).div_ceil(symmetry.order())
    }

    fn fold_into(&self, symmetry: Symmetry, size: TableSize) -> Self {
        let (from, to) = (self.symmetry.order(), symmetry.order());
        // Directions that the table's own symmetry already makes equal need no second look.
        let directions = to / greatest_common_divisor(from, to);
        let whole = f64::from(from * self.size.slices());
        let count = self.size.slices() as usize;
        let texels = size.slice_texels();
        let mut folded =
            Self { size, texels: vec![[0.0; 4]; size.texels()], symmetry, azimuth: self.azimuth };
        folded.texels.par_chunks_mut(texels).enumerate().for_each(|(s, slice)| {
            let taps: Vec<_> = (0..directions)
                .map(|c| {
                    let part = (s as u32 + c * size.slices()) as f64 / f64::from(to * size.slices());
                    Interpolation::Cubic.taps(part * whole, count)
                })
                .collect();
            for (k, texel) in slice.iter_mut().enumerate() {
                let mut sum = [0.0f32; 4];
                for taps in &taps {
                    let value = taps.mix(|s| self.texels[s * texels + k]);
                    for (sum, value) in sum.iter_mut().zip(value) {
                        *sum += value / directions as f32;
                    }
                }
                sum[3] = super::cyclic::whole(sum[3]);
                *texel = sum;
            }
        });
        folded
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}
