//! The isotropic MatCap of a table (paper, section 5.3).

use rayon::prelude::*;

use super::{Amc, LinearTable};
use crate::image::Picture;

impl LinearTable {
    /// The mean over all slices in linear light: an ordinary MatCap, rows from the top, alpha 1 (the corners hold the
    /// rim's colours, so that filtering there stays inside).
    ///
    /// In a `transported` table this is the mean over the cloth's true angle; in a `projected` one the angles at oblique
    /// normals count unevenly.
    pub fn isotropic(&self) -> Picture {
        let side = self.size.side() as usize;
        let slices = self.size.slices() as usize;
        let mut pixels = vec![[0.0, 0.0, 0.0, 1.0]; side * side];
        pixels.par_chunks_mut(side).enumerate().for_each(|(y, row)| {
            let mut sums = vec![[0.0f64; 3]; side];
            for s in 0..slices {
                let start = (s * side + (side - 1 - y)) * side;
                for (sum, texel) in sums.iter_mut().zip(&self.texels[start..start + side]) {
                    for (sum, &value) in sum.iter_mut().zip(texel) {
                        *sum += f64::from(value);
                    }
                }
            }
            for (pixel, sum) in row.iter_mut().zip(sums) {
                for (value, sum) in pixel.iter_mut().zip(sum) {
                    *value = (sum / slices as f64) as f32;
                }
            }
        });
        Picture::of(self.size.side(), self.size.side(), pixels)
    }
}

impl Amc {
    /// The mean over all slices: see [`LinearTable::isotropic`].
    pub fn isotropic(&self) -> Picture {
        self.to_linear().isotropic()
    }
}
