//! Tables of another size.

use rayon::prelude::*;

use super::{Interpolation, LinearTable, TableSize};

/// What one sample of the new axis is made of: old samples and their shares, which add up to 1.
type Shares = Vec<(usize, f32)>;

impl LinearTable {
    /// The table at another size, in linear light: area-weighted along an axis that shrinks, linear along one that grows.
    /// The azimuth wraps around. Texels on the disc are made from texels on the disc; those off it are filled from the rim.
    pub fn resized(&self, size: TableSize) -> Self {
        let slices = self.with_slices(size.slices());
        if size.side() == self.size.side() { slices } else { slices.with_side(size) }
    }

    fn with_slices(&self, slices: u32) -> Self {
        let count = self.size.slices();
        if slices == count {
            return self.clone();
        }
        let size = TableSize { slices, ..self.size };
        let texels = size.slice_texels();
        let mut resized = self.empty(size);
        resized.texels.par_chunks_mut(texels).enumerate().for_each(|(s, slice)| {
            let shares = cyclic_shares(s as u32, count, slices);
            for (k, texel) in slice.iter_mut().enumerate() {
                *texel = mix(&shares, |s| self.texels[s * texels + k]);
            }
        });
        resized
    }

    /// To the side of `size`, whose slices are those of this table.
    fn with_side(&self, size: TableSize) -> Self {
        let sources = plane_shares(self.size, size);
        let mut resized = self.empty(size);
        let (from, to) = (self.size.slice_texels(), size.slice_texels());
        resized.texels.par_chunks_mut(to).zip(self.texels.par_chunks(from)).for_each(|(new, old)| {
            for (texel, shares) in new.iter_mut().zip(&sources) {
                *texel = mix(shares, |k| old[k]);
            }
        });
        resized.fill_off_disc();
        resized
    }

    /// A black table of another size.
    fn empty(&self, size: TableSize) -> Self {
        let texels = vec![[0.0; 4]; size.texels()];
        Self { size, texels, symmetry: self.symmetry, azimuth: self.azimuth }
    }
}

fn mix(shares: &Shares, texel: impl Fn(usize) -> [f32; 4]) -> [f32; 4] {
    let mut sum = [0.0f32; 4];
    for &(index, share) in shares {
        for (sum, value) in sum.iter_mut().zip(texel(index)) {
            *sum += share * value;
        }
    }
    sum[3] = super::cyclic::whole(sum[3]);
    sum
}

/// Sample `k` of `to` samples of a turn out of `from` samples. A sample stands for the stretch half a step to both
/// sides of its azimuth.
fn cyclic_shares(k: u32, from: u32, to: u32) -> Shares {
    let ratio = f64::from(from) / f64::from(to);
    let centre = f64::from(k) * ratio;
    if to >= from {
        let taps = Interpolation::Linear.taps(centre, from as usize);
        return taps.index.into_iter().zip(taps.weight).filter(|(_, weight)| *weight != 0.0).collect();
    }
    // In a frame where sample s stands for [s, s + 1].
    let covered = overlaps(centre - ratio / 2.0 + 0.5, centre + ratio / 2.0 + 0.5);
    covered.map(|(s, share)| (s.rem_euclid(i64::from(from)) as usize, share)).collect()
}

/// Sample `k` of `to` samples of an axis with ends out of `from` samples.
fn axis_shares(k: u32, from: u32, to: u32) -> Shares {
    let ratio = f64::from(from) / f64::from(to);
    let last = i64::from(from) - 1;
    if to < from {
        let covered = overlaps(f64::from(k) * ratio, f64::from(k + 1) * ratio);
        return covered.map(|(s, share)| (s.clamp(0, last) as usize, share)).collect();
    }
    let at = (f64::from(k) + 0.5) * ratio - 0.5;
    let (low, f) = (at.floor() as i64, at.rem_euclid(1.0) as f32);
    [(low, 1.0 - f), (low + 1, f)].map(|(s, share)| (s.clamp(0, last) as usize, share)).into()
}

/// The unit cells `[s, s + 1]` that the stretch from `start` to `end` covers, with the share each takes of it.
fn overlaps(start: f64, end: f64) -> impl Iterator<Item = (i64, f32)> {
    let cells = start.floor() as i64..end.ceil() as i64;
    cells.filter_map(move |s| {
        let covered = end.min(s as f64 + 1.0) - start.max(s as f64);
        (covered > 1e-9).then(|| (s, (covered / (end - start)) as f32))
    })
}

