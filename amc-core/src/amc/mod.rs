//! The Anisotropic MatCap: a table of the colour that a cloth shows, under one fixed lighting, at every view-space
//! normal and every tangent azimuth (Magri, Cignoni, Tarini 2016, section 4).

mod azimuth;
mod cyclic;
mod fill;
mod fold;
mod header;
mod isotropic;
mod ktx2;
mod memory;
mod metadata;
mod resample;
mod summary;
mod table;
#[cfg(test)]
mod tests;
mod texel_format;

pub use cyclic::{Interpolation, Taps};
pub use fill::FILLED;
pub(crate) use header::{Header, parse_object};
pub use memory::Memory;
pub use metadata::Metadata;
pub use summary::Summary;
pub use table::{Amc, LinearTable, TableSize, Texels};
pub use texel_format::TexelFormat;
pub(crate) use texel_format::texel_name;

use serde::{Deserialize, Serialize};

/// How many times a turn of the cloth about its own normal brings the same look back: R in the paper (section 4.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
#[serde(try_from = "u32", into = "u32")]
pub enum Symmetry {
    /// Only a whole turn: the table holds a whole turn of the azimuth.
    #[default]
    One = 1,
    /// Half a turn, as nearly every woven cloth: the table holds half a turn.
    Two = 2,
    /// A third of a turn.
    Three = 3,
    /// A quarter turn, as a balanced weave: warp and weft look alike.
    Four = 4,
}

impl Symmetry {
    /// All of them, from 1 to 4.
    pub const ALL: [Self; 4] = [Self::One, Self::Two, Self::Three, Self::Four];

    /// R itself, 1 to 4.
    pub fn order(self) -> u32 {
        self as u32
    }
}

impl TryFrom<u32> for Symmetry {
    type Error = crate::Error;

    fn try_from(order: u32) -> crate::Result<Self> {
        Self::ALL.into_iter().find(|symmetry| symmetry.order() == order).ok_or_else(|| {
            crate::Error::invalid(format!("the symmetry is {order}, but must be 1, 2, 3 or 4"))
        })
    }
}

impl From<Symmetry> for u32 {
    fn from(symmetry: Symmetry) -> Self {
        symmetry.order()
    }
}

/// Which direction of sight a table's normals are relative to, where it was taken with a camera at a finite distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Frame {
    /// Half-way between the line of sight and the optical axis: where highlights of distant lights stay put.
    /// Orthographic pictures count as this.
    #[default]
    Half,
    /// The line of sight itself.
    Full,
}
