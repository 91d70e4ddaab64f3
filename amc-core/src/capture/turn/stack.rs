//! What the pictures showed, texel by texel.

use half::f16;
use half::slice::HalfFloatSliceExt as _;

/// The pictures' texels, kept as half floats: picture after picture, in order of turn.
pub(in crate::capture) struct Stack {
    pub(in crate::capture) pictures: Vec<Vec<f16>>,
}

impl Stack {
    /// The values of `texels` (indices into the footprints' list) over the turn, as [`Spline::curves`] takes them;
    /// gaps in the coverage are bridged. Also, for each texel, the share of pictures that show it.
    pub(in crate::capture) fn gather(&self, texels: &[usize]) -> (Vec<f32>, Vec<f32>) {
        let lanes = 3 * texels.len();
        let mut halves = Vec::with_capacity(lanes * self.pictures.len());
        match texels {
            // Texels in a row are copied at once.
            [first, .., last] if texels.windows(2).all(|pair| pair[0] + 1 == pair[1]) => {
                for picture in &self.pictures {
                    halves.extend_from_slice(&picture[3 * first..3 * last + 3]);
                }
            }
            _ => {
                for picture in &self.pictures {
                    for &texel in texels {
                        halves.extend_from_slice(&picture[3 * texel..3 * texel + 3]);
                    }
                }
            }
        }
        let mut values = vec![0.0; halves.len()];
        halves.convert_to_f32_slice(&mut values);
        let mut shown = vec![1.0; texels.len()];
        if values.iter().any(|value| value.is_nan()) {
            for (k, shown) in shown.iter_mut().enumerate() {
                *shown = bridge(&mut values, lanes, 3 * k);
            }
        }
        (values, shown)
    }
}

/// Replaces a texel's missing colours by those between its neighbours in turn; gives the share that was there.
fn bridge(values: &mut [f32], lanes: usize, lane: usize) -> f32 {
    let count = values.len() / lanes;
    let there: Vec<usize> = (0..count).filter(|k| !values[k * lanes + lane].is_nan()).collect();
    let Some(&first) = there.first() else {
        for row in values.chunks_exact_mut(lanes) {
            row[lane..lane + 3].fill(0.0);
        }
        return 0.0;
    };
    let around = there.iter().skip(1).copied().chain([first + count]);
    for (&from, to) in there.iter().zip(around) {
        for k in from + 1..to {
            let along = (k - from) as f32 / (to - from) as f32;
            for c in lane..lane + 3 {
                let (a, b) = (values[from * lanes + c], values[(to % count) * lanes + c]);
                values[(k % count) * lanes + c] = a + (b - a) * along;
            }
        }
    }
    there.len() as f32 / count as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_pictures_are_bridged_around_the_turn() {
        let mut values =
            vec![f32::NAN, f32::NAN, f32::NAN, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, f32::NAN, f32::NAN, f32::NAN];
        assert_eq!(bridge(&mut values, 3, 0), 0.5);
        assert_eq!(values, [3.0, 3.0, 3.0, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    }
}
