//! From a picture to texels: each texel is the area-weighted mean, in linear light, of the pixels that its cell of
//! the table covers.
//!
//! The cell is carried to the picture by the map's derivative at its centre and taken at least one pixel wide, so
//! that where the picture is coarser than the table this is bilinear interpolation, and where both have the same
//! grid the pixels come through untouched. The weights are the same for all pictures and reckoned once.

use glam::{DMat2, DVec2, DVec3};
use half::f16;
use half::slice::HalfFloatSliceExt as _;
use rayon::prelude::*;

use super::cone::Sight;
use crate::amc::Frame;
use crate::color::LINEAR_FROM_SRGB8;
use crate::image::decode::{LINEAR_FROM_SRGB16, Raster, Samples};

/// Pixels less than this far inside of the outline are left out where the pictures have no coverage: half a pixel's
/// diagonal, and what lenses and JPEG blur.
const RIM: f64 = 1.4;

/// The share of a texel's cell that must be seen for the texel to count as measured.
const LEAST_SEEN: f64 = 0.5;

/// Texels whose sums are rounded at once.
const AT_ONCE: usize = 256;

/// The largest half float.
pub(super) const MOST_LIGHT: f32 = 65504.0;

/// A texel that the camera sees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Texel {
    /// Column.
    pub(super) i: u32,
    /// Row, upwards.
    pub(super) j: u32,
    /// The table's normal.
    pub(super) n: DVec3,
    /// The ball's true normal where it is seen.
    pub(super) m: DVec3,
}

/// Neighbouring pixels in one row.
#[derive(Clone, Copy)]
struct Run {
    /// Index of the first pixel.
    pixel: u32,
    /// Index of its weight.
    weight: u32,
    /// How many.
    length: u32,
}

/// Which pixels make which texel.
pub(super) struct Footprints {
    /// The texels that are seen, row by row.
    pub(super) texels: Vec<Texel>,
    /// Where each texel's runs end in `runs`.
    ends: Vec<u32>,
    runs: Vec<Run>,
    weights: Vec<f32>,
}

/// The footprints of one row of the table.
#[derive(Default)]
struct Row {
    texels: Vec<Texel>,
    lengths: Vec<u32>,
    runs: Vec<Run>,
    weights: Vec<f32>,
}

impl Footprints {
    /// The footprints of a table of `side` in pictures of this size. `covered`: the pictures' alpha tells the rim.
    pub(super) fn new(
        sight: &Sight,
        frame: Frame,
        side: u32,
        width: u32,
        height: u32,
        covered: bool,
    ) -> Self {
        let view = View { sight, frame, side, width, height, rim: if covered { -1.0 } else { RIM } };
        let rows: Vec<Row> = (0..side).into_par_iter().map(|j| view.row(j)).collect();
        let mut all = Self { texels: Vec::new(), ends: Vec::new(), runs: Vec::new(), weights: Vec::new() };
        for row in rows {
            let base = all.weights.len() as u32;
            let mut end = all.runs.len() as u32;
            all.ends.extend(row.lengths.iter().map(|length| {
                end += length;
                end
            }));
            all.runs.extend(row.runs.into_iter().map(|run| Run { weight: run.weight + base, ..run }));
            all.weights.extend(row.weights);
            all.texels.extend(row.texels);
        }
        all
    }

    /// How many of a picture's rows, from the top, are looked at.
    pub(super) fn rows(&self, width: u32) -> usize {
        self.runs.iter().map(|run| run.pixel / width + 1).max().unwrap_or(0) as usize
    }

    /// The texels' red, green and blue in linear light, one after the other; NaN where the picture's coverage leaves
    /// too little.
    pub(super) fn resample(&self, picture: &Raster) -> Vec<f16> {
        match picture.samples() {
            Samples::U8(samples) => {
                let eight = &*LINEAR_FROM_SRGB8;
                let linear = |v: u8| eight[usize::from(v)];
                self.by_channels(picture.channels(), samples, linear, |a| f32::from(a) / 255.0)
            }
            Samples::U16(samples) => {
                let sixteen = &**LINEAR_FROM_SRGB16;
                let linear = |v: u16| sixteen.get(usize::from(v)).copied().unwrap_or(1.0);
                self.by_channels(picture.channels(), samples, linear, |a| f32::from(a) / 65535.0)
            }
            Samples::F32(samples) => self.by_channels(picture.channels(), samples, |v| v, |a| a),
        }
    }

