//! How far two pictures are apart.

use super::Picture;
use crate::color::{srgb_from_linear, srgb8_from_linear};
use crate::{Error, Result};

/// The peak signal-to-noise ratio of two pictures in decibels: over red, green and blue as sRGB values from 0 to 1,
/// not rounded, of the pixels that are fully covered in both. Infinite where they are equal.
///
/// # Errors
/// Pictures of different sizes, or no pixel fully covered in both.
pub fn psnr_srgb(a: &Picture, b: &Picture) -> Result<f64> {
    check_sizes(a, b)?;
    // 8-bit alpha of a fully covered pixel, whatever the mean of the samples was rounded to.
    let covered = |pixel: &[f32; 4]| pixel[3] > 1.0 - 0.5 / 255.0;
    let mut sum = 0.0;
    let mut count = 0_usize;
    for (p, q) in a.pixels().iter().zip(b.pixels()).filter(|(p, q)| covered(p) && covered(q)) {
        for (x, y) in p[..3].iter().zip(&q[..3]) {
            sum += f64::from(srgb_from_linear(*x) - srgb_from_linear(*y)).powi(2);
        }
        count += 3;
    }
    if count == 0 {
        return Err(Error::invalid("no pixel is fully covered in both pictures"));
    }
    Ok(-10.0 * (sum / count as f64).log10())
}

/// How the 8-bit sRGB values of two pictures differ, alpha included.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// How many pixels differ by 0, 1, .. 255 steps in their worst channel.
    pixels_by_steps: [u64; 256],
    /// The mean over pixels and channels, in steps of 1/255.
    pub mean: f64,
    /// The pixel that differs most.
    pub worst: WorstPixel,
}

/// The pixel at which two pictures differ most; the first of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct WorstPixel {
    /// Column.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// By how much in its worst channel, in steps of 1/255.
    pub steps: u8,
}

impl Difference {
    /// Of two pictures. Colour counts premultiplied: where nothing is covered it has no meaning.
    ///
    /// # Errors
    /// Pictures of different sizes, or without pixels.
    pub fn new(a: &Picture, b: &Picture) -> Result<Self> {
        check_sizes(a, b)?;
        let mut pixels_by_steps = [0; 256];
        let mut worst = WorstPixel::default();
        let mut sum = 0;
        for (index, (p, q)) in a.pixels().iter().zip(b.pixels()).enumerate() {
            let (p, q) = (encoded(p), encoded(q));
            let steps = p.iter().zip(q).map(|(x, y)| x.abs_diff(y));
            sum += steps.clone().map(u64::from).sum::<u64>();
            let steps = steps.max().unwrap_or(0);
            pixels_by_steps[usize::from(steps)] += 1;
            if steps > worst.steps {
                let (x, y) = (index as u64 % u64::from(a.width()), index as u64 / u64::from(a.width()));
                worst = WorstPixel { x: x as u32, y: y as u32, steps };
            }
        }
        let values = a.pixels().len() as f64 * 4.0;
        Ok(Self { pixels_by_steps, mean: sum as f64 / values, worst })
    }

    /// The share of pixels, 0 to 1, that differ by at most `steps` of 1/255 in every channel.
    pub fn share_within(&self, steps: u8) -> f64 {
        let all: u64 = self.pixels_by_steps.iter().sum();
        let within: u64 = self.pixels_by_steps[..=usize::from(steps)].iter().sum();
        within as f64 / all as f64
    }
}

fn encoded(pixel: &[f32; 4]) -> [u8; 4] {
    let [r, g, b, a] = *pixel;
    let alpha = a.clamp(0.0, 1.0);
    let colour = |value: f32| srgb8_from_linear(value * alpha);
    [colour(r), colour(g), colour(b), (alpha * 255.0 + 0.5) as u8]
}

fn check_sizes(a: &Picture, b: &Picture) -> Result<()> {
    if (a.width(), a.height()) != (b.width(), b.height()) {
        return Err(Error::invalid(format!(
            "pictures of {} x {} and {} x {} pixels cannot be compared",
            a.width(),
            a.height(),
            b.width(),
            b.height()
        )));
    }
    if a.pixels().is_empty() {
        return Err(Error::invalid("pictures without pixels cannot be compared"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::linear_from_srgb;

    fn picture(encoded: &[[f32; 4]]) -> Picture {
        let linear = |&[r, g, b, a]: &[f32; 4]| {
            [linear_from_srgb(r / 255.0), linear_from_srgb(g / 255.0), linear_from_srgb(b / 255.0), a]
        };
        Picture::new(encoded.len() as u32, 1, encoded.iter().map(linear).collect()).unwrap()
    }

    #[test]
    fn a_step_of_one_is_48_decibels() {
        // 20 log10(255) = 48.13 where every value is one step off; uncovered pixels do not count.
        let a = picture(&[[100.0, 50.0, 7.0, 1.0], [200.0, 0.0, 0.0, 0.5]]);
        let b = picture(&[[101.0, 51.0, 8.0, 1.0], [0.0, 0.0, 0.0, 1.0]]);
        assert!((psnr_srgb(&a, &b).unwrap() - 48.1308).abs() < 1e-2);
        assert!(psnr_srgb(&a, &a).unwrap().is_infinite());
        assert!(psnr_srgb(&picture(&[[0.0; 4]]), &picture(&[[0.0; 4]])).is_err());
    }

    #[test]
    fn shares_mean_and_the_worst_pixel() {
        let a = picture(&[[10.0, 10.0, 10.0, 1.0], [10.0, 10.0, 10.0, 1.0], [9.0, 9.0, 9.0, 0.0], [0.0; 4]]);
        let b = picture(&[[10.0, 13.0, 10.0, 1.0], [10.0, 10.0, 50.0, 1.0], [99.0, 0.0, 0.0, 0.0], [0.0; 4]]);
        let difference = Difference::new(&a, &b).unwrap();
        assert_eq!(difference.share_within(0), 0.5);
        assert_eq!(difference.share_within(3), 0.75);
        assert_eq!(difference.share_within(40), 1.0);
        assert_eq!(difference.mean, 43.0 / 16.0);
        assert_eq!(difference.worst, WorstPixel { x: 1, y: 0, steps: 40 });
        assert!(Difference::new(&a, &picture(&[[0.0; 4]])).is_err());
    }
}
