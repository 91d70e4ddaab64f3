//! PNG row by row, and animated PNG frame by frame.

use std::io::Write as _;
use std::path::Path;

use super::{Frames, Put, Rows, Timing, file};
use crate::image::encode::srgb8;
use crate::{Error, Result};

/// Saves an 8-bit sRGB PNG with straight alpha, as [`crate::image::encode::write_png`] does, from bands that `make` puts.
///
/// # Errors
/// `make` failed, its bands do not add up to the picture, or the file cannot be written; the error names the file.
pub fn save_png(
    path: &Path,
    width: u32,
    height: u32,
    make: impl FnOnce(Put<'_>) -> Result<()>,
) -> Result<()> {
    let mut rows = Rows::of(width, height).map_err(|error| error.in_file(path))?;
    file::save(path, |out| {
        let mut writer = encoder(out, width, height).write_header().map_err(failed)?;
        let mut stream = writer.stream_writer().map_err(failed)?;
        make(&mut |band| {
            rows.take(band)?;
            let written = stream.write_all(srgb8(band).as_flattened());
            written.map_err(|error| Error::io("cannot write", error))
        })?;
        rows.finish()?;
        stream.finish().map_err(failed)?;
        writer.finish().map_err(failed)
    })
}

/// Saves an animated PNG of 8-bit sRGB frames with straight alpha that `make` puts. Programs that know no animations show
/// the first frame.
///
/// # Errors
/// An impossible timing, `make` failed, its frames are not as many or as large as was said, or the file cannot be written;
/// the error names the file.
pub fn save_apng(
    path: &Path,
    width: u32,
    height: u32,
    timing: Timing,
    make: impl FnOnce(Put<'_>) -> Result<()>,
) -> Result<()> {
    let mut frames = Frames::of(width, height, timing).map_err(|error| error.in_file(path))?;
    file::save(path, |out| {
        let mut encoder = encoder(out, width, height);
        encoder.set_animated(timing.frames, 0).map_err(failed)?;
        encoder.set_frame_delay(1, timing.per_second).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        make(&mut |frame| {
            frames.take(frame)?;
            writer.write_image_data(srgb8(frame).as_flattened()).map_err(failed)
        })?;
        frames.finish()?;
        writer.finish().map_err(failed)
    })
}

fn encoder<W: std::io::Write>(out: W, width: u32, height: u32) -> png::Encoder<'static, W> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder
}

fn failed(error: png::EncodingError) -> Error {
    match error {
        png::EncodingError::IoError(error) => Error::io("cannot write", error),
        other => Error::invalid(format!("cannot write a PNG: {other}")),
    }
}
