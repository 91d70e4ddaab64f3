//! Line integral convolution: noise smeared along the lines of a field.
//!
//! Source: B. Cabral, L. Leedom, "Imaging vector fields using line integral convolution", SIGGRAPH 1993. The kernel is Hann's; lines have
//! no sense of direction here.

use amc_core::{Progress, Result};
use glam::Vec2;
use rayon::prelude::*;

use super::Field;

/// How lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Smear {
    /// How broad a grain of the noise is, texels.
    pub(super) grain: f32,
    /// How far it is smeared to either side, texels.
    pub(super) reach: usize,
}

/// A value from 0 to 1 for every texel, 1/2 in the mean; no number where the field has no direction. Equal fields give equal values, on any
/// number of threads.
///
/// # Errors
/// [`amc_core::ErrorKind::Cancelled`].
pub(super) fn convolved(field: &Field, smear: Smear, progress: &Progress<'_>) -> Result<Vec<f32>> {
    let grid = field.grid;
    let noise = Noise::new(grid.width, grid.height, smear.grain);
    let weights: Vec<f32> = (0..=smear.reach)
        .map(|k| 0.5 + 0.5 * (std::f32::consts::PI * k as f32 / (smear.reach + 1) as f32).cos())
        .collect();
    let mut values = vec![f32::NAN; grid.count()];
    values.par_chunks_mut(grid.width.max(1)).enumerate().try_for_each(|(row, values)| {
        if progress.is_cancelled() {
            return Err(amc_core::Error::cancelled());
        }
        for (column, value) in values.iter_mut().enumerate() {
            if field.holds(row * grid.width + column) {
                *value = smeared(field, &noise, &weights, Vec2::new(column as f32 + 0.5, row as f32 + 0.5));
            }
        }
        Ok(())
    })?;
    stretch(&mut values);
    Ok(values)
}

/// The weighted mean of the noise along the line through `at`.
fn smeared(field: &Field, noise: &Noise, weights: &[f32], at: Vec2) -> f32 {
    let start = field.directions[field.grid.index(at).unwrap_or_default()];
    let (mut sum, mut total) = (noise.at(at) * weights[0], weights[0]);
    for heading in [start, -start] {
        let (mut at, mut heading) = (at, heading);
        for weight in &weights[1..] {
            // The midpoint rule, a texel at a time.
            let Some(along) = field.along(at + heading * 0.5, heading) else { break };
            at += along;
            heading = along;
            sum += noise.at(at) * weight;
            total += weight;
        }
    }
    sum / total
}

/// Brings the values to a mean of 1/2 and a good contrast.
fn stretch(values: &mut [f32]) {
    let numbers = || values.iter().filter(|value| value.is_finite()).map(|&value| f64::from(value));
    let count = numbers().count().max(1) as f64;
    let mean = numbers().sum::<f64>() / count;
    let variance = numbers().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    let gain = 0.25 / variance.sqrt().max(1e-6);
    for value in values {
        *value = (0.5 + (f64::from(*value) - mean) * gain).clamp(0.0, 1.0) as f32;
    }
}

/// White noise made smooth over a grain.
struct Noise {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Noise {
    fn new(width: usize, height: usize, grain: f32) -> Self {
        let white = |k: usize| hash(k as u32, 0x9e37_79b9);
        let reach = grain.ceil().max(1.0) as usize;
        // Gauss's bell; a grain is two of its standard deviations broad.
        let bell: Vec<f32> =
            (0..=reach).map(|k| (-2.0 * (k as f32 / grain.max(0.1)).powi(2)).exp()).collect();
        let mut values: Vec<f32> = (0..width * height).into_par_iter().map(white).collect();
        for (count, step) in [(width, 1), (height, width)] {
            values = blurred(&values, count, step, &bell);
        }
        Self { width, height, values }
    }

