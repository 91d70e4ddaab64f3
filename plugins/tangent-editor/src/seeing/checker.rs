//! Squares of true size with letters: whether the flat pattern is stretched, turned or mirrored on the garment.

use amc_core::Result;
use amc_core::color::linear_from_srgb;
use amc_core::image::Picture;
use amc_core::render::Print;
use glam::{Affine2, Mat2, Vec2};
use serde::{Deserialize, Serialize};

/// The side of a square.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Square {
    /// A centimetre.
    #[default]
    Centimetre,
    /// An inch.
    Inch,
}

impl Square {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Centimetre, Self::Inch];

    /// Metres.
    pub fn side(self) -> f32 {
        match self {
            Self::Centimetre => 0.01,
            Self::Inch => 0.0254,
        }
    }

    /// From metres on the flat cloth to the tile.
    pub(super) fn laying(self) -> Affine2 {
        let size = self.side() * SQUARES as f32;
        Affine2::from_mat2(Mat2::from_diagonal(Vec2::new(1.0, -1.0) / size))
    }
}

/// Squares along a side of the tile.
const SQUARES: usize = 10;
/// Texels along a side of a square.
const TEXELS: usize = 48;
/// Texels of a dot of a letter.
const DOT: usize = 3;

/// What stands in the squares: columns are letters, rows are digits. Five dots wide and seven high; a row is a number, its highest of five
/// bits at the left.
const LETTERS: [[u8; 7]; SQUARES] = [
    [14, 17, 17, 31, 17, 17, 17],
    [30, 17, 17, 30, 17, 17, 30],
    [14, 17, 16, 16, 16, 17, 14],
    [30, 17, 17, 17, 17, 17, 30],
    [31, 16, 16, 30, 16, 16, 31],
    [31, 16, 16, 30, 16, 16, 16],
    [14, 17, 16, 23, 17, 17, 14],
    [17, 17, 17, 31, 17, 17, 17],
    [14, 4, 4, 4, 4, 4, 14],
    [7, 2, 2, 2, 2, 18, 12],
];
/// See [`LETTERS`].
const DIGITS: [[u8; 7]; SQUARES] = [
    [14, 17, 19, 21, 25, 17, 14],
    [4, 12, 4, 4, 4, 4, 14],
    [14, 17, 1, 6, 8, 16, 31],
    [31, 2, 4, 2, 1, 17, 14],
    [2, 6, 10, 18, 31, 2, 2],
    [31, 16, 30, 1, 1, 17, 14],
    [6, 8, 16, 30, 17, 17, 14],
    [31, 1, 2, 4, 8, 8, 8],
    [14, 17, 17, 14, 17, 17, 14],
    [14, 17, 17, 15, 1, 2, 12],
];

/// Ten by ten squares.
///
/// # Errors
/// None, but those of [`Print::new`].
pub(super) fn tile() -> Result<Print> {
    let side = SQUARES * TEXELS;
    let pixels = (0..side * side).map(|k| texel(k % side, k / side)).collect();
    Print::new(&Picture::new(side as u32, side as u32, pixels)?)
}

fn texel(x: usize, y: usize) -> [f32; 4] {
    let (column, row) = (x / TEXELS, y / TEXELS);
    let (x, y) = (x % TEXELS, y % TEXELS);
    let is_dark = (column + row) % 2 == 1;
    // A dark line bounds every ten squares.
    let is_border = (column == 0 && x < 2) || (row == 0 && y < 2);
    let is_ink = letter(&LETTERS[column], x, y, 6) || letter(&DIGITS[row], x, y, 27);
    let encoded = match (is_border, is_ink, is_dark) {
        (true, _, _) => [0.75, 0.16, 0.12],
        (_, true, true) => [0.92, 0.92, 0.90],
        (_, true, false) => [0.15, 0.2, 0.3],
        (_, false, true) => [0.36, 0.47, 0.60],
        (_, false, false) => [0.90, 0.88, 0.80],
    };
    let [r, g, b] = encoded.map(linear_from_srgb);
    [r, g, b, 1.0]
}

/// Whether a letter whose left edge is at `left` has ink there.
fn letter(dots: &[u8; 7], x: usize, y: usize, left: usize) -> bool {
    let top = (TEXELS - 7 * DOT) / 2;
    if x < left || y < top {
        return false;
    }
    let (x, y) = ((x - left) / DOT, (y - top) / DOT);
    x < 5 && y < 7 && dots[y] >> (4 - x) & 1 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_of_true_size_and_letters_stand_upright() {
        let tile = tile().unwrap();
        let level = &tile.levels()[0];
        let at = |square: Square, metres: Vec2| {
            let place = square.laying().transform_point2(metres);
            let texel = |at: f32| ((at - at.floor()) * level.width as f32) as usize;
            level.texels[texel(place.y) * level.width as usize + texel(place.x)]
        };
        for square in Square::ALL {
            // Along a line near the squares' tops, below their borders, tones change once a square.
            let line = |k: usize| {
                at(square, Vec2::new(square.side() * (k as f32 + 0.5) / 10.0, -0.06 * square.side()))
            };
            let tones: Vec<_> = (0..100).map(line).collect();
            assert_eq!(tones.windows(2).filter(|pair| pair[0] != pair[1]).count(), 9, "{square:?}");
        }
        // An F in the sixth column: its stem is at the left, its arms at the top and in the middle.
        let rows: Vec<usize> = LETTERS[5].iter().map(|row| row.count_ones() as usize).collect();
        assert_eq!(rows, [5, 1, 1, 4, 1, 1, 1]);
        assert!(letter(&LETTERS[5], 6, TEXELS / 2 + 8, 6) && !letter(&LETTERS[5], 18, TEXELS / 2 + 8, 6));
        assert!(letter(&LETTERS[5], 18, 14, 6));
    }
}
