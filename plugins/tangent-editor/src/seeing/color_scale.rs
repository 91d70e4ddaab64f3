//! From values to colours, evenly to the eye.

/// A range of values and its colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorScale {
    /// At the first colour.
    pub low: f32,
    /// At the last.
    pub high: f32,
    /// Whether the middle is what is wanted, and both sides are off: blue and red from a light grey; else viridis.
    pub is_diverging: bool,
}

/// viridis (S. van der Walt, N. Smith 2015, CC0), at tenths.
const VIRIDIS: [[u8; 3]; 11] = [
    [68, 1, 84],
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [34, 168, 132],
    [68, 191, 112],
    [122, 209, 81],
    [189, 223, 38],
    [253, 231, 37],
];
/// The cool to warm map of K. Moreland, "Diverging color maps for scientific visualization" (2009), at eighths.
const COOL_WARM: [[u8; 3]; 9] = [
    [59, 76, 192],
    [98, 130, 234],
    [141, 176, 254],
    [184, 208, 249],
    [221, 221, 221],
    [245, 196, 173],
    [244, 154, 123],
    [222, 96, 77],
    [180, 4, 38],
];

impl ColorScale {
    /// Round about `middle`, as far as these values need, and at least `least` to either side.
    pub fn diverging(middle: f32, values: [f32; 2], least: f32) -> Self {
        let far = values.map(|value| (value - middle).abs()).into_iter().fold(least, f32::max);
        let far = round_up(far);
        Self { low: middle - far, high: middle + far, is_diverging: true }
    }

    /// From 0 to a round number over `value`, at least `least`.
    pub fn rising(value: f32, least: f32) -> Self {
        Self { low: 0.0, high: round_up(value.max(least)), is_diverging: false }
    }

    /// The sRGB-encoded colour of a value, 0 to 1; values beyond the range have the colour of its end.
    pub fn color(&self, value: f32) -> [f32; 3] {
        let table: &[[u8; 3]] = if self.is_diverging { &COOL_WARM } else { &VIRIDIS };
        let share = ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        let at = if share.is_nan() { 0.0 } else { share * (table.len() - 1) as f32 };
        let step = (at as usize).min(table.len() - 2);
        let mix = |k: usize| {
            let (a, b) = (f32::from(table[step][k]), f32::from(table[step + 1][k]));
            (a + (b - a) * (at - step as f32)) / 255.0
        };
        [mix(0), mix(1), mix(2)]
    }
}

/// The least of 1, 2, 3, 5, 10, 20, ... that is not less.
fn round_up(value: f32) -> f32 {
    if !(value > 0.0 && value.is_finite()) {
        return 1.0;
    }
    let power = 10.0f32.powf(value.log10().floor());
    [1.0, 2.0, 3.0, 5.0, 10.0]
        .map(|step| step * power)
        .into_iter()
        .find(|&it| it >= value * 0.9999)
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use amc_core::color::linear_from_srgb;

    /// Lightness of CIELAB.
    fn lightness([r, g, b]: [f32; 3]) -> f32 {
        let [r, g, b] = [r, g, b].map(linear_from_srgb);
        116.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt() - 16.0
    }

    #[test]
    fn lightness_rises_evenly_or_to_the_middle() {
        let rising = ColorScale::rising(7.0, 1.0);
        assert_eq!((rising.low, rising.high), (0.0, 10.0));
        let steps: Vec<f32> = (0..=10).map(|k| lightness(rising.color(k as f32))).collect();
        let mean = (steps[10] - steps[0]) / 10.0;
        for pair in steps.windows(2) {
            assert!((pair[1] - pair[0] - mean).abs() < 0.25 * mean, "{steps:?}");
        }
        let around = ColorScale::diverging(90.0, [88.7, 91.0], 1.0);
        assert_eq!((around.low, around.high), (88.0, 92.0));
        for k in 0..=8 {
            let off = k as f32 / 4.0;
            let (below, above) = (lightness(around.color(90.0 - off)), lightness(around.color(90.0 + off)));
            assert!((below - above).abs() < 6.0 && below <= lightness(around.color(90.0)), "{below} {above}");
        }
    }

    #[test]
    fn ends_hold_what_is_beyond_and_numbers_are_round() {
        let scale = ColorScale::rising(1.0, 1.0);
        assert_eq!(scale.color(-5.0), scale.color(0.0));
        assert_eq!(scale.color(50.0), scale.color(1.0));
        assert_eq!(scale.color(f32::NAN), scale.color(0.0));
        for (value, wanted) in
            [(0.0, 1.0), (0.011, 0.02), (2.0, 2.0), (2.1, 3.0), (34.0, 50.0), (f32::NAN, 1.0)]
        {
            assert!((round_up(value) - wanted).abs() < 1e-4 * wanted, "{value}");
        }
    }
}
