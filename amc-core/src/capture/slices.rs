//! From the texels of all pictures to the slices of the table.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use half::f16;
use half::slice::HalfFloatSliceExt as _;
use rayon::prelude::*;
use wide::f32x4;

use super::fill::RimFill;
use super::resample::{Footprints, MOST_LIGHT, Texel};
use super::turn::{Directions, Knots, Spline, Stack};
use crate::amc::{Symmetry, TableSize, TexelFormat, Texels};
use crate::color::srgb8_from_linear;
use crate::view_space::Azimuth;
use crate::{Progress, Result};

/// Texels resampled along the turn at once.
const BLOCK: usize = 64;

/// The 8-bit sRGB value of each half float.
static SRGB8_FROM_HALF: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=u16::MAX).map(|bits| srgb8_from_linear(f16::from_bits(bits).to_f32())).collect());

/// How slices are made from the texels of all pictures.
pub(super) struct Slicing<'a> {
    size: TableSize,
    symmetry: Symmetry,
    azimuth: Azimuth,
    footprints: &'a Footprints,
    spline: &'a Spline,
    /// All slices show the mean over the turn.
    one_look: bool,
    /// The directions of a turn, R times as many as slices; where they come in opposite pairs only the first half.
    directions: Directions,
    /// Through the mean of each picture and the one half a turn on, where all directions come in such pairs: half
    /// the work, and the same curve.
    half_turns: Option<Spline>,
}

/// Some texels' colours, slice by slice.
struct Block {
    /// `[slice][texel]`, red, green and blue.
    colours: Vec<[f16; 3]>,
    /// The share of the pictures that showed the texel.
    shown: Vec<f32>,
}

impl<'a> Slicing<'a> {
    /// Into `size.slices()` slices over 1/R of the turn; `one_look`: all alike.
    pub(super) fn new(
        size: TableSize,
        symmetry: Symmetry,
        azimuth: Azimuth,
        one_look: bool,
        footprints: &'a Footprints,
        spline: &'a Spline,
    ) -> Self {
        let all = symmetry.order() * size.slices();
        let reckoned = if all.is_multiple_of(2) { all / 2 } else { all };
        let half_turns = if symmetry.order().is_multiple_of(2) { spline.of_half_turns() } else { None };
        let directions = Directions::new(reckoned, all);
        Self { size, symmetry, azimuth, footprints, spline, one_look, directions, half_turns }
    }

    /// The table, and the share of its disc that was measured.
    ///
    /// # Errors
    /// Nothing was measured, or somebody cancelled.
    pub(super) fn table(
        &self,
        stack: &Stack,
        format: TexelFormat,
        progress: &Progress<'_>,
    ) -> Result<(Texels, f64)> {
        let all: Vec<usize> = (0..self.footprints.texels.len()).collect();
        let done = AtomicUsize::new(0);
        let total = all.len().div_ceil(BLOCK);
        let blocks: Vec<Block> = all
            .par_chunks(BLOCK)
            .map(|chunk| {
                let block = self.block(stack, chunk);
                progress.step("resampling the turn", done.fetch_add(1, Ordering::Relaxed) + 1, total)?;
                Ok(block)
            })
            .collect::<Result<_>>()?;
        let shown: Vec<f32> = blocks.iter().flat_map(|block| block.shown.iter().copied()).collect();
        // A texel that half of the pictures hide is filled like the rim.
        let measured: Vec<bool> = shown.iter().map(|&shown| shown >= 0.5).collect();
        let fill = RimFill::new(self.size.side(), &self.footprints.texels, &measured)?;
        let coverage =
            measured.iter().filter(|&&measured| measured).count() as f64 / disc_texels(self.size) as f64;
        let texels = match format {
            TexelFormat::Srgb8 => {
                let encode = &*SRGB8_FROM_HALF;
                let value = |half: f16| encode.get(usize::from(half.to_bits())).copied().unwrap_or(0);
                Texels::Srgb8(self.slices(&blocks, &shown, &fill, [0; 4], |[r, g, b], alpha| {
                    [value(r), value(g), value(b), (alpha * 255.0 + 0.5) as u8]
                }))
            }
            TexelFormat::Half => {
                Texels::Half(self.slices(&blocks, &shown, &fill, [f16::ZERO; 4], |[r, g, b], alpha| {
                    [r, g, b, f16::from_f32(alpha)]
                }))
            }
        };
        Ok((texels, coverage))
    }

