//! Pictures read from JPEG, PNG and OpenEXR files.
//!
//! The format is told by the first bytes, never by the file's name. What a file declares is checked against
//! [`MOST_PIXELS`] and against its own length before anything is allocated for it.

mod exr;
mod jpeg;
mod orientation;
mod png;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::LazyLock;

use super::Picture;
use crate::color::{LINEAR_FROM_SRGB8, linear_from_srgb};
use crate::{Error, Result};
pub(crate) use orientation::Orientation;

/// The most pixels that a picture may have: 8192 x 8192.
pub const MOST_PIXELS: u64 = 1 << 26;

/// The most bytes that a picture's file may have: 1 GiB, what [`MOST_PIXELS`] of four 32-bit floats take.
pub const MOST_BYTES: u64 = 1 << 30;

/// A picture may always take this much memory, however small its file.
const FREE_BYTES: u64 = 1 << 20;

/// Linear light of the 65536 16-bit sRGB values.
pub(crate) static LINEAR_FROM_SRGB16: LazyLock<Vec<f32>> =
    LazyLock::new(|| (0..=u16::MAX).map(|value| linear_from_srgb(f32::from(value) / 65535.0)).collect());

/// The samples of a [`Raster`], pixel by pixel, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// sRGB-encoded (alpha linear), 0 to 255.
    U8(Vec<u8>),
    /// sRGB-encoded (alpha linear), 0 to 65535.
    U16(Vec<u16>),
    /// Linear Rec. 709, straight alpha.
    F32(Vec<f32>),
}

impl Samples {
    fn len(&self) -> usize {
        match self {
            Self::U8(samples) => samples.len(),
            Self::U16(samples) => samples.len(),
            Self::F32(samples) => samples.len(),
        }
    }
}

/// A picture as its file holds it, turned as the camera was held where the file says it. Row 0 is the top; alpha is
/// straight.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    width: u32,
    height: u32,
    channels: u32,
    samples: Samples,
    orientation: Orientation,
}

impl Raster {
    /// A raster of `channels` (1: grey, 2: grey and alpha, 3: colour, 4: colour and alpha) per pixel.
    ///
    /// # Errors
    /// No such number of channels, no pixels, or the number of samples is not `width * height * channels`.
    pub fn new(width: u32, height: u32, channels: u32, samples: Samples) -> Result<Self> {
        if !(1..=4).contains(&channels) {
            return Err(Error::unsupported(format!(
                "{channels} channels per pixel; grey or colour, with or without alpha, are read"
            )));
        }
        let expected = u128::from(width) * u128::from(height) * u128::from(channels);
        if expected == 0 || samples.len() as u128 != expected {
            return Err(Error::malformed(format!(
                "{} samples given for a picture of {width} x {height} pixels of {channels} channels",
                samples.len()
            )));
        }
        Ok(Self { width, height, channels, samples, orientation: Orientation::UPRIGHT })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Samples per pixel: 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha.
    pub fn channels(&self) -> u32 {
        self.channels
    }

    /// What the samples take in memory.
    pub(crate) fn bytes(&self) -> u64 {
        let sample = match &self.samples {
            Samples::U8(_) => 1,
            Samples::U16(_) => 2,
            Samples::F32(_) => 4,
        };
        self.samples.len() as u64 * sample
    }

    /// How the picture has been turned since it was read.
    pub(crate) fn orientation(&self) -> Orientation {
        self.orientation
    }

    /// The samples.
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The memory of 8-bit samples, to use again.
    pub(crate) fn into_buffer(self) -> Option<Vec<u8>> {
        match self.samples {
            Samples::U8(samples) => Some(samples),
            Samples::U16(_) | Samples::F32(_) => None,
        }
    }

    /// Whether it has an alpha channel.
    pub fn has_alpha(&self) -> bool {
        self.channels.is_multiple_of(2)
    }

    /// The picture in linear light; grey is spread over the three colours, a missing alpha is 1.
    pub fn to_picture(&self) -> Picture {
        Picture { width: self.width, height: self.height, pixels: self.linear(|value| value) }
    }

    /// The pixels of [`Raster::to_picture`], each number as `store` makes it.
    pub(crate) fn linear<P: Copy>(&self, store: impl Fn(f32) -> P) -> Vec<[P; 4]> {
        let one = store(1.0);
        match &self.samples {
            Samples::U8(samples) => {
                let colour = |value| store(LINEAR_FROM_SRGB8[usize::from(value)]);
                self.spread(samples, colour, |alpha| store(f32::from(alpha) / 255.0), one)
            }
            Samples::U16(samples) => {
                let table = &*LINEAR_FROM_SRGB16;
                let colour = |value| store(table[usize::from(value)]);
                self.spread(samples, colour, |alpha| store(f32::from(alpha) / 65535.0), one)
            }
            Samples::F32(samples) => self.spread(samples, &store, &store, one),
        }
    }

    /// Four numbers a pixel: grey is spread over the three colours, a missing alpha is `one`.
    pub(crate) fn spread<T: Copy, P: Copy>(
        &self,
        samples: &[T],
        colour: impl Fn(T) -> P,
        alpha: impl Fn(T) -> P,
        one: P,
    ) -> Vec<[P; 4]> {
        let pixel = |pixel: &[T]| match *pixel {
            [y] => [colour(y), colour(y), colour(y), one],
            [y, a] => [colour(y), colour(y), colour(y), alpha(a)],
            [r, g, b] => [colour(r), colour(g), colour(b), one],
            [r, g, b, a, ..] => [colour(r), colour(g), colour(b), alpha(a)],
            [] => [one; 4],
        };
        samples.chunks_exact(self.channels as usize).map(pixel).collect()
    }
}

/// The formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// JPEG, baseline or progressive, grey or colour; turned and mirrored as its Exif tag `Orientation` says.
    Jpeg,
    /// PNG, every colour type and depth; of an animation the first picture.
    Png,
    /// OpenEXR, the first flat layer's R, G, B, A or Y, A.
    Exr,
}

