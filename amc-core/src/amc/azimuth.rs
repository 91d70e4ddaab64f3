//! From one definition of the azimuth to the other, texel by texel along the turn.

use rayon::prelude::*;

use super::{Interpolation, LinearTable, Symmetry, TableSize};
use crate::Result;
use crate::view_space::Azimuth;

impl Symmetry {
    /// The largest symmetry a table of this one has in *both* definitions of the azimuth. A half turn reverses the
    /// tangent in either; a third or a quarter of a turn is a shift along the transported axis, but along the projected
    /// one it is so only where the normal looks at the viewer.
    pub fn in_both_azimuths(self) -> Self {
        match self {
            Self::One | Self::Three => Self::One,
            Self::Two | Self::Four => Self::Two,
        }
    }
}

impl LinearTable {
    /// The same table with its third axis in the other definition: every slice is read, at each texel, at the azimuth
    /// that the tangent has in the present definition (notes to the paper: its equation 3 projects the tangent).
    ///
    /// Exact but for the interpolation along the axis (cubic) where the symmetry is 1 or 2. A symmetry of 3 or 4 in one
    /// definition is none in the other: the result then has symmetry 1 or 2 ([`Symmetry::in_both_azimuths`]) and three or
    /// two times as many slices, which loses nothing; [`LinearTable::folded`] brings it back to 3 or 4, and into
    /// `projected` that costs (a 4-fold cloth: 25 against 51 dB).
    ///
    /// # Errors
    /// That many slices are over [`TableSize::LIMIT`].
    pub fn with_azimuth(&self, azimuth: Azimuth) -> Result<Self> {
        if azimuth == self.azimuth {
            return Ok(self.clone());
        }
        let symmetry = self.symmetry.in_both_azimuths();
        let slices = self.size.slices() * (self.symmetry.order() / symmetry.order());
        let size = TableSize::new(self.size.side(), slices)?;
        let mut converted = Self { size, texels: vec![[0.0; 4]; size.texels()], symmetry, azimuth };
        let normals = normals(size);
        let held = self.size.slices() as usize;
        let samples_per_radian =
            f64::from(self.symmetry.order() * self.size.slices()) / std::f64::consts::TAU;
        let step = std::f64::consts::TAU / f64::from(symmetry.order() * slices);
        let texels = size.slice_texels();
        converted.texels.par_chunks_mut(texels).enumerate().for_each(|(s, slice)| {
            let phi = (s as f64 * step) as f32;
            for &(k, n) in &normals {
                let at = self.azimuth.of(n, azimuth.tangent(n, phi));
                let taps = Interpolation::Cubic.taps(f64::from(at) * samples_per_radian, held);
                slice[k] = taps.mix(|s| self.texels[s * texels + k]);
            }
        });
        converted.fill_off_disc();
        Ok(converted)
    }
}

/// The normal of each texel on the disc, with the texel's index in its slice.
fn normals(size: TableSize) -> Vec<(usize, glam::Vec3)> {
    let texels = (0..size.side()).flat_map(|j| (0..size.side()).map(move |i| (i, j)));
    texels
        .enumerate()
        .filter(|(_, (i, j))| size.is_on_disc(*i, *j))
        .map(|(k, (i, j))| {
            let xy = size.normal_xy(i, j);
            (k, xy.extend((1.0 - xy.length_squared()).max(0.0).sqrt()))
        })
        .collect()
}
