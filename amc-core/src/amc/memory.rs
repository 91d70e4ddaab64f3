//! What a table takes.

use serde::Serialize;

use super::{Amc, TableSize, TexelFormat};
use crate::{Error, Result};

/// Bytes a table takes in its several forms. (The paper's figures for 256 x 256 x 512 are half of what they should be.)
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Memory {
    /// The colours alone, three channels: how the paper counts (section 4.1).
    pub colours: u64,
    /// As a texture on the GPU: four channels.
    pub texture: u64,
    /// As a texture in 4 x 4 blocks of 16 bytes: BC7 for 8-bit tables, BC6H for half-float ones.
    pub compressed: u64,
}

impl TableSize {
    /// The most bytes of texels that a table may have to be read, written or baked: 2 GiB, as 1024 x 1024 x 256 half
    /// floats take.
    pub const MOST_BYTES: u64 = 2 << 30;

    /// Checks the size of a table that is about to be made.
    ///
    /// # Errors
    /// Its texels are over [`TableSize::MOST_BYTES`].
    pub fn check_bytes(self, format: TexelFormat) -> Result<()> {
        let bytes = self.memory(format).texture;
        if bytes <= Self::MOST_BYTES {
            return Ok(());
        }
        Err(Error::too_large(format!(
            "a table of {} x {} x {} texels takes {bytes} bytes; the limit is {}",
            self.side(),
            self.side(),
            self.slices(),
            Self::MOST_BYTES
        )))
    }

    /// What a table of this size takes.
    pub fn memory(self, format: TexelFormat) -> Memory {
        let texels = u64::from(self.side()).pow(2) * u64::from(self.slices());
        let channel = format.bytes() as u64 / 4;
        let blocks = u64::from(self.side().div_ceil(4));
        Memory {
            colours: texels * 3 * channel,
            texture: texels * 4 * channel,
            compressed: blocks * blocks * 16 * u64::from(self.slices()),
        }
    }
}

impl Amc {
    /// What this table takes.
    pub fn memory(&self) -> Memory {
        self.size().memory(self.format())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figures_of_the_paper_put_right() {
        let memory = |side, slices, format| TableSize::new(side, slices).unwrap().memory(format);
        const MIB: u64 = 1 << 20;
        // Section 4.1: 128 x 128 x 256 in 24 bits is 12 MiB; 256 x 256 x 512 is 96 MiB, not the 48 it says.
        assert_eq!(memory(128, 256, TexelFormat::Srgb8).colours, 12 * MIB);
        assert_eq!(memory(256, 512, TexelFormat::Srgb8).colours, 96 * MIB);
        let cube = memory(128, 128, TexelFormat::Half);
        assert_eq!((cube.texture, cube.compressed), (16 * MIB, 2 * MIB));
        assert_eq!(memory(5, 3, TexelFormat::Srgb8).compressed, 4 * 16 * 3);
    }
}
