//! The ball, found in the pictures: a coarse guess, then a refit of its outline at sub-pixel steps.
//!
//! The guess is a Hough transform for circles: every edge pixel votes, along its gradient both ways, for the centres
//! it may lie around. It asks nothing of the background's brightness, and an arc is enough. With a pinhole camera
//! the edges are first carried to the stereographic plane, where the cone's outline is a true circle at any angle.
//! The refit finds the edge along rays across the outline and fits circle or cone to them, robustly.

mod coarse;
mod refine;

use super::cone::{Lens, Sight};
use crate::color::LINEAR_FROM_SRGB8;
use crate::image::decode::{LINEAR_FROM_SRGB16, Raster, Samples};
use crate::{Error, Result};

/// A ball found in pictures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) sight: Sight,
    /// Root mean square distance of the outline's edge points from the fit, pixels.
    pub(super) residual: f64,
}

/// Finds the ball in pictures of equal size.
///
/// # Errors
/// There is none.
pub(super) fn find(pictures: &[&Raster], lens: Lens) -> Result<Found> {
    let mean = Mean::new(pictures);
    let guesses = coarse::guess(&mean, lens);
    let mut best: Option<refine::Fit> = None;
    for guess in guesses {
        // The likeliest guesses come first; one that explains nearly its whole outline needs no rival.
        if best.is_some_and(|best| best.support > 0.8) {
            break;
        }
        let Some(fit) = refine::refine(&mean, lens, guess) else { continue };
        if best.is_none_or(|best| fit.score() > best.score()) {
            best = Some(fit);
        }
    }
    best.map(|fit| Found { sight: fit.sight, residual: fit.residual }).ok_or_else(|| {
        Error::invalid(
            "no ball was found in the pictures; its outline must stand out against the background \
             (else give it: centre and radius in pixels)",
        )
    })
}

/// The mean of some pictures, reckoned where it is asked for.
pub(super) struct Mean<'a> {
    pictures: &'a [&'a Raster],
    /// The pixels of all pictures, where all are 8-bit red, green and blue, as nearly always: they are read a million
    /// times.
    plain: Option<Vec<&'a [[u8; 3]]>>,
    /// Whether coverage tells the ball from the background.
    covered: bool,
}

impl<'a> Mean<'a> {
    pub(super) fn new(pictures: &'a [&'a Raster]) -> Self {
        let covered = pictures.iter().all(|picture| picture.has_alpha() && has_holes(picture));
        Self { pictures, plain: pictures.iter().map(|picture| plain(picture)).collect(), covered }
    }

    fn width(&self) -> usize {
        self.pictures.first().map_or(0, |picture| picture.width() as usize)
    }

    fn height(&self) -> usize {
        self.pictures.first().map_or(0, |picture| picture.height() as usize)
    }

    /// Linear red, green and blue; or three times the coverage, where the pictures have it.
    fn pixel(&self, x: usize, y: usize) -> [f32; 3] {
        let mut sum = [0.0; 3];
        let mut add = |value: [f32; 3]| {
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += value;
            }
        };
        if let Some(pictures) = &self.plain {
            let linear = &*LINEAR_FROM_SRGB8;
            let at = y * self.width() + x;
            for pixel in pictures.iter().filter_map(|pixels| pixels.get(at)) {
                add(pixel.map(|value| linear[usize::from(value)]));
            }
        } else {
            for &picture in self.pictures {
                let [r, g, b, a] = pixel(picture, x, y);
                add(if self.covered { [a; 3] } else { [r, g, b] });
            }
        }
        sum.map(|value| value / self.pictures.len().max(1) as f32)
    }

    /// Bilinear between pixel centres; `None` outside of the picture.
    fn sample(&self, at: glam::DVec2) -> Option<[f32; 3]> {
        let (width, height) = (self.width() as f64, self.height() as f64);
        if !(at.x >= 0.0 && at.y >= 0.0 && at.x <= width && at.y <= height) {
            return None;
        }
        let x = (at.x - 0.5).clamp(0.0, width - 1.0);
        let y = (at.y - 0.5).clamp(0.0, height - 1.0);
        let (x0, y0) = (x as usize, y as usize);
        let (x1, y1) = ((x0 + 1).min(self.width() - 1), (y0 + 1).min(self.height() - 1));
        let (fx, fy) = ((x - x0 as f64) as f32, (y - y0 as f64) as f32);
        let corners = [self.pixel(x0, y0), self.pixel(x1, y0), self.pixel(x0, y1), self.pixel(x1, y1)];
        Some(std::array::from_fn(|k| {
            let [a, b, c, d] = corners.map(|corner| corner[k]);
            (a * (1.0 - fx) + b * fx) * (1.0 - fy) + (c * (1.0 - fx) + d * fx) * fy
        }))
    }
}

/// The pixels of a picture of 8-bit red, green and blue.
fn plain(picture: &Raster) -> Option<&[[u8; 3]]> {
    match picture.samples() {
        Samples::U8(samples) if picture.channels() == 3 => Some(samples.as_chunks().0),
        _ => None,
    }
}

/// Even in steps that are seen: linear light is not.
fn perceived(linear: f32) -> f32 {
    linear.max(0.0).sqrt()
}

/// The linear pixel at `x`, `y`; black outside.
fn pixel(picture: &Raster, x: usize, y: usize) -> [f32; 4] {
    let channels = picture.channels() as usize;
    let start = (y * picture.width() as usize + x) * channels;
    match picture.samples() {
        Samples::U8(samples) => {
            let eight = &*LINEAR_FROM_SRGB8;
            spread(
                samples.get(start..start + channels),
                |value| eight[usize::from(value)],
                |alpha| f32::from(alpha) / 255.0,
            )
        }
        Samples::U16(samples) => spread(
            samples.get(start..start + channels),
            |value| LINEAR_FROM_SRGB16[usize::from(value)],
            |alpha| f32::from(alpha) / 65535.0,
        ),
        Samples::F32(samples) => spread(samples.get(start..start + channels), |value| value, |alpha| alpha),
    }
}

fn spread<T: Copy>(pixel: Option<&[T]>, colour: impl Fn(T) -> f32, alpha: impl Fn(T) -> f32) -> [f32; 4] {
    match pixel {
        Some(&[y]) => [colour(y), colour(y), colour(y), 1.0],
        Some(&[y, a]) => [colour(y), colour(y), colour(y), alpha(a)],
        Some(&[r, g, b]) => [colour(r), colour(g), colour(b), 1.0],
        Some(&[r, g, b, a]) => [colour(r), colour(g), colour(b), alpha(a)],
        _ => [0.0; 4],
    }
}

/// Whether a picture's coverage leaves anything out: at least one pixel in ten thousand, and not everything.
fn has_holes(picture: &Raster) -> bool {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let open = (0..width * height).filter(|&k| pixel(picture, k % width, k / width)[3] < 0.5).count();
    open * 10_000 > width * height && open < width * height
}
