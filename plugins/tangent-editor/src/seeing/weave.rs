//! A weave drawn thread by thread, as a picture that is repeated over the cloth.

use serde::{Deserialize, Serialize};

use amc_core::Result;
use amc_core::color::linear_from_srgb;
use amc_core::image::Picture;
use amc_core::render::Print;
use glam::{Affine2, Mat2, Vec2, Vec3};

/// How threads cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Binding {
    /// Over one, under one.
    #[default]
    Plain,
    /// Over two, under two, each pick one end further on.
    Twill,
    /// Over seven, under one: an eight-harness satin with a move of three, warp on the front.
    Satin,
}

impl Binding {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Twill, Self::Satin];

    /// Ends, and picks, until it repeats.
    pub fn repeat(self) -> usize {
        match self {
            Self::Plain => 2,
            Self::Twill => 4,
            Self::Satin => 8,
        }
    }

    /// Whether an end (warp thread) lies over a pick (weft thread).
    pub fn is_warp_over(self, end: usize, pick: usize) -> bool {
        match self {
            Self::Plain => (end + pick).is_multiple_of(2),
            Self::Twill => (end + 3 * pick) % 4 < 2,
            Self::Satin => !(end + 5 * pick).is_multiple_of(8),
        }
    }
}

/// A weave.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Weave {
    /// How its threads cross.
    pub binding: Binding,
    /// Warp threads to the centimetre.
    pub ends: f32,
    /// Weft threads to the centimetre.
    pub picks: f32,
    /// How many times larger it is drawn than it is.
    pub enlargement: f32,
}

impl Default for Weave {
    /// A shirting.
    fn default() -> Self {
        Self { binding: Binding::Plain, ends: 40.0, picks: 32.0, enlargement: 1.0 }
    }
}

/// Threads to the centimetre that can be drawn.
pub const COUNTS: std::ops::RangeInclusive<f32> = 1.0..=200.0;
/// How many times larger a weave can be drawn.
pub const ENLARGEMENTS: std::ops::RangeInclusive<f32> = 1.0..=100.0;

/// Texels across a thread.
const TEXELS: usize = 32;
/// sRGB values of the warp and of the weft.
const COLOURS: [[f32; 3]; 2] = [[0.93, 0.90, 0.82], [0.26, 0.42, 0.62]];

impl Weave {
    /// The same with numbers that can be drawn.
    #[must_use]
    pub fn within_bounds(self) -> Self {
        let kept = |value: f32, range: std::ops::RangeInclusive<f32>, default: f32| {
            if value.is_finite() { value.clamp(*range.start(), *range.end()) } else { default }
        };
        let plain = Self::default();
        Self {
            ends: kept(self.ends, COUNTS, plain.ends),
            picks: kept(self.picks, COUNTS, plain.picks),
            enlargement: kept(self.enlargement, ENLARGEMENTS, plain.enlargement),
            ..self
        }
    }

    /// How large a repeat is on the cloth, across and along the warp, metres.
    pub fn repeat_size(&self) -> Vec2 {
        let threads = self.binding.repeat() as f32 * self.enlargement / 100.0;
        Vec2::new(threads / self.ends, threads / self.picks)
    }

    /// A repeat: warp threads upright, the first at the left.
    ///
    /// # Errors
    /// None, but those of [`Print::new`].
    pub fn tile(&self) -> Result<Print> {
        let side = self.binding.repeat() * TEXELS;
        let pixels = (0..side * side).map(|k| self.texel(k % side, k / side)).collect();
        // Threads narrower than four pixels of the screen begin to fade; those of one pixel are gone.
        let repeat = self.binding.repeat() as u32;
        Ok(Print::new(&Picture::new(side as u32, side as u32, pixels)?)?.fading(4 * repeat, repeat))
    }

    /// From metres on the flat cloth to the tile, the warp along `along`: the thread at the origin is everywhere the first.
    pub fn laying(&self, along: Vec2) -> Affine2 {
        // Upright is along the warp.
        let upright = Mat2::from_cols(Vec2::new(along.y, along.x), Vec2::new(-along.x, along.y));
        Affine2::from_mat2(Mat2::from_diagonal(Vec2::new(1.0, -1.0) / self.repeat_size()) * upright)
    }

