//! The 256 colours of a GIF, and pictures in them.

use color_quant::NeuQuant;
use rayon::prelude::*;

use crate::image::Picture;
use crate::image::encode::srgb8;

/// Colours chosen by what is seen; one place more is for what is behind.
const COLOURS: usize = 255;

/// The index of what is behind: transparent, or the background.
pub(super) const BEHIND: u8 = 0;

/// Bits of each channel that the table of nearest colours is looked up by.
const BITS: u32 = 6;

/// The fewest pixels that colours are chosen by: the method of choosing wants some.
const FEWEST: usize = 1024;

/// The colours that all frames of a GIF are drawn in: one palette for all, so that nothing flickers.
#[derive(Debug, Clone)]
pub struct Palette {
    /// sRGB; [`BEHIND`] first.
    colours: Vec<[u8; 3]>,
    /// The index of the nearest colour but for the first, by the upper bits of red, green and blue.
    nearest: Vec<u8>,
}

impl Palette {
    /// Colours for what is opaque in these pictures. `behind`: the background, sRGB; it is in the palette as it is.
    pub fn of(samples: &[Picture], behind: Option<[u8; 3]>) -> Self {
        let behind = behind.unwrap_or_default();
        let mut seen: Vec<u8> = Vec::new();
        for [r, g, b, a] in samples.iter().flat_map(srgb8) {
            if a >= 128 && [r, g, b] != behind {
                seen.extend([r, g, b, 255]);
            }
        }
        if seen.is_empty() {
            seen = [127, 127, 127, 255].to_vec();
        }
        seen = seen.iter().copied().cycle().take(seen.len().max(4 * FEWEST)).collect();
        // Every pixel counts: the samples are small.
        let quantised = NeuQuant::new(1, COLOURS, &seen).color_map_rgb();
        let mut colours = vec![behind];
        colours.extend(quantised.as_chunks::<3>().0);
        let nearest = (0..1_u32 << (3 * BITS)).into_par_iter().map(|key| nearest(&colours, centre(key)));
        Self { nearest: nearest.collect(), colours }
    }

    /// Red, green, blue of each colour in turn.
    pub(super) fn bytes(&self) -> &[u8] {
        self.colours.as_flattened()
    }

    /// The picture's pixels by their indices. What the palette does not have is made up of its neighbours (R. Floyd,
    /// L. Steinberg, "An Adaptive Algorithm for Spatial Greyscale", 1976; every other row from the right). Pixels that are less
    /// than half covered, or have the colour of what is behind, are [`BEHIND`].
    pub(super) fn indices(&self, picture: &Picture) -> Vec<u8> {
        let width = picture.width() as usize;
        let pixels = srgb8(picture);
        let mut indices = vec![BEHIND; pixels.len()];
        // Errors of this row and of the next, in 1/16; one place more at either end.
        let mut errors = [vec![[0_i32; 3]; width + 2], vec![[0_i32; 3]; width + 2]];
        let rows = pixels.chunks_exact(width.max(1)).zip(indices.chunks_exact_mut(width.max(1)));
        for (number, (row, indices)) in rows.enumerate() {
            let [here, below] = &mut errors;
            for step in 0..width {
                let (x, ahead) = if number % 2 == 0 { (step, 1) } else { (width - 1 - step, -1) };
                let [r, g, b, a] = row[x];
                if a < 128 || [r, g, b] == self.colours[usize::from(BEHIND)] {
                    continue;
                }
                let place = x + 1;
                let wanted = [r, g, b].map(i32::from);
                let wanted: [i32; 3] =
                    std::array::from_fn(|c| (wanted[c] + (here[place][c] + 8).div_euclid(16)).clamp(0, 255));
                let index = self.nearest[key(wanted)];
                indices[x] = index;
                let found = self.colours[usize::from(index)].map(i32::from);
                let (before, after) = (place.wrapping_add_signed(-ahead), place.wrapping_add_signed(ahead));
                for c in 0..3 {
                    let error = wanted[c] - found[c];
                    here[after][c] += 7 * error;
                    below[before][c] += 3 * error;
                    below[place][c] += 5 * error;
                    below[after][c] += error;
                }
            }
            errors.swap(0, 1);
            errors[1].fill([0; 3]);
        }
        indices
    }
}

fn key(colour: [i32; 3]) -> usize {
    colour.into_iter().fold(0, |key, value| key << BITS | (value as usize >> (8 - BITS)))
}

/// The middle of the colours of one key.
fn centre(key: u32) -> [i32; 3] {
    let channel = |shift: u32| {
        let value = key >> shift & ((1 << BITS) - 1);
        ((value << (8 - BITS)) + (1 << (7 - BITS))) as i32
    };
    [channel(2 * BITS), channel(BITS), channel(0)]
}

fn nearest(colours: &[[u8; 3]], wanted: [i32; 3]) -> u8 {
    let distance = |colour: &[u8; 3]| -> i32 {
        colour.iter().zip(wanted).map(|(&a, b)| (i32::from(a) - b).pow(2)).sum()
    };
    let others = colours.iter().enumerate().skip(1);
    others.min_by_key(|(_, colour)| distance(colour)).map_or(BEHIND, |(index, _)| index as u8)
}
