//! Prints: a colour picture over a fabric, repeated over the flat pattern and multiplied in.

use glam::{Vec2, Vec3};

use crate::color::{LINEAR_FROM_SRGB8, srgb8_from_linear};
use crate::image::Picture;
use crate::{Error, Result};

/// A picture made ready to be printed: what the light that a fabric gives back is multiplied by, in 8-bit sRGB, with
/// smaller and smaller copies for when it is seen from afar.
#[derive(Debug, PartialEq)]
pub struct Print {
    /// Each half the size of the one before, down to one pixel.
    levels: Vec<Level>,
}

/// A picture at one size.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// sRGB-encoded, row by row from the top. Alpha is 255.
    pub texels: Vec<[u8; 4]>,
}

impl Print {
    /// The longest side of a print, pixels: what every graphics device holds. Larger pictures are made smaller.
    pub const LARGEST: u32 = 2048;

    /// From a picture. Where it is transparent the fabric stays as it is; what is brighter than white counts as white.
    ///
    /// # Errors
    /// It has no pixels.
    pub fn new(picture: &Picture) -> Result<Self> {
        if picture.pixels().is_empty() {
            return Err(Error::invalid("the print's picture has no pixels"));
        }
        let ink = |&[r, g, b, alpha]: &[f32; 4]| {
            let alpha = alpha.clamp(0.0, 1.0);
            Vec3::ONE.lerp(Vec3::new(r, g, b).clamp(Vec3::ZERO, Vec3::ONE), alpha)
        };
        let (mut width, mut height) = (picture.width() as usize, picture.height() as usize);
        let mut inks: Vec<Vec3> = picture.pixels().iter().map(ink).collect();
        let mut levels = Vec::new();
        loop {
            if width.max(height) <= Self::LARGEST as usize {
                levels.push(Level::new(width, height, &inks));
            }
            if width.max(height) == 1 {
                return Ok(Self { levels });
            }
            let half = [width, height].map(|size| (size / 2).max(1));
            inks = shrunk(&inks, [width, height], half);
            [width, height] = half;
        }
    }

    /// The same, of whose copies those narrower than `whole` are nearer to their mean colour, and those of `gone` and narrower are it: for
    /// fine regular patterns, which would beat with the screen's pixels.
    #[must_use]
    pub fn fading(mut self, whole: u32, gone: u32) -> Self {
        let mean = self.levels.last().and_then(|level| level.texels.first()).copied().unwrap_or([255; 4]);
        let mean = mean.map(|byte| LINEAR_FROM_SRGB8[usize::from(byte)]);
        let steps = (whole.max(1) as f32 / gone.max(1) as f32).log2().max(1.0);
        for level in self.levels.iter_mut().filter(|level| level.width < whole) {
            let share = ((whole as f32 / level.width as f32).log2() / steps).clamp(0.0, 1.0);
            for texel in level.texels.iter_mut().flat_map(|texel| texel.iter_mut().zip(mean).take(3)) {
                let (byte, mean) = texel;
                let light = LINEAR_FROM_SRGB8[usize::from(*byte)];
                *byte = srgb8_from_linear(light + (mean - light) * share);
            }
        }
        self
    }

    /// The picture and its smaller copies, the largest first.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Columns and rows of the largest level.
    pub(super) fn size(&self) -> Vec2 {
        self.levels.first().map_or(Vec2::ONE, |level| Vec2::new(level.width as f32, level.height as f32))
    }

    /// Height over width.
    pub fn aspect(&self) -> f32 {
        self.size().y / self.size().x
    }

    /// The colour, linear, at `at` in repeats, where a pixel of the screen is as wide as `width` of the largest level's
    /// pixels: mixed from the two nearest levels. Twin of `look_up_print` in `shaders/print.wgsl`.
    pub(super) fn look_up(&self, at: Vec2, width: f32) -> Vec3 {
        let top = self.levels.len() - 1;
        let level = width.max(1.0).log2().clamp(0.0, top as f32);
        let fine = (level as usize).min(top);
        let coarse = (fine + 1).min(top);
        self.levels[fine].look_up(at).lerp(self.levels[coarse].look_up(at), level - fine as f32)
    }

    /// How wide a pixel of the screen is, in pixels of the largest level, from what changes in repeats to its right and
    /// below.
    pub(super) fn width(&self, right: Vec2, below: Vec2) -> f32 {
        (right * self.size()).length().max((below * self.size()).length())
    }
}

impl Level {
    fn new(width: usize, height: usize, inks: &[Vec3]) -> Self {
        let encode = |ink: &Vec3| {
            let [r, g, b] = ink.to_array().map(srgb8_from_linear);
            [r, g, b, 255]
        };
        Self { width: width as u32, height: height as u32, texels: inks.iter().map(encode).collect() }
    }

    /// Bilinear in linear light, going round at the edges.
    fn look_up(&self, at: Vec2) -> Vec3 {
        let axis = |coordinate: f32, size: u32| {
            let at = coordinate * size as f32 - 0.5;
            let low = at.floor();
            // A conversion to an integer saturates, and takes what is no number for 0.
            let index = (low as i64).rem_euclid(i64::from(size)) as usize;
            (index, (index + 1) % size as usize, at - low)
        };
        let (left, right, across) = axis(at.x, self.width);
        let (top, bottom, down) = axis(at.y, self.height);
        let texel = |x: usize, y: usize| {
            let [r, g, b, _] = self.texels[y * self.width as usize + x];
            Vec3::from_array([r, g, b].map(|byte| LINEAR_FROM_SRGB8[usize::from(byte)]))
        };
        let row = |y: usize| texel(left, y).lerp(texel(right, y), across);
        row(top).lerp(row(bottom), down)
    }
}

