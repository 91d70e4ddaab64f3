//! The reference renderer, in plain Rust.
//!
//! It gives the same picture as the renderer on the graphics device, because it copies the device's rules: see
//! `raster` for coverage, `quad` for derivatives, `target` for depth and resolve. Tiles are drawn in parallel, each with all
//! of its triangles in order, so that the picture does not depend on the number of threads.

mod assembly;
mod clip;
mod fragment;
mod quad;
mod raster;
mod target;
#[cfg(test)]
mod tests;
mod texture;
mod vertex;

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use self::assembly::Assembly;
use self::fragment::{Coat, FragmentStage, Paint};
use self::quad::{Interpolation, pair_of};
use self::raster::{Coverage, QUAD, Samples, WindowTriangle};
use self::target::{TILE, Target};
use super::{Cyclic, Drawing, Shading, View};
use crate::image::Picture;
use crate::{Error, Progress, Result};

/// Draws a picture: straight alpha, linear light; alpha is the share of covered samples, or 1 over a background.
///
/// # Errors
/// The drawing or the view does not hold together ([`Drawing::check`], [`View::check`]), `samples` is neither 1 nor 4, or the work was
/// cancelled.
pub fn render(drawing: &Drawing, view: &View, shading: &Shading, progress: &Progress<'_>) -> Result<Picture> {
    drawing.check()?;
    view.check()?;
    let samples = match shading.samples {
        1 => Samples::One,
        4 => Samples::Four,
        other => return Err(Error::unsupported(format!("{other} samples per pixel; there can be 1 or 4"))),
    };
    progress.step("preparing fabrics", 0, 1)?;
    let coats = Coat::of_draws(drawing, &shading.mode)?;
    progress.step("placing vertices", 0, 1)?;
    let assembly = Assembly::new(drawing, view, shading, &coats)?;
    let scene = Scene { assembly, coats, fragments: FragmentStage { view, shading }, samples };
    scene.draw(progress)
}

/// All that tiles are drawn from.
#[derive(Debug)]
struct Scene<'a> {
    assembly: Assembly,
    /// One for each draw.
    coats: Vec<Coat>,
    fragments: FragmentStage<'a>,
    samples: Samples,
}

impl Scene<'_> {
    fn draw(&self, progress: &Progress<'_>) -> Result<Picture> {
        let (width, height) = (self.fragments.view.width, self.fragments.view.height);
        let mut pixels = vec![[0.0; 4]; width as usize * height as usize];
        let bands = height.div_ceil(TILE) as usize;
        let done = AtomicUsize::new(0);
        let band_pixels = width as usize * TILE as usize;
        pixels.par_chunks_mut(band_pixels).enumerate().try_for_each(|(band, pixels)| {
            self.draw_band(band as u32 * TILE, pixels, progress)?;
            progress.step("drawing", done.fetch_add(1, Ordering::Relaxed) + 1, bands)
        })?;
        Picture::new(width, height, pixels)
    }

    /// Draws the tiles whose top row is `top` into the picture's rows from there on.
    fn draw_band(&self, top: u32, pixels: &mut [[f32; 4]], progress: &Progress<'_>) -> Result<()> {
        let width = self.fragments.view.width;
        let rows = pixels.len() as u32 / width;
        let (first, last) = (top as i32, (top + rows) as i32 - 1);
        let reaches = |triangle: &&WindowTriangle| {
            let [_, (low, high)] = triangle.bounds();
            low <= last && high >= first
        };
        let triangles: Vec<&WindowTriangle> = self.assembly.triangles.iter().filter(reaches).collect();
        let tiles = width.div_ceil(TILE);
        let draw = |tile: u32| {
            let left = tile * TILE;
            let clear = self.clear();
            let mut target = Target::new(self.samples, (left, top), (width - left, rows), clear);
            self.draw_tile(&triangles, &mut target, progress)?;
            Ok(target.resolve())
        };
        let tiles: Vec<Vec<[f32; 4]>> = (0..tiles).into_par_iter().map(draw).collect::<Result<_>>()?;
        for (row, pixels) in pixels.chunks_exact_mut(width as usize).enumerate() {
            for (tile, pixels) in tiles.iter().zip(pixels.chunks_mut(TILE as usize)) {
                pixels.copy_from_slice(&tile[row * TILE as usize..][..pixels.len()]);
            }
        }
        Ok(())
    }

    fn clear(&self) -> Vec4 {
        let background = self.fragments.shading.background;
        background.map_or(Vec4::ZERO, |rgb| Vec3::from_array(rgb).extend(1.0))
    }

    fn draw_tile(
        &self,
        triangles: &[&WindowTriangle],
        target: &mut Target,
        progress: &Progress<'_>,
    ) -> Result<()> {
        let [(left, right), (top, bottom)] = target.bounds();
        for (count, triangle) in triangles.iter().enumerate() {
            if count % 4096 == 0 && progress.is_cancelled() {
                return Err(Error::cancelled());
            }
            let [(low_x, high_x), (low_y, high_y)] = triangle.bounds();
            let columns = (low_x.max(left), high_x.min(right));
            let rows = (low_y.max(top), high_y.min(bottom));
            if columns.0 <= columns.1 && rows.0 <= rows.1 {
                self.draw_triangle(triangle, columns, rows, target);
            }
        }
        Ok(())
    }

    /// Draws the part of a triangle within these columns and rows, first to last.
    fn draw_triangle(
        &self,
        triangle: &WindowTriangle,
        columns: (i32, i32),
        rows: (i32, i32),
        target: &mut Target,
    ) {
        let coverage = Coverage::new(triangle, self.samples);
        let Some(interpolation) = Interpolation::new(triangle, &coverage, &self.assembly.corners) else {
            return;
        };
        let Some(coat) = self.coats.get(triangle.draw as usize) else {
            return;
        };
        // Quads start at even pixels.
        for y in (rows.0 & !1..=rows.1).step_by(2) {
            for x in (columns.0 & !1..=columns.1).step_by(2) {
                let covered = coverage.of_quad(x, y);
                if covered == 0 {
                    continue;
                }
                let visible = target.depth_test(&coverage, covered, x, y);
                if visible != 0 {
                    self.shade_quad(triangle.front, coat, &interpolation, visible, (x, y), target);
                }
            }
        }
    }

    /// Shades the pixels of a quad of which any sample is visible, each once.
    fn shade_quad(
        &self,
        front: bool,
        coat: &Coat,
        interpolation: &Interpolation<'_>,
        visible: u16,
        (x, y): (i32, i32),
        target: &mut Target,
    ) {
        let cyclic = self.fragments.shading.cyclic;
        let chosen = match coat.paint {
            Paint::Table(_) if cyclic == Cyclic::Cyclic => interpolation.chosen_kappa(front, x, y),
            _ => [0.0; 4],
        };
        let inks = coat.print.as_ref().map_or([Vec3::ONE; 4], |print| interpolation.inks(print, x, y));
        let count = self.samples.count();
        for (lane, (right, down)) in QUAD.iter().enumerate() {
            let mask = visible >> (lane * count) & ((1 << count) - 1);
            if mask == 0 {
                continue;
            }
            let (x, y) = (x + *right as i32, y + *down as i32);
            let at = interpolation.at(x, y);
            let kappa = if cyclic == Cyclic::Naive { pair_of(at.kappa, front).x } else { chosen[lane] };
            target.write(x, y, mask, self.fragments.colour(&coat.paint, front, &at, kappa) * inks[lane]);
        }
    }
}