    fn texel(&self, x: usize, y: usize) -> [f32; 4] {
        let (end, pick) = (x / TEXELS, y / TEXELS);
        let within = |k: usize| (k % TEXELS) as f32 / TEXELS as f32 + 0.5 / TEXELS as f32 - 0.5;
        let is_warp = self.binding.is_warp_over(end, pick);
        let (across, along) = if is_warp { (within(x), within(y)) } else { (within(y), within(x)) };
        // Where the thread goes under the next one it goes down.
        let repeat = self.binding.repeat();
        let goes_on = |step: usize| match is_warp {
            true => self.binding.is_warp_over(end, (pick + step) % repeat),
            false => !self.binding.is_warp_over((end + step) % repeat, pick),
        };
        let is_on_top = goes_on(if along < 0.0 { repeat - 1 } else { 1 });
        let dip = if is_on_top { 0.0 } else { (2.0 * along.abs()).powi(2) };
        // A round thread, lit from the viewer.
        let light = (1.0 - (2.0 * across).powi(2)).max(0.0).sqrt() * (1.0 - 0.55 * dip);
        let colour = COLOURS[usize::from(!is_warp)].map(linear_from_srgb);
        let [r, g, b] = (Vec3::from_array(colour) * (0.12 + 0.88 * light)).to_array();
        [r, g, b, 1.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bindings_repeat_and_are_balanced() {
        for (binding, over) in [(Binding::Plain, 2), (Binding::Twill, 8), (Binding::Satin, 56)] {
            let repeat = binding.repeat();
            let crossings = || (0..repeat * repeat).map(|k| (k % repeat, k / repeat));
            assert_eq!(crossings().filter(|&(end, pick)| binding.is_warp_over(end, pick)).count(), over);
            for k in 0..repeat {
                let over_of = |is_end: bool| {
                    (0..repeat)
                        .filter(
                            |&j| if is_end { binding.is_warp_over(k, j) } else { binding.is_warp_over(j, k) },
                        )
                        .count()
                };
                assert!(over_of(true) == over / repeat && over_of(false) == over / repeat);
            }
        }
        // No two interlacings of a satin touch.
        let satin = |end: usize, pick: usize| !Binding::Satin.is_warp_over(end % 8, pick % 8);
        for pick in 0..8 {
            let end = (0..8).find(|&end| satin(end, pick)).unwrap();
            for (x, y) in [(1, 0), (7, 0), (0, 1), (0, 7), (1, 1), (7, 7), (1, 7), (7, 1)] {
                assert!(!satin(end + x, pick + y));
            }
        }
    }

    /// How many threads there are in `length` metres across the warp, or across the weft, counted by their dark edges.
    fn threads(weave: &Weave, along: Vec2, way: Vec2, length: f32) -> usize {
        let tile = weave.tile().unwrap();
        let level = &tile.levels()[0];
        let laying = weave.laying(along);
        // A little off the middle of a thread: not on an edge of the others.
        let start =
            (along + along.perp()) * 0.3 * weave.repeat_size().min_element() / weave.binding.repeat() as f32;
        let samples = 40_000;
        let dark = |k: usize| {
            let at = laying.transform_point2(start + way * (length * k as f32 / samples as f32));
            let texel = |at: f32, size: u32| ((at - at.floor()) * size as f32) as usize % size as usize;
            let place = texel(at.y, level.height) * level.width as usize + texel(at.x, level.width);
            // Warp and weft are alike in blue, but for the edges of the warp.
            level.texels[place][2]
        };
        let values: Vec<u8> = (0..samples).map(dark).collect();
        let limit = 140;
        values.windows(2).filter(|pair| pair[0] >= limit && pair[1] < limit).count()
    }

    #[test]
    fn the_threads_of_a_centimetre_are_as_many_as_stated() {
        for degrees in [0.0f32, 90.0, 33.0] {
            let along = Vec2::from_angle(degrees.to_radians());
            let weave = Weave { ends: 24.0, picks: 18.0, ..Weave::default() };
            let counted = [threads(&weave, along, along.perp(), 0.05), threads(&weave, along, along, 0.05)];
            assert!(
                counted[0].abs_diff(120) <= 1 && counted[1].abs_diff(90) <= 1,
                "{counted:?} at {degrees}"
            );
            let large = Weave { enlargement: 6.0, ..weave };
            let counted = threads(&large, along, along.perp(), 0.05);
            assert!(counted.abs_diff(20) <= 1, "{counted}");
        }
    }

    #[test]
    fn from_afar_it_is_one_colour_between_those_of_its_threads() {
        let tile = Weave::default().tile().unwrap();
        let last = tile.levels().last().unwrap();
        assert_eq!((last.width, last.height), (1, 1));
        let [r, _, b, _] = last.texels[0];
        assert!(r > 80 && r < 200 && b > 80 && b < 200, "{r} {b}");
        let wild =
            Weave { ends: f32::NAN, picks: -3.0, enlargement: 1e9, ..Weave::default() }.within_bounds();
        assert_eq!((wild.ends, wild.picks, wild.enlargement), (40.0, 1.0, 100.0));
    }
}
