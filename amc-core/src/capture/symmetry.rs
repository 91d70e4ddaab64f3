//! How often a turn of the cloth about its own normal brings the same look back (paper, sections 4.2 and 5.2).
//!
//! The measure is scale-free: `rho_R = rms(I(a) - I(a + 2 pi / R)) / (sqrt(2) rms(I(a) - mean over a))`, 0 where the
//! look repeats and about 1 where it is unrelated. It is taken on the *transported* azimuth, where R = 3 and 4 are
//! as exact as 2 (on the paper's projected one only 2 is), in brightness as it is perceived (a square root), so
//! that one highlight does not outweigh everything else. The noise's own share is measured and taken out of both.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::resample::Texel;
use super::turn::{Directions, Knots, Spline, Stack};
use crate::amc::Symmetry;
use crate::view_space::Azimuth;

/// The threshold on [`Similarity`] under which a symmetry is taken, unless another is given.
pub const DEFAULT_THRESHOLD: f64 = 0.25;

/// Texels along an axis that are looked at; half as many where there are many pictures.
const LATTICE: u32 = 64;

/// From here on there are many pictures.
const MANY: usize = 48;

/// Differences, over texels and pictures, from which the noise is measured: its deviation comes out to a percent.
const NOISE_SAMPLES: usize = 10_000;

/// Variation along the turn below this, perceived, is none: half a step of 8 bits.
const LEAST_VARIATION: f64 = 0.002;

/// Variation up to this many times what the noise makes is none.
const NOISE_MARGIN: f64 = 1.5;

/// `rho_R` for R = 2, 3 and 4: 0 the same, about 1 unrelated.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Similarity {
    /// After half a turn.
    #[serde(rename = "2")]
    pub two: f64,
    /// After a third of a turn.
    #[serde(rename = "3")]
    pub three: f64,
    /// After a quarter turn.
    #[serde(rename = "4")]
    pub four: f64,
}

/// What the pictures say about the cloth's symmetry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Analysis {
    pub(super) similarity: Similarity,
    /// The look does not change along the turn by more than the noise.
    pub(super) isotropic: bool,
    /// Standard deviation of the noise of one texel in one picture, perceived brightness, of 1.
    pub(super) noise: f64,
}

impl Analysis {
    /// The largest symmetry whose measure is at most the threshold.
    pub(super) fn symmetry(&self, threshold: f64) -> Symmetry {
        if self.isotropic {
            return Symmetry::One;
        }
        let measured = [
            (self.similarity.four, Symmetry::Four),
            (self.similarity.three, Symmetry::Three),
            (self.similarity.two, Symmetry::Two),
        ];
        measured
            .into_iter()
            .find(|(rho, _)| *rho <= threshold)
            .map_or(Symmetry::One, |(_, symmetry)| symmetry)
    }
}

/// Brightness as it is perceived; smooth down to black, where noise would else be blown up.
fn perceived(linear: f32) -> f32 {
    (linear.max(0.0) + 0.003).sqrt()
}

/// Analyses the pictures' texels.
pub(super) fn analyse(stack: &Stack, texels: &[Texel], side: u32, spline: &Spline) -> Analysis {
    let noise = noise_variance(stack, texels, side, spline);
    let lattice = lattice(texels, side, spline.len());
    let sums = lattice
        .par_chunks(64)
        .map(|chunk| Sums::of(stack, texels, chunk, spline))
        .reduce(Sums::default, Sums::plus);
    let count = sums.count.max(1.0);
    let left = noise * spline.noise_gain();
    let variance = sums.variance / count;
    let isotropic = variance <= LEAST_VARIATION * LEAST_VARIATION || variance <= NOISE_MARGIN * left;
    let rho = |k: usize| {
        let clean = (sums.difference[k] / count - 2.0 * left).max(0.0);
        (clean / (2.0 * (variance - left))).sqrt()
    };
    let similarity = if isotropic {
        Similarity::default()
    } else {
        Similarity { two: rho(0), three: rho(1), four: rho(2) }
    };
    Analysis { similarity, isotropic, noise: noise.sqrt() }
}

/// The texels that are looked at: every n-th, and, with few pictures, only those near the middle. There a turn in
/// the tangent plane is nearly one in the picture, so that half, third and quarter turns fall on measured angles or
/// as near to them as they can, and little hangs on interpolating what was hardly sampled.
fn lattice(texels: &[Texel], side: u32, pictures: usize) -> Vec<usize> {
    let along = if pictures < MANY { LATTICE } else { LATTICE / 2 };
    let step = side.div_ceil(along).max(1);
    let widest = (30.0 + (pictures as f64 - 16.0).max(0.0)).min(75.0);
    let least_z = widest.to_radians().cos();
    let chosen =
        |texel: &Texel| texel.i.is_multiple_of(step) && texel.j.is_multiple_of(step) && texel.m.z >= least_z;
    texels.iter().enumerate().filter(|(_, texel)| chosen(texel)).map(|(k, _)| k).collect()
}

/// Sums over texels: how many, their variance along the turn, and their squared differences after 1/2, 1/3, 1/4.
#[derive(Default)]
struct Sums {
    count: f64,
    variance: f64,
    difference: [f64; 3],
}

