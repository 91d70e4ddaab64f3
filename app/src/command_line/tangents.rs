//! `amc-studio tangents`: the panels' directions, for other programs.

use std::path::{Path, PathBuf};

use amc_core::mesh::Unit;
use amc_core::{Progress, direction, export};

use super::Outcome;
use super::output::Output;
use super::values::unit;
use crate::scene::{PanelOption, Scene, directions, open_scene, panel_looks};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A mesh (.obj, .glb, .gltf), garment:NAME or shape:NAME.
    mesh: PathBuf,
    /// Where to: .glb, .obj or .json.
    #[arg(short, long)]
    output: PathBuf,
    /// ID|all[,angle=DEGREES][,source=NAME]; repeatable, later ones win. Default: along the panel's grain, else 0.
    #[arg(long)]
    panel: Vec<PanelOption>,
    /// What the mesh's numbers mean: m, dm, cm or mm.
    #[arg(long, default_value = "m", value_parser = unit)]
    unit: Unit,
}

/// What is said about an export.
#[derive(Debug, serde::Serialize)]
struct Exported<'a> {
    file: &'a Path,
    panels: usize,
    vertices: usize,
    notices: &'a [String],
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    let Scene { garment, project, notices } = open_scene(&arguments.mesh, arguments.unit, &Progress::none())?;
    for notice in &notices {
        output.notice(notice);
    }
    let looks = panel_looks(&garment, (project.as_ref(), None), &arguments.panel, None, &Progress::none())?;
    let directions = directions(&looks);
    let tangents = direction::tangents(&garment, &directions)?;
    export::tangents(&garment, &tangents, &directions, &arguments.output)?;
    let exported = Exported {
        file: &arguments.output,
        panels: garment.panels.len(),
        vertices: garment.positions.len(),
        notices: &notices,
    };
    output.result(&exported, || {
        format!("{}: {} panels, {} vertices", exported.file.display(), exported.panels, exported.vertices)
    })?;
    Ok(())
}
