//! AMC files: KTX2 (Khronos KTX File Format 2.0), so that any KTX2 reader can show them.
//!
//! One level of a 3D texture, `R8G8B8A8_SRGB` or `R16G16B16A16_SFLOAT`, Zstandard supercompression, and three keys:
//! `KTXorientation` = `ruo`, `KTXwriter`, and `amc`, JSON that says how to read the table and what is known about it.

mod read;
#[cfg(test)]
mod tests;
mod write;

use std::path::Path;

use super::{Amc, TableSize, TexelFormat};
use crate::{Result, file};

/// The key of our JSON.
const KEY: &str = "amc";

/// Bytes of texels that a file of any size may hold (a table of one colour packs into next to nothing); a larger table
/// may be [`RATIO_LIMIT`] times as large as its file.
const FREE_BYTES: u64 = 64 << 20;

/// See [`FREE_BYTES`].
const RATIO_LIMIT: u64 = 1000;

/// Whether a file of `packed` bytes of texels may unpack to `bytes`: the reader refuses others, the writer makes none.
fn is_justified(packed: u64, bytes: u64) -> bool {
    bytes <= FREE_BYTES || bytes / RATIO_LIMIT <= packed
}

impl TexelFormat {
    /// The format's name in KTX2, which is Vulkan's.
    fn ktx2(self) -> ::ktx2::Format {
        match self {
            Self::Srgb8 => ::ktx2::Format::R8G8B8A8_SRGB,
            Self::Half => ::ktx2::Format::R16G16B16A16_SFLOAT,
        }
    }
}

impl Amc {
    /// Reads an AMC file.
    ///
    /// # Errors
    /// As [`Amc::from_ktx2`], or the file cannot be read; the error names the file.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = file::read(path, TableSize::MOST_BYTES + FREE_BYTES)?;
        Self::from_ktx2(&bytes).map_err(|error| error.in_file(path))
    }

    /// Saves an AMC file; the old or the new file is whole at every instant.
    ///
    /// # Errors
    /// As [`Amc::to_ktx2`], or the file cannot be written; the error names the file.
    pub fn save(&self, path: &Path) -> Result<()> {
        let bytes = self.to_ktx2().map_err(|error| error.in_file(path))?;
        file::save_bytes(path, &bytes)
    }
}
