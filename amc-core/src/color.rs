//! The sRGB transfer function (IEC 61966-2-1). Everything else in this crate works in linear Rec. 709 light.

use std::sync::LazyLock;

/// Linear light of an sRGB-encoded value; both in 0..=1.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The sRGB encoding of linear light; clamped to 0..=1 (NaN gives 0).
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear.is_nan() {
        0.0
    } else if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The 8-bit sRGB encoding of linear light, rounded to the nearest; clamped.
pub fn srgb8_from_linear(linear: f32) -> u8 {
    (srgb_from_linear(linear) * 255.0 + 0.5) as u8
}

/// Linear light of the 256 8-bit sRGB values.
pub static LINEAR_FROM_SRGB8: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|value| linear_from_srgb(value as f32 / 255.0)));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_8_bit_value_comes_back() {
        for value in 0..=255u8 {
            assert_eq!(srgb8_from_linear(LINEAR_FROM_SRGB8[usize::from(value)]), value);
        }
    }

    #[test]
    fn known_values_of_the_standard() {
        // Middle grey of the standard's own table: 0.5 encoded is 0.21404 linear.
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-5);
        assert_eq!(srgb8_from_linear(-1.0), 0);
        assert_eq!(srgb8_from_linear(f32::NAN), 0);
        assert_eq!(srgb8_from_linear(9.0), 255);
    }
}
