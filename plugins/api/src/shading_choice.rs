//! The shading modes a person can choose among.

use amc_core::render::Mode;

/// A shading mode: what the colour of a fragment is.
#[derive(Debug, Clone, PartialEq)]
pub struct ShadingChoice {
    /// Stable, and unique among all modes: projects keep it.
    pub id: &'static str,
    /// For people.
    pub name: &'static str,
    /// What is drawn. A plugin brings [`Mode::Own`].
    pub mode: Mode,
}

impl ShadingChoice {
    /// Those that come with the studio.
    pub const BUILT_IN: [Self; 5] = [
        Self { id: "amc", name: "Cloth", mode: Mode::Amc },
        Self { id: "isotropic", name: "Without direction", mode: Mode::Isotropic },
        Self { id: "normals", name: "Normals", mode: Mode::Normals },
        Self { id: "tangents", name: "Directions", mode: Mode::Tangents },
        Self { id: "uv", name: "Flat pattern", mode: Mode::Uv },
    ];
}