    fn by_channels<T: Copy>(
        &self,
        channels: u32,
        samples: &[T],
        linear: impl Fn(T) -> f32,
        alpha: impl Fn(T) -> f32,
    ) -> Vec<f16> {
        match channels {
            1 => self.gather::<T, 1>(samples, |&[y]| {
                let y = linear(y);
                [y, y, y, 1.0]
            }),
            2 => self.gather::<T, 2>(samples, |&[y, a]| {
                let (y, a) = (linear(y), alpha(a));
                [y * a, y * a, y * a, a]
            }),
            3 => self.gather::<T, 3>(samples, |&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]),
            _ => self.gather::<T, 4>(samples, |&[r, g, b, a]| {
                let a = alpha(a);
                [linear(r) * a, linear(g) * a, linear(b) * a, a]
            }),
        }
    }

    /// Weighted sums of `pixel`, which gives premultiplied colour and coverage.
    fn gather<T: Copy, const C: usize>(
        &self,
        samples: &[T],
        pixel: impl Fn(&[T; C]) -> [f32; 4],
    ) -> Vec<f16> {
        let (pixels, _) = samples.as_chunks::<C>();
        let mut halves = vec![f16::ZERO; 3 * self.texels.len()];
        let mut colours = Vec::with_capacity(3 * AT_ONCE);
        let mut start = 0;
        for (ends, halves) in self.ends.chunks(AT_ONCE).zip(halves.chunks_mut(3 * AT_ONCE)) {
            colours.clear();
            for &end in ends {
                let runs = &self.runs[start as usize..end as usize];
                colours.extend(self.mean(runs, pixels, &pixel));
                start = end;
            }
            // Apart from the sums, where it would keep them from the registers.
            for value in &mut colours {
                *value = value.clamp(0.0, MOST_LIGHT);
            }
            halves.convert_from_f32_slice(&colours);
        }
        halves
    }

    /// The mean colour of some pixels; NaN where too little of them is covered.
    #[inline]
    fn mean<T: Copy, const C: usize>(
        &self,
        runs: &[Run],
        pixels: &[[T; C]],
        pixel: impl Fn(&[T; C]) -> [f32; 4],
    ) -> [f32; 3] {
        let [mut r, mut g, mut b, mut a] = [0.0f32; 4];
        for run in runs {
            let part = &pixels[run.pixel as usize..][..run.length as usize];
            let weights = &self.weights[run.weight as usize..][..run.length as usize];
            for (value, &weight) in part.iter().zip(weights) {
                let value = pixel(value);
                r += weight * value[0];
                g += weight * value[1];
                b += weight * value[2];
                if C.is_multiple_of(2) {
                    a += weight * value[3];
                }
            }
        }
        if !C.is_multiple_of(2) {
            // The weights sum to 1.
            [r, g, b]
        } else if f64::from(a) < LEAST_SEEN {
            [f32::NAN; 3]
        } else {
            [r / a, g / a, b / a]
        }
    }
}

/// What the footprints follow from.
struct View<'a> {
    sight: &'a Sight,
    frame: Frame,
    side: u32,
    width: u32,
    height: u32,
    rim: f64,
}

