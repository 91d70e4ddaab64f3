//! JPEG, through zune-jpeg.

use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use super::{Orientation, Raster, Samples, check_size};
use crate::{Error, Result};

/// A blank baseline picture takes 6 bits for 16 x 16 pixels of three bytes: 1024 to 1. Twice that.
const MOST_RATIO: u64 = 2048;

/// `buffer`'s memory is used again for the samples.
pub(super) fn decode(bytes: &[u8], mut buffer: Vec<u8>) -> Result<Raster> {
    // Strict: broken data is an error, not a half-grey picture.
    let options =
        DecoderOptions::new_fast().set_max_width(65_535).set_max_height(65_535).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let broken = |error: zune_jpeg::errors::DecodeErrors| {
        let cut = !bytes.windows(2).rev().take(1 << 16).any(|pair| pair == [0xff, 0xd9]);
        let error = Error::malformed(format!("broken JPEG: {error:?}").replace('"', ""));
        if cut { error.at_byte(bytes.len() as u64) } else { error }
    };
    decoder.decode_headers().map_err(broken)?;
    let unknown = || Error::malformed("broken JPEG: no size");
    let (width, height) = decoder.dimensions().ok_or_else(unknown)?;
    let grey = decoder.input_colorspace().ok_or_else(unknown)? == ColorSpace::Luma;
    let (space, channels) = if grey { (ColorSpace::Luma, 1) } else { (ColorSpace::RGB, 3) };
    let size = width as u64 * height as u64 * channels;
    check_size(width as u64, height as u64, size, bytes.len(), MOST_RATIO)?;
    decoder.set_options(options.jpeg_set_out_colorspace(space));
    buffer.resize(size as usize, 0);
    decoder.decode_into(&mut buffer).map_err(broken)?;
    let raster = Raster::new(width as u32, height as u32, channels as u32, Samples::U8(buffer))?;
    let orientation = decoder.exif().map_or(Orientation::UPRIGHT, |exif| Orientation::of_exif(exif));
    Ok(orientation.turn(raster))
}
