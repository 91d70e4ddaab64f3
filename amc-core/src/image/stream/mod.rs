//! Pictures and animations that are saved while they are made: no more than a band of rows, or a frame, is in memory.
//!
//! Each function calls what makes the picture with a place to put the next band or frame. As with [`file::save`], the old or
//! the new file is whole at every instant, and what breaks off leaves nothing behind.

mod exr_blocks;
mod gif_frames;
mod palette;
mod png_rows;

pub use gif_frames::{Backdrop, save_gif};
pub use palette::Palette;
pub use png_rows::{save_apng, save_png};

pub use exr_blocks::save_exr;

use super::Picture;
use crate::{Error, Result, file};

/// Takes the next band of rows from the top, as wide as the picture; or the next frame, as large as the animation.
pub type Put<'a> = &'a mut dyn FnMut(&Picture) -> Result<()>;

/// How an animation runs. It is repeated without end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timing {
    /// How many frames there are.
    pub frames: u32,
    /// How many are shown in a second, 1 to [`Timing::FASTEST`].
    pub per_second: u16,
}

impl Timing {
    /// The most frames.
    pub const MOST_FRAMES: u32 = 3600;
    /// The most frames in a second that a GIF shows: programs slow down what is faster.
    pub const FASTEST: u16 = 50;

    /// Whether an animation can run so.
    ///
    /// # Errors
    /// No frames, or out of the ranges above.
    pub fn check(self) -> Result<()> {
        if !(1..=Self::MOST_FRAMES).contains(&self.frames) {
            let what = format!("{} frames; an animation has 1 to {}", self.frames, Self::MOST_FRAMES);
            return Err(Error::invalid(what));
        }
        if !(1..=Self::FASTEST).contains(&self.per_second) {
            let what = format!("{} frames per second; 1 to {} are possible", self.per_second, Self::FASTEST);
            return Err(Error::invalid(what));
        }
        Ok(())
    }
}

/// Counts the rows that were put, and refuses those that do not belong to the picture.
#[derive(Debug)]
struct Rows {
    width: u32,
    left: u32,
}

impl Rows {
    fn of(width: u32, height: u32) -> Result<Self> {
        if width == 0 || height == 0 {
            return Err(Error::invalid("a picture without pixels cannot be written"));
        }
        Ok(Self { width, left: height })
    }

    fn take(&mut self, band: &Picture) -> Result<()> {
        if band.width() != self.width || band.height() > self.left {
            let (width, height) = (band.width(), band.height());
            return Err(Error::malformed(format!(
                "a band of {width} x {height} in a picture {} wide with {} rows left",
                self.width, self.left
            )));
        }
        self.left -= band.height();
        Ok(())
    }

    fn finish(&self) -> Result<()> {
        match self.left {
            0 => Ok(()),
            left => Err(Error::malformed(format!("the picture lacks {left} rows"))),
        }
    }
}

/// Counts frames, and refuses those that do not belong to the animation.
#[derive(Debug)]
struct Frames {
    size: [u32; 2],
    timing: Timing,
    done: u32,
}

impl Frames {
    fn of(width: u32, height: u32, timing: Timing) -> Result<Self> {
        timing.check()?;
        if width == 0 || height == 0 {
            return Err(Error::invalid("frames without pixels cannot be written"));
        }
        Ok(Self { size: [width, height], timing, done: 0 })
    }

    fn take(&mut self, frame: &Picture) -> Result<()> {
        let size = [frame.width(), frame.height()];
        if size != self.size || self.done == self.timing.frames {
            return Err(Error::malformed(format!(
                "frame {} of {} x {} in an animation of {} frames of {} x {}",
                self.done, size[0], size[1], self.timing.frames, self.size[0], self.size[1]
            )));
        }
        self.done += 1;
        Ok(())
    }

    fn finish(&self) -> Result<()> {
        match self.timing.frames - self.done {
            0 => Ok(()),
            left => Err(Error::malformed(format!("the animation lacks {left} frames"))),
        }
    }
}

#[cfg(test)]
mod tests;