    /// Linear between texels.
    fn at(&self, at: Vec2) -> f32 {
        let from = at - 0.5;
        let low = from.floor();
        let share = from - low;
        let texel = |x: f32, y: f32| {
            let x = (x.max(0.0) as usize).min(self.width - 1);
            let y = (y.max(0.0) as usize).min(self.height - 1);
            self.values[y * self.width + x]
        };
        let row = |y: f32| texel(low.x, y) * (1.0 - share.x) + texel(low.x + 1.0, y) * share.x;
        row(low.y) * (1.0 - share.y) + row(low.y + 1.0) * share.y
    }
}

/// Weighted means along one way of a grid: how many texels there are that way, and how far one is from the next.
fn blurred(values: &[f32], count: usize, step: usize, bell: &[f32]) -> Vec<f32> {
    let mean = |index: usize| {
        let k = index / step % count;
        let (mut sum, mut total) = (values[index] * bell[0], bell[0]);
        for (distance, weight) in bell.iter().enumerate().skip(1) {
            if k >= distance {
                (sum, total) = (sum + values[index - distance * step] * weight, total + weight);
            }
            if k + distance < count {
                (sum, total) = (sum + values[index + distance * step] * weight, total + weight);
            }
        }
        sum / total
    };
    (0..values.len()).into_par_iter().with_min_len(4096).map(mean).collect()
}

/// A number from 0 to 1 that looks random (the finaliser of MurmurHash3, A. Appleby).
pub(super) fn hash(k: u32, seed: u32) -> f32 {
    let mut x = k ^ seed;
    x = (x ^ (x >> 16)).wrapping_mul(0x85eb_ca6b);
    x = (x ^ (x >> 13)).wrapping_mul(0xc2b2_ae35);
    x ^= x >> 16;
    (x >> 8) as f32 / (1 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::super::{FlatPanel, Grid};
    use super::*;

    fn picture(panel: &FlatPanel, direction: impl Fn(Vec2) -> Vec2) -> (Grid, Vec<f32>) {
        let grid = Grid::over(panel, 1.0 / 220.0);
        let vertices: Vec<Vec2> = panel.places.iter().map(|&at| direction(at)).collect();
        let field = Field::new(panel, grid, &vertices);
        let smear = Smear { grain: 1.5, reach: 14 };
        (grid, convolved(&field, smear, &Progress::none()).unwrap())
    }

    /// The angle of the lines by the structure tensor (Bigun and Granlund 1987), radians within half a turn, y up.
    fn line_angle(grid: Grid, values: &[f32]) -> f32 {
        let (mut xx, mut xy, mut yy) = (0.0f64, 0.0f64, 0.0f64);
        let border = 24;
        for y in border..grid.height - border {
            for x in border..grid.width - border {
                let at = |x: usize, y: usize| f64::from(values[y * grid.width + x]);
                // Derivatives by Scharr's filter, which is true to angles.
                let (mut dx, mut dy) = (0.0, 0.0);
                for (k, weight) in [(0, 3.0), (1, 10.0), (2, 3.0)] {
                    dx += weight * (at(x + 1, y + k - 1) - at(x - 1, y + k - 1));
                    dy += weight * (at(x + k - 1, y + 1) - at(x + k - 1, y - 1));
                }
                (xx, xy, yy) = (xx + dx * dx, xy + dx * dy, yy + dy * dy);
            }
        }
        // The lines run across the gradient; rows go down.
        let gradient = 0.5 * (2.0 * xy).atan2(xx - yy);
        (-(gradient + std::f64::consts::FRAC_PI_2) as f32).rem_euclid(std::f32::consts::PI)
    }

    #[test]
    fn lines_run_along_a_constant_field_to_a_degree() {
        let (_, panel) = sheet(9, |p| p.extend(0.0));
        for degrees in [0.0f32, 17.0, 45.0, 90.0, 137.0] {
            let (grid, values) = picture(&panel, |_| Vec2::from_angle(degrees.to_radians()));
            let off = (line_angle(grid, &values).to_degrees() - degrees).rem_euclid(180.0);
            assert!(off.min(180.0 - off) < 1.0, "{degrees}: off by {off}");
        }
    }

    #[test]
    fn values_are_alike_along_lines_and_not_across_them() {
        let (_, panel) = sheet(9, |p| p.extend(0.0));
        let (grid, values) = picture(&panel, |_| Vec2::X);
        let numbers: Vec<f32> = values.iter().copied().filter(|value| value.is_finite()).collect();
        let mean = numbers.iter().sum::<f32>() / numbers.len() as f32;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
        let alike = |right: usize, down: usize| {
            let (mut sum, mut square) = (0.0, 0.0);
            for y in 20..grid.height - 20 {
                for x in 20..grid.width - 20 {
                    let here = values[y * grid.width + x] - mean;
                    sum += here * (values[(y + down) * grid.width + x + right] - mean);
                    square += here * here;
                }
            }
            sum / square
        };
        assert!(alike(7, 0) > 0.6, "along: {}", alike(7, 0));
        assert!(alike(0, 7).abs() < 0.15, "across: {}", alike(0, 7));
    }

    #[test]
    fn noise_is_even_and_the_same_in_every_run() {
        let noise: Vec<f32> = (0..10_000).map(|k| hash(k, 7)).collect();
        let mean = noise.iter().sum::<f32>() / 1e4;
        let variance = noise.iter().map(|v| (v - mean).powi(2)).sum::<f32>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01 && (variance - 1.0 / 12.0).abs() < 0.003, "{mean} {variance}");
        assert_eq!(hash(5, 7), noise[5]);
    }
}
