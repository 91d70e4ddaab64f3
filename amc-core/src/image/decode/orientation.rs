//! How a picture is to be turned to stand upright, as the camera says in its Exif data.

use super::{Raster, Samples};

/// The tag `Orientation` (Exif 2.32, section 4.6.4), and the type of its value.
const ORIENTATION: u16 = 0x0112;
const SHORT: u16 = 3;

/// The tag's value, 1 to 8: where the rows and columns of the file are seen. 1 is upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Orientation(u16);

impl Orientation {
    /// As the file has it.
    pub(crate) const UPRIGHT: Self = Self(1);

    /// What Exif data (the TIFF header and what follows) says; upright where it says nothing, or nothing that makes sense.
    pub(super) fn of_exif(exif: &[u8]) -> Self {
        match Directory::first(exif).and_then(|directory| directory.short(ORIENTATION)) {
            Some(value @ 1..=8) => Self(value),
            _ => Self::UPRIGHT,
        }
    }

    /// The number of the tag's value.
    pub(crate) fn tag(self) -> u16 {
        self.0
    }

    /// The picture as it is to be seen.
    pub(super) fn turn(self, raster: Raster) -> Raster {
        if self == Self::UPRIGHT {
            return raster;
        }
        let sides = [raster.width as usize, raster.height as usize];
        let channels = raster.channels as usize;
        let samples = match &raster.samples {
            Samples::U8(samples) => Samples::U8(self.turn_samples(samples, sides, channels)),
            Samples::U16(samples) => Samples::U16(self.turn_samples(samples, sides, channels)),
            Samples::F32(samples) => Samples::F32(self.turn_samples(samples, sides, channels)),
        };
        let (width, height) = match self.is_transposed() {
            true => (raster.height, raster.width),
            false => (raster.width, raster.height),
        };
        Raster { width, height, channels: raster.channels, samples, orientation: self }
    }

    /// Whether the file's rows are seen as columns.
    fn is_transposed(self) -> bool {
        self.0 >= 5
    }

    fn turn_samples<T: Copy>(self, samples: &[T], [width, height]: [usize; 2], channels: usize) -> Vec<T> {
        let (columns_reversed, rows_reversed) =
            (matches!(self.0, 2 | 3 | 7 | 8), matches!(self.0, 3 | 4 | 6 | 7));
        let (across, down) = if self.is_transposed() { (height, width) } else { (width, height) };
        let mut turned = Vec::with_capacity(samples.len());
        for y in 0..down {
            for x in 0..across {
                let (column, row) = if self.is_transposed() { (y, x) } else { (x, y) };
                let column = if columns_reversed { width - 1 - column } else { column };
                let row = if rows_reversed { height - 1 - row } else { row };
                let pixel = (row * width + column) * channels;
                turned.extend_from_slice(&samples[pixel..pixel + channels]);
            }
        }
        turned
    }
}

/// A directory of tags (TIFF 6.0, section 2); nothing of it is trusted.
struct Directory<'a> {
    bytes: &'a [u8],
    big_endian: bool,
    /// Where it begins.
    at: usize,
}

impl<'a> Directory<'a> {
    fn first(bytes: &'a [u8]) -> Option<Self> {
        let big_endian = match bytes.first_chunk()? {
            b"MM\0*" => true,
            b"II*\0" => false,
            _ => return None,
        };
        let header = Self { bytes, big_endian, at: 0 };
        let at = usize::try_from(header.u32(4)?).ok()?;
        Some(Self { at, ..header })
    }

    /// The value of a tag that is one 16-bit number.
    fn short(&self, tag: u16) -> Option<u16> {
        let count = usize::from(self.u16(self.at)?);
        let mut entries = (0..count).map(|k| self.at.saturating_add(2 + 12 * k));
        let entry = entries.find(|&entry| self.u16(entry) == Some(tag))?;
        let after = |offset: usize| entry.saturating_add(offset);
        let is_one_short = self.u16(after(2))? == SHORT && self.u32(after(4))? == 1;
        if is_one_short { self.u16(after(8)) } else { None }
    }

