//! How pictures are saved, by the suffix of the file.

use std::path::Path;

use amc_core::{Error, Result};

/// What the file of a still picture may end with.
#[cfg(feature = "window")]
pub(crate) const STILL_SUFFIXES: &[&str] = &["png", "exr"];

/// What the file of a turn may end with.
#[cfg(feature = "window")]
pub(crate) const MOVING_SUFFIXES: &[&str] = &["gif", "png", "apng"];

/// How a still picture is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StillFormat {
    /// 8-bit sRGB, straight alpha.
    Png,
    /// 32-bit floats, linear, premultiplied.
    Exr,
}

/// How a turn is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MovingFormat {
    /// Animated PNG.
    Png,
    /// 256 colours, covered or not.
    Gif,
}

impl StillFormat {
    pub(super) fn of(file: &Path) -> Result<Self> {
        match suffix(file).as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => {
                let what = format!("a picture is saved as .png or .exr, not as {}", file.display());
                Err(Error::unsupported(what))
            }
        }
    }
}

impl MovingFormat {
    pub(super) fn of(file: &Path) -> Result<Self> {
        match suffix(file).as_str() {
            "png" | "apng" => Ok(Self::Png),
            "gif" => Ok(Self::Gif),
            _ => {
                let what = format!("a turn is saved as .gif or .png, not as {}", file.display());
                Err(Error::unsupported(what))
            }
        }
    }
}

fn suffix(file: &Path) -> String {
    file.extension().map(|suffix| suffix.to_string_lossy().to_lowercase()).unwrap_or_default()
}
