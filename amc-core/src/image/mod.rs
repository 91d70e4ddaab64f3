//! Pictures: in linear light, rows from the top.

pub mod compare;
pub mod decode;
pub mod encode;
pub mod stream;

use crate::{Error, Result};

/// A picture in linear Rec. 709 light with straight alpha (coverage). Row 0 is the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// A picture of these pixels, row by row from the top.
    ///
    /// # Errors
    /// The number of pixels is not `width * height`.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 4]>) -> Result<Self> {
        if pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(Error::malformed(format!(
                "{} pixels given for a picture of {width} x {height}",
                pixels.len()
            )));
        }
        Ok(Self { width, height, pixels })
    }

    /// A picture of as many pixels as it needs, which the caller has just made.
    pub(crate) fn of(width: u32, height: u32, pixels: Vec<[f32; 4]>) -> Self {
        debug_assert_eq!(pixels.len() as u64, u64::from(width) * u64::from(height));
        Self { width, height, pixels }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row from the top: red, green, blue, alpha.
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }

    /// The pixels, to change them.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 4]] {
        &mut self.pixels
    }

    /// The pixel at column `x`, row `y` from the top.
    pub fn pixel(&self, x: u32, y: u32) -> [f32; 4] {
        self.pixels[y as usize * self.width as usize + x as usize]
    }
}
