//! PNG, through the crate png.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};

use super::{Raster, Samples, check_size};
use crate::{Error, Result};

/// Deflate reaches 1032 to 1.
const MOST_RATIO: u64 = 1032;

pub(super) fn decode(bytes: &[u8]) -> Result<Raster> {
    let mut cursor = Cursor::new(bytes);
    let decoded = read(&mut cursor, bytes.len());
    let read_so_far = cursor.position();
    decoded.map_err(|failure| match failure {
        Failure::Decoder(error) => Error::malformed(format!("broken PNG: {error}")).at_byte(read_so_far),
        Failure::Ours(error) => error,
    })
}

enum Failure {
    Decoder(DecodingError),
    Ours(Error),
}

impl From<DecodingError> for Failure {
    fn from(error: DecodingError) -> Self {
        Self::Decoder(error)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Ours(error)
    }
}

fn read(cursor: &mut Cursor<&[u8]>, length: usize) -> Result<Raster, Failure> {
    // What the decoder keeps besides pixels (profiles, texts) is of no use here.
    let mut decoder = Decoder::new_with_limits(cursor, Limits { bytes: 64 << 20 });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info()?;
    let (width, height) = (header.width, header.height);
    // Packed as in the file: the decoder makes a byte of a bit, but no more than that.
    let row = (u64::from(width) * header.bits_per_pixel() as u64).div_ceil(8);
    let bytes = row.saturating_mul(u64::from(height));
    check_size(u64::from(width), u64::from(height), bytes, length, MOST_RATIO)?;
    let mut reader = decoder.read_info()?;
    let (colour, depth) = reader.output_color_type();
    let channels = match colour {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb | ColorType::Indexed => 3,
        ColorType::Rgba => 4,
    };
    let size = reader.output_buffer_size().ok_or_else(|| Error::too_large("the picture is too large"))?;
    let mut samples = vec![0; size];
    reader.next_frame(&mut samples)?;
    let samples = if depth == BitDepth::Sixteen {
        Samples::U16(samples.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect())
    } else {
        Samples::U8(samples)
    };
    Ok(Raster::new(width, height, channels, samples)?)
}
