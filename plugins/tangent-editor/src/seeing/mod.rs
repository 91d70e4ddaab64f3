//! What shows the direction of the cloth, and what becomes of it on the garment: pictures over the flat pieces, seen on the pattern and on
//! the garment alike.
//!
//! [`seen`] makes them for a whole garment, of the directions of its vertices as they are drawn; so combed and procedural fields are seen
//! as they are.

mod checker;
mod color_scale;
mod convolution;
mod edges;
mod field;
mod flat_panel;
mod grid;
mod patches;
mod pictures;
mod spread;
mod strain;
mod streamlines;
mod strokes;
mod weave;

pub use checker::Square;
pub use color_scale::ColorScale;
pub use pictures::{Asked, Cut, Seen, SeenPanel, seen};
pub use spread::SHARES;
pub use weave::{Binding, COUNTS, ENLARGEMENTS, Weave};

use field::Field;
use flat_panel::FlatPanel;
use grid::Grid;
use spread::Spread;
use strain::Strain;

use serde::{Deserialize, Serialize};

/// What is shown over the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Show {
    /// The direction, as arrows.
    Arrows,
    /// The direction, as evenly spaced lines.
    Streamlines,
    /// The direction, as noise smeared along it (line integral convolution).
    Lines,
    /// The threads.
    Weave,
    /// Squares of true size on the flat pattern.
    Checker,
    /// How much longer the cloth is on the garment along the warp.
    WarpStretch,
    /// The same along the weft.
    WeftStretch,
    /// The angle from the warp to the weft.
    Shear,
    /// The angle between the sources `gradient` and `yarn`.
    GradientAgainstYarn,
}

impl Show {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Arrows,
        Self::Streamlines,
        Self::Lines,
        Self::Weave,
        Self::Checker,
        Self::WarpStretch,
        Self::WeftStretch,
        Self::Shear,
        Self::GradientAgainstYarn,
    ];

    /// Stable, for command lines and commands.
    pub fn id(self) -> &'static str {
        match self {
            Self::Arrows => "arrows",
            Self::Streamlines => "streamlines",
            Self::Lines => "lic",
            Self::Weave => "weave",
            Self::Checker => "checker",
            Self::WarpStretch => "stretch-warp",
            Self::WeftStretch => "stretch-weft",
            Self::Shear => "shear",
            Self::GradientAgainstYarn => "gradient-yarn",
        }
    }

    /// Whether it shows values by colours.
    pub fn is_heat_map(self) -> bool {
        matches!(self, Self::WarpStretch | Self::WeftStretch | Self::Shear | Self::GradientAgainstYarn)
    }
}

/// How it is shown.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// The threads.
    pub weave: Weave,
    /// The checker's squares.
    pub square: Square,
}

#[cfg(test)]
mod tests;