impl Sums {
    fn plus(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            variance: self.variance + other.variance,
            difference: std::array::from_fn(|k| self.difference[k] + other.difference[k]),
        }
    }

    fn of(stack: &Stack, texels: &[Texel], chunk: &[usize], spline: &Spline) -> Self {
        // A multiple of 12, so that halves, thirds and quarters are whole steps.
        let steps = if spline.len() <= 64 { 48 } else { 96 };
        let (values, shown) = stack.gather(chunk);
        let curves = spline.curves(3 * chunk.len(), values);
        let directions = Directions::new(steps, steps);
        let (mut turns, mut positions, mut knots) = (Vec::new(), Vec::new(), Knots::default());
        let mut sums = Self::default();
        let mut look = Vec::new();
        for (k, &texel) in chunk.iter().enumerate() {
            if shown[k] < 1.0 {
                continue;
            }
            directions.turns(&texels[texel], Azimuth::Transported, &mut turns);
            spline.positions(&turns, &mut positions);
            curves.knots(3 * k, &mut knots);
            look.clear();
            look.extend(positions.iter().map(|position| {
                let [r, g, b, _] = knots.colour(position).to_array();
                [r, g, b].map(perceived)
            }));
            sums.add(&look);
        }
        sums
    }

    fn add(&mut self, look: &[[f32; 3]]) {
        let count = look.len();
        let mean: [f64; 3] = std::array::from_fn(|c| {
            look.iter().map(|colour| f64::from(colour[c])).sum::<f64>() / count as f64
        });
        let spread =
            |colour: &[f32; 3]| (0..3).map(|c| (f64::from(colour[c]) - mean[c]).powi(2)).sum::<f64>();
        self.count += 3.0;
        self.variance += look.iter().map(spread).sum::<f64>() / count as f64;
        for (sum, order) in self.difference.iter_mut().zip(2..) {
            let later = look.iter().cycle().skip(count / order);
            let squares =
                look.iter().zip(later).flat_map(|(a, b)| (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)));
            *sum += squares.sum::<f64>() / count as f64;
        }
    }
}

/// The variance of the noise of one texel in one picture, perceived.
///
/// High differences of what is smooth are small, those of noise are not. Two ways, both of which can only find too
/// much where the look itself is rough; the lesser counts: fourth differences along the turn (many even pictures),
/// and second differences along the turn, across and up at once.
fn noise_variance(stack: &Stack, texels: &[Texel], side: u32, spline: &Spline) -> f64 {
    let mut grid = vec![u32::MAX; side as usize * side as usize];
    for (k, texel) in texels.iter().enumerate() {
        grid[(texel.j * side + texel.i) as usize] = k as u32;
    }
    // Neighbours may share pixels: the second next does so less.
    let apart = 2;
    let find = |i: i64, j: i64| -> Option<usize> {
        let inside = |k: i64| (0..i64::from(side)).contains(&k);
        let found = (inside(i) && inside(j)).then(|| grid[(j * i64::from(side) + i) as usize])?;
        (found != u32::MAX).then_some(found as usize)
    };
    let mut chosen = lattice(texels, side, spline.len());
    // Many more tell no more.
    let enough = NOISE_SAMPLES.div_ceil(spline.len());
    let apart_in_list = (chosen.len() / enough.max(1)).max(1);
    chosen = chosen.into_iter().step_by(apart_in_list).collect();
    let estimates: Vec<(f64, Option<f64>)> = chosen
        .par_iter()
        .filter_map(|&k| {
            let (i, j) = (i64::from(texels[k].i), i64::from(texels[k].j));
            let mut around = [k; 9];
            for (slot, (di, dj)) in around.iter_mut().zip((0..9).map(|m| (m % 3 - 1, m / 3 - 1))) {
                *slot = find(i + apart * di, j + apart * dj)?;
            }
            let (values, shown) = stack.gather(&around);
            let there = shown.iter().all(|&shown| shown >= 1.0);
            there.then(|| {
                (
                    space_and_turn(&values),
                    (spline.len() >= 24 && spline.is_even()).then(|| turn_only(&values)),
                )
            })
        })
        .collect();
    let count = estimates.len().max(1) as f64;
    let both = estimates.iter().map(|estimate| estimate.0).sum::<f64>() / count;
    let turn: Option<f64> = estimates.iter().map(|estimate| estimate.1).sum();
    turn.map_or(both, |turn| both.min(turn / count))
}

/// The noise's variance from 3 x 3 texels over the turn: second differences in all three directions.
fn space_and_turn(values: &[f32]) -> f64 {
    const WEIGHTS: [f32; 9] = [1.0, -2.0, 1.0, -2.0, 4.0, -2.0, 1.0, -2.0, 1.0];
    let rough: Vec<[f32; 3]> = values
        .chunks_exact(27)
        .map(|picture| {
            std::array::from_fn(|c| (0..9).map(|k| WEIGHTS[k] * perceived(picture[3 * k + c])).sum())
        })
        .collect();
    let count = rough.len();
    let squares = (0..count).flat_map(|p| {
        let (before, after) = (rough[(p + count - 1) % count], rough[(p + 1) % count]);
        let here = rough[p];
        (0..3).map(move |c| f64::from(before[c] - 2.0 * here[c] + after[c]).powi(2))
    });
    squares.sum::<f64>() / (3 * count) as f64 / 216.0
}

/// The noise's variance from the middle of 3 x 3 texels: fourth differences along the turn.
fn turn_only(values: &[f32]) -> f64 {
    let curve: Vec<[f32; 3]> =
        values.chunks_exact(27).map(|picture| std::array::from_fn(|c| perceived(picture[12 + c]))).collect();
    let count = curve.len();
    let squares = (0..count).flat_map(|p| {
        let at: [[f32; 3]; 5] = std::array::from_fn(|k| curve[(p + k) % count]);
        (0..3).map(move |c| {
            f64::from(at[0][c] - 4.0 * at[1][c] + 6.0 * at[2][c] - 4.0 * at[3][c] + at[4][c]).powi(2)
        })
    });
    squares.sum::<f64>() / (3 * count) as f64 / 70.0
}