    fn block(&self, stack: &Stack, chunk: &[usize]) -> Block {
        let lanes = 3 * chunk.len();
        let (mut values, shown) = stack.gather(chunk);
        let spline = match &self.half_turns {
            Some(half_turns) => {
                fold(&mut values);
                half_turns
            }
            None => self.spline,
        };
        let curves = spline.curves(lanes, values);
        let slices = self.size.slices() as usize;
        let copies = if self.half_turns.is_some() { 2 } else { 1 };
        let share = copies as f32 / self.symmetry.order() as f32;
        let mut colours = vec![[f16::ZERO; 3]; chunk.len() * slices];
        let mut sums = vec![f32x4::ZERO; slices];
        let mut halves = vec![[f16::ZERO; 4]; slices];
        let (mut turns, mut positions, mut knots) = (Vec::new(), Vec::new(), Knots::default());
        for (k, &texel) in chunk.iter().enumerate() {
            self.turns(&self.footprints.texels[texel], &mut turns);
            spline.positions(&turns, &mut positions);
            curves.knots(3 * k, &mut knots);
            sums.fill(f32x4::ZERO);
            for copy in positions.chunks_exact(slices) {
                for (sum, position) in sums.iter_mut().zip(copy) {
                    *sum += knots.colour(position) * share;
                }
            }
            if self.one_look {
                let sum: f32x4 = sums.iter().copied().sum();
                sums.fill(sum / slices as f32);
            }
            for sum in &mut sums {
                *sum = sum.fast_min(f32x4::splat(MOST_LIGHT));
            }
            halves.as_flattened_mut().convert_from_f32_slice(bytemuck::cast_slice(&sums));
            for (colour, &[r, g, b, _]) in colours[k..].iter_mut().step_by(chunk.len()).zip(&halves) {
                *colour = [r, g, b];
            }
        }
        Block { colours, shown }
    }

    /// The turns at which the curves show the slices' directions, all slices in order, R times over; of half turns, R/2
    /// times over and twice the turn.
    fn turns(&self, texel: &Texel, turns: &mut Vec<f32>) {
        self.directions.turns(texel, self.azimuth, turns);
        if self.half_turns.is_some() {
            turns.iter_mut().for_each(|turn| *turn *= 2.0);
        } else if turns.len() < (self.symmetry.order() * self.size.slices()) as usize {
            // Half a turn of the tangent is half a turn of the ball, at every normal.
            turns.extend_from_within(..);
            let half = turns.len() / 2;
            turns[half..].iter_mut().for_each(|turn| *turn += std::f32::consts::PI);
        }
    }

    /// The slices one after the other: measured texels, and those filled in.
    fn slices<T: Copy + Send + Sync>(
        &self,
        blocks: &[Block],
        shown: &[f32],
        fill: &RimFill,
        empty: T,
        encode: impl Fn([f16; 3], f32) -> T + Sync,
    ) -> Vec<T> {
        let mut texels = vec![empty; self.size.texels()];
        texels.par_chunks_mut(self.size.slice_texels()).enumerate().for_each(|(slice, texels)| {
            let mut halves: Vec<[f16; 3]> = Vec::with_capacity(self.footprints.texels.len());
            for block in blocks {
                let count = block.shown.len();
                halves.extend_from_slice(&block.colours[slice * count..][..count]);
            }
            for ((texel, half), &shown) in self.footprints.texels.iter().zip(&halves).zip(shown) {
                let at = (texel.j * self.size.side() + texel.i) as usize;
                // Full only where every picture showed it.
                texels[at] = encode(*half, if shown >= 1.0 { 1.0 } else { 0.5 + shown * 0.49 });
            }
            let mut colours = vec![[0.0f32; 3]; halves.len()];
            halves.as_flattened().convert_to_f32_slice(colours.as_flattened_mut());
            fill.each(|at, sources| {
                let mut sum = [0.0; 3];
                for &(texel, weight) in sources {
                    for (sum, value) in sum.iter_mut().zip(colours[texel as usize]) {
                        *sum += weight * value;
                    }
                }
                texels[at] = encode(sum.map(f16::from_f32), RimFill::ALPHA);
            });
        });
        texels
    }
}

/// Leaves the mean of the first half of the pictures' values and the second.
fn fold(values: &mut Vec<f32>) {
    let half = values.len() / 2;
    let (first, second) = values.split_at_mut(half);
    for (value, other) in first.iter_mut().zip(second) {
        *value = (*value + *other) / 2.0;
    }
    values.truncate(half);
}

/// Texels whose centre lies on the disc.
fn disc_texels(size: TableSize) -> usize {
    let on_disc = |k: u32| size.normal_xy(k % size.side(), k / size.side()).length_squared() < 1.0;
    (0..size.side() * size.side()).filter(|&k| on_disc(k)).count()
}