impl Format {
    /// The format that a file's first bytes announce.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(&[0xff, 0xd8]) {
            Some(Self::Jpeg)
        } else if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            Some(Self::Png)
        } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
            Some(Self::Exr)
        } else {
            None
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Jpeg => "JPEG",
            Self::Png => "PNG",
            Self::Exr => "OpenEXR",
        }
    }
}

/// Decodes a JPEG, PNG or OpenEXR file's bytes.
///
/// # Errors
/// No such file, a broken or cut one, one of more than [`MOST_PIXELS`] or of more than its length can justify,
/// or an EXR sample that is not a finite number. The place is a byte where the decoder tells it.
pub fn decode(bytes: &[u8]) -> Result<Raster> {
    decode_rows(bytes, Vec::new(), usize::MAX)
}

/// [`decode`], for many pictures one after the other of which only the file's first `rows` are looked at: what lies
/// below may hold anything, and need not be decoded. Where the samples are 8-bit ones of a JPEG they are put into
/// `buffer`, as [`Raster::into_buffer`] of an earlier one gives it, which saves taking new memory for each.
pub(crate) fn decode_rows(bytes: &[u8], buffer: Vec<u8>, rows: usize) -> Result<Raster> {
    if bytes.is_empty() {
        return Err(Error::malformed("the file is empty").at_byte(0));
    }
    let format = Format::of(bytes).ok_or_else(|| {
        Error::unsupported("not a picture that can be read: JPEG, PNG and OpenEXR are").at_byte(0)
    })?;
    // The decoders are other people's code: should one of them panic on a broken file, it is an error all the same.
    let decoded = catch_unwind(AssertUnwindSafe(|| match format {
        Format::Jpeg => jpeg::decode(bytes, buffer, rows),
        Format::Png => png::decode(bytes),
        Format::Exr => exr::decode(bytes),
    }));
    decoded.unwrap_or_else(|_| {
        Err(Error::malformed(format!(
            "the {} data is broken beyond what the decoder can tell",
            format.name()
        )))
    })
}

/// Reads a picture's file as it is.
///
/// # Errors
/// As [`decode`]; or it cannot be read, or is larger than [`MOST_BYTES`]. The error names the file.
pub fn read_raster(path: &Path) -> Result<Raster> {
    let bytes = crate::file::read(path, MOST_BYTES)?;
    decode(&bytes).map_err(|error| error.in_file(path))
}

/// Reads a picture's file into linear light.
///
/// # Errors
/// As [`read_raster`].
pub fn read(path: &Path) -> Result<Picture> {
    Ok(read_raster(path)?.to_picture())
}

/// Refuses a declared size of `bytes` decoded bytes that is over [`MOST_PIXELS`], or that a file of `length` bytes
/// cannot hold at `most_ratio` decoded bytes per byte, what its compression can reach at best.
fn check_size(width: u64, height: u64, bytes: u64, length: usize, most_ratio: u64) -> Result<()> {
    if width == 0 || height == 0 {
        return Err(Error::malformed(format!("declares {width} x {height} pixels")));
    }
    if width.checked_mul(height).is_none_or(|pixels| pixels > MOST_PIXELS) {
        return Err(Error::too_large(format!(
            "declares {width} x {height} pixels; the limit is {MOST_PIXELS}"
        )));
    }
    if bytes > FREE_BYTES.max((length as u64).saturating_mul(most_ratio)) {
        return Err(Error::too_large(format!(
            "declares {width} x {height} pixels, more than a file of {length} bytes can hold"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