impl View<'_> {
    fn row(&self, j: u32) -> Row {
        let mut row = Row::default();
        for i in 0..self.side {
            let _ = self.add(&mut row, i, j);
        }
        row
    }

    /// Adds the texel if it is seen.
    fn add(&self, row: &mut Row, i: u32, j: u32) -> Option<()> {
        let at = |k: u32| f64::from(2 * k + 1) / f64::from(self.side) - 1.0;
        let n_xy = DVec2::new(at(i), at(j));
        let seen = self.sight.seen(n_xy, self.frame)?;
        let cell = at_least_a_pixel(DMat2::from_cols(
            self.derivative(n_xy, DVec2::X, seen.pixel)?,
            self.derivative(n_xy, DVec2::Y, seen.pixel)?,
        ));
        let (runs, weights) = (row.runs.len(), row.weights.len());
        let share = self.cover(row, seen.pixel, cell);
        if share < LEAST_SEEN {
            row.runs.truncate(runs);
            row.weights.truncate(weights);
            return None;
        }
        for weight in &mut row.weights[weights..] {
            *weight /= share as f32;
        }
        row.lengths.push((row.runs.len() - runs) as u32);
        let n = n_xy.extend((1.0 - n_xy.length_squared()).max(0.0).sqrt());
        row.texels.push(Texel { i, j, n, m: seen.normal });
        Some(())
    }

    /// How far the pixel moves over one texel along an axis.
    fn derivative(&self, n_xy: DVec2, axis: DVec2, here: DVec2) -> Option<DVec2> {
        let part = 0.25;
        let by = axis * (2.0 / f64::from(self.side) * part);
        let pixel = |n_xy| self.sight.seen(n_xy, self.frame).map(|seen| seen.pixel);
        match (pixel(n_xy + by), pixel(n_xy - by)) {
            (Some(after), Some(before)) => Some((after - before) / (2.0 * part)),
            (Some(after), None) => Some((after - here) / part),
            (None, Some(before)) => Some((here - before) / part),
            (None, None) => None,
        }
    }

    /// Adds the runs of the pixels under the parallelogram; gives the share of it that they cover.
    fn cover(&self, row: &mut Row, centre: DVec2, cell: DMat2) -> f64 {
        let (u, v) = (cell.x_axis / 2.0, cell.y_axis / 2.0);
        let sides = sides([centre - u - v, centre + u - v, centre + u + v, centre - u + v]);
        let area = 4.0 * u.perp_dot(v).abs();
        let reach = DVec2::new(u.x.abs() + v.x.abs(), u.y.abs() + v.y.abs());
        let whole = self.sight.depth(centre) > self.rim + reach.length() + 1.0;
        let low = (centre.y - reach.y).max(0.0);
        let high = (centre.y + reach.y).min(f64::from(self.height));
        let mut covered = 0.0;
        let mut y = low.floor();
        while y < high {
            covered += self.cover_row(row, &sides, y, (low.max(y), high.min(y + 1.0)), whole, area);
            y += 1.0;
        }
        covered
    }

    /// Adds one pixel row's run of the parallelogram between two heights.
    fn cover_row(
        &self,
        row: &mut Row,
        sides: &[Side; 4],
        y: f64,
        (low, high): (f64, f64),
        whole: bool,
        area: f64,
    ) -> f64 {
        // Three slabs a pixel row: exact for an upright cell, close for a slanted one.
        const SLABS: usize = 3;
        let spans: [(f64, f64); SLABS] = std::array::from_fn(|k| {
            let at = low + (high - low) * (k as f64 + 0.5) / SLABS as f64;
            let (left, right) = span(sides, at);
            (left.max(0.0), right.min(f64::from(self.width)))
        });
        let left = spans.iter().map(|span| span.0).fold(f64::MAX, f64::min);
        let right = spans.iter().map(|span| span.1).fold(f64::MIN, f64::max);
        // Pixels between these lie in all slabs.
        let inner_left = spans.iter().map(|span| span.0).fold(f64::MIN, f64::max);
        let inner_right = spans.iter().map(|span| span.1).fold(f64::MAX, f64::min);
        // Less than this share of a cell is rounding.
        let least = 1e-4;
        let per_slab = (high - low) / (SLABS as f64 * area);
        let mut covered = 0.0;
        let mut open: Option<Run> = None;
        let mut x = left.floor();
        while x < right {
            let overlap = |&(from, to): &(f64, f64)| (to.min(x + 1.0) - from.max(x)).max(0.0);
            let inner = inner_left <= x && x + 1.0 <= inner_right;
            let slabs = if inner { SLABS as f64 } else { spans.iter().map(overlap).sum() };
            let share = slabs * per_slab;
            let counts =
                share > least && (whole || self.sight.depth(DVec2::new(x + 0.5, y + 0.5)) >= self.rim);
            if counts {
                let pixel = y as u32 * self.width + x as u32;
                let start = row.weights.len() as u32;
                open.get_or_insert(Run { pixel, weight: start, length: 0 }).length += 1;
                row.weights.push(share as f32);
                covered += share;
            } else {
                row.runs.extend(open.take());
            }
            x += 1.0;
        }
        row.runs.extend(open);
        covered
    }
}

/// A side of a cell: the heights between which it runs, and where it is at each.
#[derive(Clone, Copy)]
struct Side {
    low: f64,
    high: f64,
    /// Where it would cross height 0, and by how much it moves per height.
    at_zero: f64,
    slope: f64,
}

