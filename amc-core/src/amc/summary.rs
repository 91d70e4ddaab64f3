//! What a table is, in a few figures.

use serde::Serialize;

use super::{Amc, Frame, Memory, Metadata, Symmetry, Texels};
use crate::view_space::Azimuth;

/// An AMC in a few figures: what `inspect` prints. Its JSON is a contract (DESIGN section 5).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Always `amc`.
    pub kind: &'static str,
    /// Columns, and rows, of a slice.
    pub size: u32,
    /// Slices.
    pub slices: u32,
    /// R.
    pub symmetry: Symmetry,
    /// What the third axis means.
    pub azimuth: Azimuth,
    /// What normals are relative to.
    pub frame: Frame,
    /// The texels' format by its Vulkan name.
    pub format: &'static str,
    /// Bytes of its texture.
    pub bytes: u64,
    /// Bytes in other forms.
    pub memory: Memory,
    /// The share of the texels on the disc that were measured, not filled in.
    pub measured: f64,
    /// What is said about it.
    pub metadata: Metadata,
}

impl Amc {
    /// The table in a few figures.
    pub fn summary(&self) -> Summary {
        let memory = self.memory();
        Summary {
            kind: "amc",
            size: self.size().side(),
            slices: self.size().slices(),
            symmetry: self.symmetry,
            azimuth: self.azimuth,
            frame: self.frame,
            format: self.format().name(),
            bytes: memory.texture,
            memory,
            measured: self.measured_share(),
            metadata: self.metadata.clone(),
        }
    }

    fn measured_share(&self) -> f64 {
        let disc = self.size().disc();
        let on_disc = disc.iter().filter(|on| **on).count() * self.size().slices() as usize;
        let on = disc.iter().cycle();
        let measured = match self.texels() {
            Texels::Srgb8(texels) => {
                texels.iter().zip(on).filter(|(texel, on)| **on && texel[3] == 255).count()
            }
            Texels::Half(texels) => {
                texels.iter().zip(on).filter(|(texel, on)| **on && texel[3] >= half::f16::ONE).count()
            }
        };
        measured as f64 / on_disc.max(1) as f64
    }
}