/// The means over the areas that fewer pixels cover.
fn shrunk(inks: &[Vec3], [width, height]: [usize; 2], [columns, rows]: [usize; 2]) -> Vec<Vec3> {
    let narrow: Vec<Vec3> =
        inks.chunks_exact(width).flat_map(|row| means(row.len(), columns, |x| row[x])).collect();
    let mut small = vec![Vec3::ZERO; columns * rows];
    for x in 0..columns {
        for (y, mean) in means(height, rows, |y| narrow[y * columns + x]).into_iter().enumerate() {
            small[y * columns + x] = mean;
        }
    }
    small
}

/// `count` values made into `fewer`, each the mean over its share of the length.
fn means(count: usize, fewer: usize, value: impl Fn(usize) -> Vec3) -> Vec<Vec3> {
    let step = count as f32 / fewer as f32;
    let mean = |k: usize| {
        let (start, end) = (k as f32 * step, (k + 1) as f32 * step);
        let cells = start as usize..(end.ceil() as usize).min(count);
        let share = |cell: usize| (end.min(cell as f32 + 1.0) - start.max(cell as f32)).max(0.0);
        cells.map(|cell| value(cell) * share(cell)).sum::<Vec3>() / step
    };
    (0..fewer).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn print(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [f32; 4]) -> Print {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels = places.map(|(x, y)| pixel(x, y)).collect();
        Print::new(&Picture::new(width, height, pixels).unwrap()).unwrap()
    }

    #[test]
    fn levels_halve_down_to_one_pixel_and_keep_the_mean() {
        let made = print(7, 3, |x, y| [x as f32 / 6.0, y as f32 / 2.0, 0.25, 1.0]);
        let sizes: Vec<_> = made.levels().iter().map(|level| (level.width, level.height)).collect();
        assert_eq!(sizes, [(7, 3), (3, 1), (1, 1)]);
        let last = made.levels()[2].texels[0].map(|byte| LINEAR_FROM_SRGB8[usize::from(byte)]);
        for (got, wanted) in last.iter().zip([0.5, 0.5, 0.25]) {
            assert!((got - wanted).abs() < 4e-3, "{last:?}");
        }
        let large = print(3 * Print::LARGEST, 2, |_, _| [0.5; 4]);
        assert_eq!((large.levels()[0].width, large.levels()[0].height), (Print::LARGEST * 3 / 4, 1));
    }

    #[test]
    fn what_is_transparent_leaves_the_fabric_alone_and_nothing_brightens_it() {
        let made = print(2, 1, |x, _| if x == 0 { [0.0, 0.0, 0.0, 0.0] } else { [9.0, -1.0, f32::NAN, 1.0] });
        assert_eq!(made.levels()[0].texels[0], [255; 4]);
        assert_eq!(made.levels()[0].texels[1][..2], [255, 0]);
        assert!(Print::new(&Picture::new(0, 0, Vec::new()).unwrap()).is_err());
    }

    #[test]
    fn a_fading_print_is_its_mean_where_it_is_small() {
        let stripes = |fade: bool| {
            let made = print(16, 16, |x, _| [(x / 8) as f32, 0.0, 1.0, 1.0]);
            if fade { made.fading(8, 2) } else { made }
        };
        let (plain, fading) = (stripes(false), stripes(true));
        assert_eq!(fading.levels()[..2], plain.levels()[..2]);
        let contrast = |print: &Print, level: usize| {
            let light = |k: usize| LINEAR_FROM_SRGB8[usize::from(print.levels()[level].texels[k][0])];
            light(print.levels()[level].width as usize - 1) - light(0)
        };
        assert!((contrast(&plain, 2) - 1.0).abs() < 1e-3 && (contrast(&fading, 2) - 0.5).abs() < 5e-3);
        assert_eq!(contrast(&fading, 3), 0.0);
        assert_eq!(fading.levels()[4], plain.levels()[4]);
    }

    #[test]
    fn it_repeats_and_is_looked_up_at_the_centres_of_its_pixels() {
        let made = print(2, 2, |x, y| [x as f32, y as f32, 0.0, 1.0]);
        for repeat in [-3.0, 0.0, 40.0] {
            let at = |x: f32, y: f32| made.look_up(Vec2::new(repeat + x, repeat + y), 1.0);
            assert_eq!([at(0.25, 0.25), at(0.75, 0.75)], [Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0)]);
            assert_eq!(at(0.0, 0.25), Vec3::new(0.5, 0.0, 0.0), "between the last column and the first");
        }
        let afar = made.look_up(Vec2::splat(0.3), 1e9);
        assert!((afar - Vec3::new(0.5, 0.5, 0.0)).abs().max_element() < 4e-3, "{afar}");
        let between = made.look_up(Vec2::splat(0.75), std::f32::consts::SQRT_2);
        assert!((between.x - 0.75).abs() < 4e-3, "half way between two levels: {between}");
        // A surface without a place has no colour, but it stops nobody.
        made.look_up(Vec2::NAN, f32::NAN);
    }
}
