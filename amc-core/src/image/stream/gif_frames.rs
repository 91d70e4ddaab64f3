//! GIF frame by frame.

use std::borrow::Cow;
use std::path::Path;

use gif::{DisposalMethod, Frame, Repeat};

use super::palette::BEHIND;
use super::{Frames, Palette, Put, Timing, file};
use crate::{Error, Result};

/// What is behind the garment in a GIF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Backdrop {
    /// Nothing: pixels that are covered by less than half are clear, the others opaque. A GIF knows nothing between.
    Transparent,
    /// The colour that the palette was made with.
    Opaque,
}

/// Saves a GIF of frames that `make` puts, in the colours of `palette`.
///
/// # Errors
/// An impossible timing, frames of more than 65535 columns or rows, `make` failed, its frames are not as many or as large
/// as was said, or the file cannot be written; the error names the file.
pub fn save_gif(
    path: &Path,
    width: u32,
    height: u32,
    timing: Timing,
    (palette, backdrop): (&Palette, Backdrop),
    make: impl FnOnce(Put<'_>) -> Result<()>,
) -> Result<()> {
    let mut frames = Frames::of(width, height, timing).map_err(|error| error.in_file(path))?;
    let side = |length: u32| {
        u16::try_from(length).map_err(|_| {
            Error::too_large(format!("frames of {width} x {height}; a GIF's sides are 65535 at most"))
                .in_file(path)
        })
    };
    let (width, height) = (side(width)?, side(height)?);
    file::save(path, |out| {
        let mut encoder = gif::Encoder::new(out, width, height, palette.bytes()).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        make(&mut |frame| {
            frames.take(frame)?;
            let is_clear = backdrop == Backdrop::Transparent;
            let frame = Frame {
                delay: delay(timing, frames.done - 1),
                // What is transparent would else show the frame before.
                dispose: if is_clear { DisposalMethod::Background } else { DisposalMethod::Keep },
                transparent: is_clear.then_some(BEHIND),
                width,
                height,
                buffer: Cow::Owned(palette.indices(frame)),
                ..Frame::default()
            };
            encoder.write_frame(&frame).map_err(failed)
        })?;
        frames.finish()?;
        // It writes the end.
        encoder.into_inner().map(|_| ()).map_err(failed)
    })
}

/// How long frame `k` is shown, in 1/100 s: so rounded that the frames' ends are never off by more than half of that.
fn delay(timing: Timing, k: u32) -> u16 {
    let end = |k: u64| (100 * k + u64::from(timing.per_second) / 2) / u64::from(timing.per_second.max(1));
    (end(u64::from(k) + 1) - end(u64::from(k))) as u16
}

fn failed(error: gif::EncodingError) -> Error {
    match error {
        gif::EncodingError::Io(error) => Error::io("cannot write", error),
        other => Error::invalid(format!("cannot write a GIF: {other}")),
    }
}
