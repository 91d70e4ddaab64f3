//! JPEG, through zune-jpeg.

use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use super::{Orientation, Raster, Samples, check_size};
use crate::{Error, Result};

/// A blank baseline picture takes 6 bits for 16 x 16 pixels of three bytes: 1024 to 1. Twice that.
const MOST_RATIO: u64 = 2048;

/// `buffer`'s memory is used again for the samples. Only the file's first `rows` need be decoded: those below may hold
/// anything.
pub(super) fn decode(bytes: &[u8], mut buffer: Vec<u8>, rows: usize) -> Result<Raster> {
    let shortened = shortened(bytes, rows);
    let (bytes, full_height) = match &shortened {
        Some((bytes, full_height)) => (bytes.as_slice(), Some(*full_height)),
        None => (bytes, None),
    };
    // Strict: broken data is an error, not a half-grey picture.
    let options =
        DecoderOptions::new_fast().set_max_width(65_535).set_max_height(65_535).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let broken = |error: zune_jpeg::errors::DecodeErrors| {
        let error = Error::malformed(format!("broken JPEG: {error:?}").replace('"', ""));
        if is_cut(bytes) { error.at_byte(bytes.len() as u64) } else { error }
    };
    decoder.decode_headers().map_err(broken)?;
    let unknown = || Error::malformed("broken JPEG: no size");
    let (width, decoded) = decoder.dimensions().ok_or_else(unknown)?;
    let height = full_height.unwrap_or(decoded);
    let grey = decoder.input_colorspace().ok_or_else(unknown)? == ColorSpace::Luma;
    let (space, channels) = if grey { (ColorSpace::Luma, 1) } else { (ColorSpace::RGB, 3) };
    let size = width as u64 * height as u64 * channels;
    check_size(width as u64, height as u64, size, bytes.len(), MOST_RATIO)?;
    decoder.set_options(options.jpeg_set_out_colorspace(space));
    buffer.resize(size as usize, 0);
    decoder.decode_into(&mut buffer[..width * decoded * channels as usize]).map_err(broken)?;
    let raster = Raster::new(width as u32, height as u32, channels as u32, Samples::U8(buffer))?;
    let orientation = decoder.exif().map_or(Orientation::UPRIGHT, |exif| Orientation::of_exif(exif));
    Ok(orientation.turn(raster))
}

/// Whether the file has lost its end.
fn is_cut(bytes: &[u8]) -> bool {
    !bytes.windows(2).rev().take(1 << 16).any(|pair| pair == [0xff, 0xd9])
}

/// The file, said to be of fewer rows, but of `rows` at least, and how many it has: the decoder can be told to stop in
/// no other way. `None` where nothing would be saved, or where the rows do not follow each other in the file.
fn shortened(bytes: &[u8], rows: usize) -> Option<(Vec<u8>, usize)> {
    let frame = Frame::find(bytes)?;
    // Where colour is coarser than brightness, the rows below have a part in a row's.
    let blocks = rows.min(frame.height).div_ceil(frame.block_rows).max(1) + usize::from(frame.block_rows > 8);
    let height = blocks * frame.block_rows;
    // A file that has lost its end is to be decoded as far as it goes, to say so.
    (height < frame.height && !is_cut(bytes)).then(|| {
        let mut shortened = bytes.to_vec();
        shortened[frame.height_at..][..2].copy_from_slice(&(height as u16).to_be_bytes());
        (shortened, frame.height)
    })
}

/// What a JPEG's frame header (ITU T.81, B.2.2) says of its rows.
struct Frame {
    /// Where the height is written, 16 bits.
    height_at: usize,
    height: usize,
    /// Rows that are coded together.
    block_rows: usize,
}

impl Frame {
    /// The frame of a file whose rows follow each other: neither progressive nor one channel after the other.
    fn find(bytes: &[u8]) -> Option<Self> {
        let mut at = 2;
        let mut found: Option<(Self, u8)> = None;
        loop {
            let &[0xff, marker, high, low] = bytes.get(at..)?.first_chunk()? else { return None };
            let end = at + 2 + usize::from(u16::from_be_bytes([high, low]));
            let segment = bytes.get(at + 4..end)?;
            match marker {
                // Baseline, and the same with 12 bits or more tables.
                0xc0 | 0xc1 if found.is_none() => {
                    let &[_, high, low, _, _, components] = segment.first_chunk()?;
                    let samplings = segment[6..].iter().skip(1).step_by(3).map(|sampling| sampling & 15);
                    let frame = Self {
                        height_at: at + 5,
                        height: usize::from(u16::from_be_bytes([high, low])),
                        block_rows: 8 * usize::from(samplings.max()?.max(1)),
                    };
                    found = Some((frame, components));
                }
                // The first scan.
                0xda => {
                    return found.and_then(|(frame, all)| (segment.first() == Some(&all)).then_some(frame));
                }
                // Tables, and what is not about the picture.
                0xc4 | 0xcc | 0xdb..=0xef | 0xfe => {}
                // Another frame, or what has no place before a scan.
                _ => return None,
            }
            at = end;
        }
    }
}
