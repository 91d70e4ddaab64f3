//! What is drawn into: the samples of one tile, with depth, and their resolve into pixels.

use glam::{Vec3, Vec4};

use super::raster::{Coverage, QUAD, Samples};

/// Columns and rows of a tile. Even, so that quads never straddle tiles; small enough for its samples to stay in the
/// cache.
pub(super) const TILE: u32 = 64;

/// The samples of one tile.
#[derive(Debug)]
pub(super) struct Target {
    samples: Samples,
    /// The tile's top left pixel.
    left: i32,
    top: i32,
    /// The picture's pixels in it.
    width: i32,
    height: i32,
    /// Premultiplied; sample by sample, pixel by pixel, row by row, [`TILE`] pixels to the row.
    colour: Vec<Vec4>,
    depth: Vec<f32>,
}

impl Target {
    /// A cleared tile: at depth 1, in `clear` (premultiplied).
    pub(super) fn new(samples: Samples, corner: (u32, u32), size: (u32, u32), clear: Vec4) -> Self {
        let count = (TILE * TILE) as usize * samples.count();
        Self {
            samples,
            left: corner.0 as i32,
            top: corner.1 as i32,
            width: size.0.min(TILE) as i32,
            height: size.1.min(TILE) as i32,
            colour: vec![clear; count],
            depth: vec![1.0; count],
        }
    }

    /// The first and the last column, then row, of the picture in this tile.
    pub(super) fn bounds(&self) -> [(i32, i32); 2] {
        [(self.left, self.left + self.width - 1), (self.top, self.top + self.height - 1)]
    }

    fn first_sample(&self, x: i32, y: i32) -> usize {
        ((y - self.top) as usize * TILE as usize + (x - self.left) as usize) * self.samples.count()
    }

    /// Tests and writes the depth of the covered samples of a quad whose top left pixel is `x`, `y`. Gives the mask of
    /// those that are nearer than what was there.
    pub(super) fn depth_test(&mut self, coverage: &Coverage, covered: u16, x: i32, y: i32) -> u16 {
        let mut passed = 0;
        for (lane, (right, down)) in QUAD.iter().enumerate() {
            let (px, py) = (x + *right as i32, y + *down as i32);
            if px - self.left >= self.width || py - self.top >= self.height {
                continue;
            }
            let first = self.first_sample(px, py);
            for sample in 0..self.samples.count() {
                let bit = 1 << (lane * self.samples.count() + sample);
                if covered & bit != 0 {
                    let depth = coverage.depth(px, py, sample);
                    let kept = &mut self.depth[first + sample];
                    if depth < *kept {
                        *kept = depth;
                        passed |= bit;
                    }
                }
            }
        }
        passed
    }

    /// Writes an opaque colour into the samples of one pixel: `mask` has a bit for each.
    pub(super) fn write(&mut self, x: i32, y: i32, mask: u16, colour: Vec3) {
        let first = self.first_sample(x, y);
        for (sample, kept) in self.colour[first..][..self.samples.count()].iter_mut().enumerate() {
            if mask & (1 << sample) != 0 {
                *kept = colour.extend(1.0);
            }
        }
    }

    /// The tile's pixels with straight alpha, [`TILE`] to the row: the means of the samples, in linear light.
    pub(super) fn resolve(&self) -> Vec<[f32; 4]> {
        let count = self.samples.count();
        let straight = |samples: &[Vec4]| {
            let mean = samples.iter().sum::<Vec4>() / count as f32;
            let rgb = if mean.w > 0.0 { mean.truncate() / mean.w } else { Vec3::ZERO };
            rgb.extend(mean.w).to_array()
        };
        self.colour.chunks_exact(count).map(straight).collect()
    }
}
