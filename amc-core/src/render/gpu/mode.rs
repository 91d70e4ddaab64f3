//! The shading modes: one WGSL file and one line here each.

use crate::render::{Cloth, Mode};

/// What a mode's shader reads at group 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LooksUp {
    /// Nothing.
    Nothing,
    /// The fabric's table (`table.wgsl`).
    Table,
    /// The picture of a ball (`ball.wgsl`).
    Ball,
}

/// A shading mode. Its shader has the entry points `vertex_main` and `fragment_main`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ShadingMode {
    /// The shader's name.
    pub shader: &'static str,
    /// What it reads at group 1.
    pub looks_up: LooksUp,
}

const AMC: ShadingMode = ShadingMode { shader: "mode_amc", looks_up: LooksUp::Table };
const BALL: ShadingMode = ShadingMode { shader: "mode_ball", looks_up: LooksUp::Ball };
const PLAIN: ShadingMode = ShadingMode { shader: "mode_plain", looks_up: LooksUp::Nothing };
const NORMALS: ShadingMode = ShadingMode { shader: "mode_normals", looks_up: LooksUp::Nothing };
const TANGENTS: ShadingMode = ShadingMode { shader: "mode_tangents", looks_up: LooksUp::Nothing };
const UV: ShadingMode = ShadingMode { shader: "mode_uv", looks_up: LooksUp::Nothing };

/// Not a shading of cloth: panels as marks ([`super::Renderer::mark_data`]).
pub(super) const MARK: ShadingMode = ShadingMode { shader: "mark", looks_up: LooksUp::Nothing };

/// All shadings of cloth.
pub static MODES: &[ShadingMode] = &[AMC, BALL, PLAIN, NORMALS, TANGENTS, UV];

impl ShadingMode {
    /// How `cloth` is drawn in `mode`: parts without a fabric stay grey where fabrics are shown.
    pub(super) fn of(mode: &Mode, cloth: &Cloth) -> Self {
        match (mode, cloth) {
            (Mode::Normals, _) => NORMALS,
            (Mode::Tangents, _) => TANGENTS,
            (Mode::Uv, _) => UV,
            (Mode::Amc | Mode::Isotropic | Mode::MatCap(_), Cloth::Plain) => PLAIN,
            (Mode::Amc, Cloth::Fabric(_)) => AMC,
            (Mode::Isotropic | Mode::MatCap(_), Cloth::Fabric(_)) => BALL,
        }
    }
}
