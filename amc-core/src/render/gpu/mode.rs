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
    /// Its text, where it comes from outside; none: the sources have it.
    pub text: Option<&'static str>,
    /// What it reads at group 1.
    pub looks_up: LooksUp,
    /// Whether it reads a print at group 2 (`print.wgsl`).
    pub is_printed: bool,
}

const AMC: ShadingMode = built_in("mode_amc", LooksUp::Table);
const BALL: ShadingMode = built_in("mode_ball", LooksUp::Ball);
const PRINTED_AMC: ShadingMode = printed("mode_amc_printed", LooksUp::Table);
const PRINTED_BALL: ShadingMode = printed("mode_ball_printed", LooksUp::Ball);
const COVERED: ShadingMode = printed("mode_covered", LooksUp::Nothing);
const PLAIN: ShadingMode = built_in("mode_plain", LooksUp::Nothing);
const NORMALS: ShadingMode = built_in("mode_normals", LooksUp::Nothing);
const TANGENTS: ShadingMode = built_in("mode_tangents", LooksUp::Nothing);
const UV: ShadingMode = built_in("mode_uv", LooksUp::Nothing);

const fn built_in(shader: &'static str, looks_up: LooksUp) -> ShadingMode {
    ShadingMode { shader, text: None, looks_up, is_printed: false }
}

const fn printed(shader: &'static str, looks_up: LooksUp) -> ShadingMode {
    ShadingMode { is_printed: true, ..built_in(shader, looks_up) }
}

/// Not a shading of cloth: panels as marks ([`super::Renderer::mark_data`]).
pub(super) const MARK: ShadingMode = built_in("mark", LooksUp::Nothing);

/// All shadings of cloth.
pub static MODES: &[ShadingMode] =
    &[AMC, BALL, PRINTED_AMC, PRINTED_BALL, COVERED, PLAIN, NORMALS, TANGENTS, UV];

impl ShadingMode {
    /// How `cloth` is drawn in `mode`: parts without a fabric stay grey where fabrics are shown.
    pub(super) fn of(mode: &Mode, cloth: &Cloth) -> Self {
        match (mode, cloth) {
            (Mode::Normals, _) => NORMALS,
            (Mode::Tangents, _) => TANGENTS,
            (Mode::Uv, _) => UV,
            (Mode::Own(own), Cloth::Covered(_)) if own.reads_fabric => COVERED,
            (Mode::Own(own), Cloth::Plain) if own.reads_fabric => PLAIN,
            (Mode::Own(own), _) => Self {
                shader: own.name,
                text: Some(own.text),
                looks_up: if own.reads_fabric { LooksUp::Table } else { LooksUp::Nothing },
                is_printed: false,
            },
            (Mode::Amc | Mode::Isotropic | Mode::MatCap(_), Cloth::Plain) => PLAIN,
            (Mode::Amc | Mode::Isotropic | Mode::MatCap(_), Cloth::Covered(_)) => COVERED,
            (Mode::Amc, Cloth::Fabric(_)) => AMC,
            (Mode::Amc, Cloth::Printed(..)) => PRINTED_AMC,
            (Mode::Isotropic | Mode::MatCap(_), Cloth::Printed(..)) => PRINTED_BALL,
            (Mode::Isotropic | Mode::MatCap(_), Cloth::Fabric(_)) => BALL,
        }
    }
}