/// For each texel of a slice of `to` the texels of a slice of `from` it is made of, those on the disc only.
fn plane_shares(from: TableSize, to: TableSize) -> Vec<Shares> {
    let disc = from.disc();
    let axis: Vec<Shares> = (0..to.side()).map(|k| axis_shares(k, from.side(), to.side())).collect();
    let mut all = Vec::with_capacity(to.slice_texels());
    for rows in &axis {
        for columns in &axis {
            let products = rows.iter().flat_map(|&(j, wy)| {
                columns.iter().map(move |&(i, wx)| (j * from.side() as usize + i, wx * wy))
            });
            let mut shares: Shares =
                products.clone().filter(|&(k, weight)| disc[k] && weight > 0.0).collect();
            if shares.is_empty() {
                // Wholly off the disc, where the old table holds its rim's colours.
                shares = products.collect();
            }
            let total: f32 = shares.iter().map(|(_, weight)| weight).sum();
            shares.iter_mut().for_each(|(_, weight)| *weight /= total);
            all.push(shares);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amc::tests::table;

    #[test]
    fn a_plain_table_stays_plain_at_any_size() {
        let plain = table(12, 10, |i, j, _| {
            let on = TableSize::new(12, 1).unwrap().is_on_disc(i, j);
            if on { [0.25, 0.5, 1.0, 1.0] } else { [50.0, 50.0, 50.0, 0.5] }
        });
        for (side, slices) in [(5, 7), (12, 64), (31, 3), (2, 1), (12, 10)] {
            let size = TableSize::new(side, slices).unwrap();
            let resized = plain.resized(size);
            for (texel, on) in resized.texels.iter().zip(size.disc().iter().cycle()) {
                let plain = (texel[0] - 0.25).abs() < 1e-5 && (texel[2] - 1.0).abs() < 1e-5;
                assert!((plain && texel[3] == 1.0) || !on, "{side} x {slices}: {texel:?}");
                assert!(plain || side == 12, "{side} x {slices}: {texel:?}");
            }
        }
    }

    #[test]
    fn halving_the_slices_keeps_their_azimuths() {
        // One wave over the table's part of the turn: sample k of the half-size table is centred where sample 2k was.
        let wave = |s: u32, count: u32| (std::f32::consts::TAU * s as f32 / count as f32).cos();
        let size = TableSize::new(4, 32).unwrap();
        let halved = table(4, 64, |_, _, s| [2.0 + wave(s, 64), 0.0, 0.0, 1.0]).resized(size);
        for s in 0..32 {
            // The box [-1, 1] over a wave of 64 samples, sampled at -1, 0 and 1 with shares 1/4, 1/2, 1/4.
            let damped = 0.5 + 0.5 * (std::f32::consts::TAU / 64.0).cos();
            assert!((halved.texel(1, 1, s)[0] - 2.0 - damped * wave(s, 32)).abs() < 1e-5);
        }
    }

    #[test]
    fn growing_passes_through_the_old_slices() {
        let grown = table(4, 8, |i, _, s| [(s * 4 + i) as f32, 0.0, 0.0, 1.0])
            .resized(TableSize::new(4, 24).unwrap());
        for s in 0..8 {
            assert_eq!(grown.texel(2, 1, 3 * s)[0], (s * 4 + 2) as f32);
        }
    }

    #[test]
    fn a_ramp_over_the_disc_shrinks_to_a_ramp() {
        // Area means of a linear function are its values at the centres, away from the rim.
        let size = TableSize::new(64, 1).unwrap();
        let ramp = table(64, 1, |i, j, _| {
            let n = size.normal_xy(i, j);
            [2.0 + n.x, 2.0 + n.y, 0.0, 1.0]
        });
        let small = TableSize::new(16, 1).unwrap();
        let shrunk = ramp.resized(small);
        for j in 4..12 {
            for i in 4..12 {
                let (n, texel) = (small.normal_xy(i, j), shrunk.texel(i, j, 0));
                assert!((texel[0] - 2.0 - n.x).abs() < 1e-5 && (texel[1] - 2.0 - n.y).abs() < 1e-5);
            }
        }
    }
}
