//! Interpolation along an axis that closes on itself: the azimuth of a table, the turn of a capture.

/// How values between samples of a cyclic sequence are found. Both pass through the samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// On the straight line between the two nearest samples, as a GPU filters.
    Linear,
    /// On the cubic through the four nearest samples (Lagrange). On a highlight three samples wide its error is a
    /// seventeenth of the straight line's; it may overshoot beside a sharp edge.
    #[default]
    Cubic,
}

/// Which samples a value between them is made of, and how much of each; the weights add up to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taps {
    /// Indices of samples.
    pub index: [usize; 4],
    /// Their weights; some are 0.
    pub weight: [f32; 4],
}

impl Interpolation {
    /// The taps for the value at `at`, in samples: `at = 2.25` lies between samples 2 and 3, and whole turns (multiples
    /// of `count`) make no difference. `count` must not be 0.
    pub fn taps(self, at: f64, count: usize) -> Taps {
        let low = at.floor();
        let f = (at - low) as f32;
        let first = (low as i64 - 1).rem_euclid(count as i64) as usize;
        let weight = match self {
            _ if f == 0.0 => [0.0, 1.0, 0.0, 0.0],
            Self::Linear => [0.0, 1.0 - f, f, 0.0],
            Self::Cubic => [
                -f * (f - 1.0) * (f - 2.0) / 6.0,
                (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
                -f * (f + 1.0) * (f - 2.0) / 2.0,
                f * (f + 1.0) * (f - 1.0) / 6.0,
            ],
        };
        Taps { index: std::array::from_fn(|k| (first + k) % count), weight }
    }
}

impl Taps {
    /// The weighted sum of the texels that `texel` gives for the taps' indices. Colours are kept from going below 0,
    /// where a cubic overshoots; the fourth channel stays between 0 and 1.
    pub fn mix(&self, texel: impl Fn(usize) -> [f32; 4]) -> [f32; 4] {
        let mut sum = [0.0f32; 4];
        for (&index, &weight) in self.index.iter().zip(&self.weight) {
            if weight != 0.0 {
                for (sum, value) in sum.iter_mut().zip(texel(index)) {
                    *sum += weight * value;
                }
            }
        }
        sum[3] = whole(sum[3]).min(1.0);
        sum.map(|value| value.max(0.0))
    }
}

/// A mean of measured texels is measured, whatever rounding does to the sum of the weights.
pub(super) fn whole(alpha: f32) -> f32 {
    if (alpha - 1.0).abs() < 1e-5 { 1.0 } else { alpha }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn worst(interpolation: Interpolation, count: usize, f: impl Fn(f64) -> f64) -> f64 {
        let samples: Vec<f32> = (0..count).map(|k| f(k as f64 / count as f64) as f32).collect();
        (0..977)
            .map(|k| {
                let turn = f64::from(k) / 977.0 * 3.0 - 1.5;
                let taps = interpolation.taps(turn * count as f64, count);
                let value: f32 = taps.index.iter().zip(&taps.weight).map(|(&i, w)| samples[i] * w).sum();
                (f64::from(value) - f(turn.rem_euclid(1.0))).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn samples_come_back_and_whole_turns_make_no_difference() {
        for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
            for at in [-9.0, -2.0, 5.0, 12.0] {
                let taps = interpolation.taps(at, 7);
                let mixed = taps.mix(|index| [index as f32, 0.0, 0.0, 1.0]);
                assert_eq!(mixed, [5.0, 0.0, 0.0, 1.0]);
            }
        }
    }

    #[test]
    fn the_cubic_is_far_closer_to_a_smooth_curve() {
        let wave = |turn: f64| 0.5 + 0.5 * (3.0 * TAU * turn).cos();
        // The straight line's error is (h^2 / 8) max|f''|: a closed form to hold both against.
        let h: f64 = 1.0 / 64.0;
        let linear_bound = h * h / 8.0 * 0.5 * (3.0 * TAU).powi(2);
        let linear = worst(Interpolation::Linear, 64, wave);
        assert!(linear <= linear_bound && linear > 0.9 * linear_bound);
        assert!(worst(Interpolation::Cubic, 64, wave) < linear / 15.0);
    }

    #[test]
    fn short_cycles_are_no_special_case() {
        for count in 1..4 {
            for k in 0..20 {
                let taps = Interpolation::Cubic.taps(f64::from(k) * 0.37 - 3.0, count);
                assert!(taps.index.iter().all(|&index| index < count));
                assert!((taps.weight.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            }
        }
    }
}
