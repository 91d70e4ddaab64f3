//! From a table to reckon with to one to store.

use serde::{Deserialize, Serialize};

use super::{Amc, Frame, LinearTable, Metadata, Texels};
use crate::{Error, Result};

/// How texels are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TexelFormat {
    /// 8 bits a channel, sRGB-encoded: what the paper has, and all that 8-bit pictures can fill. Light above 1 is cut.
    #[default]
    Srgb8,
    /// 16-bit floats, linear.
    Half,
}

impl TexelFormat {
    /// Bytes of one texel.
    pub fn bytes(self) -> usize {
        match self {
            Self::Srgb8 => 4,
            Self::Half => 8,
        }
    }

    /// The format's name in Vulkan and KTX2.
    pub fn name(self) -> &'static str {
        match self {
            Self::Srgb8 => "R8G8B8A8_SRGB",
            Self::Half => "R16G16B16A16_SFLOAT",
        }
    }
}

impl Amc {
    /// The AMC of a table, its texels stored as `format`.
    ///
    /// # Errors
    /// The table's texels are not as many as its size says, or one is no finite number (or beyond what 16 bits hold).
    pub fn from_linear(
        table: &LinearTable,
        format: TexelFormat,
        frame: Frame,
        metadata: Metadata,
    ) -> Result<Self> {
        let limit = match format {
            TexelFormat::Srgb8 => f32::MAX,
            TexelFormat::Half => half::f16::MAX.to_f32(),
        };
        if let Some(k) = table.texels.iter().position(|texel| !texel.iter().all(|value| value.abs() <= limit))
        {
            return Err(Error::invalid(format!("the colour {:?} cannot be stored", table.texels[k]))
                .at_element(texel_name(table.size, k)));
        }
        let texels = match format {
            TexelFormat::Srgb8 => table.to_srgb8(),
            TexelFormat::Half => table.to_half(),
        };
        let mut amc = Self::new(table.size, texels, table.symmetry, table.azimuth, frame)?;
        amc.metadata = metadata;
        Ok(amc)
    }

    /// How its texels are stored.
    pub fn format(&self) -> TexelFormat {
        match self.texels() {
            Texels::Srgb8(_) => TexelFormat::Srgb8,
            Texels::Half(_) => TexelFormat::Half,
        }
    }
}

/// A texel by its place, as errors name it.
pub(crate) fn texel_name(size: super::TableSize, index: usize) -> String {
    let side = size.side() as usize;
    let (s, j, i) = (index / size.slice_texels(), index / side % side, index % side);
    format!("texel at column {i}, row {j}, slice {s}")
}