fn sides(corners: [DVec2; 4]) -> [Side; 4] {
    std::array::from_fn(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        // A level side is never crossed.
        let slope = if a.y == b.y { 0.0 } else { (b.x - a.x) / (b.y - a.y) };
        Side { low: a.y.min(b.y), high: a.y.max(b.y), at_zero: a.x - a.y * slope, slope }
    })
}

/// Where a horizontal line crosses a convex polygon.
fn span(sides: &[Side; 4], y: f64) -> (f64, f64) {
    let mut span = (f64::MAX, f64::MIN);
    for side in sides {
        if side.low <= y && y < side.high {
            let x = side.at_zero + y * side.slope;
            span = (span.0.min(x), span.1.max(x));
        }
    }
    span
}

/// The same parallelogram, its singular values at least 1.
fn at_least_a_pixel(cell: DMat2) -> DMat2 {
    let square = cell.transpose() * cell;
    let angle = 0.5 * (2.0 * square.x_axis.y).atan2(square.x_axis.x - square.y_axis.y);
    let (first, second) = (DVec2::from_angle(angle), DVec2::from_angle(angle).perp());
    let (long, short) = (cell * first, cell * second);
    let wide = long.normalize_or(first) * long.length().max(1.0);
    // What is squeezed to nothing has no direction of its own: it is widened across the other.
    let squeezed = short.length() < 1e-6 * long.length();
    let across = if squeezed { wide.perp() } else { short };
    let narrow = across.normalize_or(second) * short.length().max(1.0);
    let outer = |a: DVec2, b: DVec2| DMat2::from_cols(a * b.x, a * b.y);
    outer(wide, first) + outer(narrow, second)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(side: f64) -> Sight {
        Sight::Parallel { centre: DVec2::splat(side / 2.0), radius: side / 2.0 }
    }

    fn picture(side: u32, value: impl Fn(u32, u32) -> f32) -> Raster {
        let pixels = (0..side * side).flat_map(|k| [value(k % side, k / side); 3]).collect();
        Raster::new(side, side, 3, Samples::F32(pixels)).unwrap()
    }

    #[test]
    fn pixels_on_the_tables_grid_come_through_untouched() {
        let footprints = Footprints::new(&ball(32.0), Frame::Half, 32, 32, 32, false);
        let texels = footprints.resample(&picture(32, |x, y| (x * 40 + y) as f32));
        assert!(footprints.texels.len() > 600);
        for (k, texel) in footprints.texels.iter().enumerate() {
            let expected = (texel.i * 40 + 31 - texel.j) as f32;
            assert_eq!(texels[3 * k].to_f32(), f16::from_f32(expected).to_f32());
        }
    }

    #[test]
    fn a_linear_ramp_is_kept_to_an_eighth_of_a_pixel() {
        for (side, pixels) in [(16, 64), (16, 50), (64, 40), (33, 77)] {
            let footprints =
                Footprints::new(&ball(f64::from(pixels)), Frame::Half, side, pixels, pixels, true);
            let texels =
                footprints.resample(&picture(pixels, |x, y| x as f32 + 0.5 + 3.0 * (y as f32 + 0.5)));
            for (k, texel) in footprints.texels.iter().enumerate() {
                if texel.n.z < 0.5 {
                    continue;
                }
                let at = |n: f64| (n + 1.0) / 2.0 * f64::from(pixels);
                let expected = at(texel.n.x) + 3.0 * at(-texel.n.y);
                let got = f64::from(texels[3 * k].to_f32());
                // A pixel that the cell's edge cuts counts with its middle.
                let wide = (f64::from(pixels) / f64::from(side)).max(1.0);
                let tolerance = (1.0 + 3.0) * 0.125 / wide + 5e-4 * expected;
                assert!((got - expected).abs() < tolerance, "{side} {pixels}: {got} {expected}");
            }
        }
    }

    #[test]
    fn a_squeezed_cell_is_widened_to_a_pixel_and_a_wide_one_kept() {
        let wide = DMat2::from_cols(DVec2::new(3.0, 1.0), DVec2::new(-1.0, 2.0));
        let kept = at_least_a_pixel(wide);
        assert!((kept.x_axis - wide.x_axis).length() < 1e-12 && (kept.y_axis - wide.y_axis).length() < 1e-12);
        let squeezed = at_least_a_pixel(DMat2::from_cols(DVec2::new(2.0, 2.0), DVec2::new(2.0, 2.0)));
        // Along the diagonal 4 long, across it one pixel.
        assert!((squeezed.determinant().abs() - 4.0).abs() < 1e-9);
    }
}