    fn u16(&self, at: usize) -> Option<u16> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        Some(if self.big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) })
    }

    fn u32(&self, at: usize) -> Option<u32> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        Some(if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::pseudo_random::PseudoRandom;

    /// A picture of 3 x 2 pixels, two channels each: `abc` over `def`, as a letter and its capital.
    fn letters() -> Raster {
        Raster::new(3, 2, 2, Samples::U8(b"aAbBcCdDeEfF".to_vec())).unwrap()
    }

    #[test]
    fn every_orientation_turns_as_exif_draws_it() {
        // Where the file's first row and first column are seen: Exif 2.32, section 4.6.4 A.
        let expected: [(u16, &[&str]); 8] = [
            (1, &["abc", "def"]),
            (2, &["cba", "fed"]),
            (3, &["fed", "cba"]),
            (4, &["def", "abc"]),
            (5, &["ad", "be", "cf"]),
            (6, &["da", "eb", "fc"]),
            (7, &["fc", "eb", "da"]),
            (8, &["cf", "be", "ad"]),
        ];
        for (tag, rows) in expected {
            let turned = Orientation(tag).turn(letters());
            assert_eq!((turned.width as usize, turned.height as usize), (rows[0].len(), rows.len()), "{tag}");
            let Samples::U8(samples) = turned.samples() else { panic!("8 bits") };
            let seen: String = samples.chunks(2).map(|pixel| char::from(pixel[0])).collect();
            assert_eq!(seen, rows.concat(), "{tag}");
            assert!(samples.chunks(2).all(|pixel| pixel[0].to_ascii_uppercase() == pixel[1]), "{tag}");
        }
    }

    /// Exif data of two tags, the second the orientation.
    pub(in super::super) fn exif(big_endian: bool, kind: u16, value: u16) -> Vec<u8> {
        let short = |number: u16| if big_endian { number.to_be_bytes() } else { number.to_le_bytes() };
        let long = |number: u32| if big_endian { number.to_be_bytes() } else { number.to_le_bytes() };
        let mut exif = if big_endian { b"MM\0*".to_vec() } else { b"II*\0".to_vec() };
        exif.extend(long(8));
        exif.extend(short(2));
        for (tag, kind, value) in [(0x0103, SHORT, 6), (ORIENTATION, kind, value)] {
            exif.extend([short(tag), short(kind)].concat());
            exif.extend(long(1));
            exif.extend([short(value), short(0)].concat());
        }
        exif.extend(long(0));
        exif
    }

    #[test]
    fn the_tag_is_found_in_both_byte_orders_and_nonsense_is_upright() {
        for big_endian in [true, false] {
            for value in 1..=8 {
                assert_eq!(Orientation::of_exif(&exif(big_endian, SHORT, value)), Orientation(value));
            }
            for nonsense in [exif(big_endian, SHORT, 0), exif(big_endian, SHORT, 9), exif(big_endian, 4, 6)] {
                assert_eq!(Orientation::of_exif(&nonsense), Orientation::UPRIGHT);
            }
        }
        let mut far = exif(false, SHORT, 6);
        far[4..8].copy_from_slice(&[0xff; 4]);
        for nothing in [&b""[..], b"II", b"Exif", &far, &[0; 40]] {
            assert_eq!(Orientation::of_exif(nothing), Orientation::UPRIGHT);
        }
    }

    #[test]
    fn no_mutation_of_exif_panics() {
        let mut numbers = PseudoRandom::new(3);
        for round in 0..20_000 {
            let mut spoilt = exif(round % 2 == 0, SHORT, 6);
            for _ in 0..1 + numbers.below(4) {
                let at = numbers.below(spoilt.len());
                spoilt[at] = [0, 1, 0x7f, 0xff, numbers.byte()][numbers.below(5)];
            }
            spoilt.truncate(spoilt.len() - numbers.below(2) * numbers.below(spoilt.len()));
            assert!((1..=8).contains(&Orientation::of_exif(&spoilt).tag()));
        }
    }
}
