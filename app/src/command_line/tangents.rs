//! `amc-studio tangents`: the panels' directions, for other programs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Unit};
use amc_core::{Progress, Result, direction, export};
use studio_plugin::document::{Asset, Project};
use tangent_editor::Assignments;
use tangent_editor::tech_sheet::{self, Said};

use super::Outcome;
use super::output::Output;
use super::values::unit;
use crate::scene::{Fabrics, PanelOption, Scene, combed_directions, directions, open_scene, panel_looks};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A project (.amcproj), a mesh (.obj, .glb, .gltf), garment:NAME or shape:NAME.
    mesh: PathBuf,
    /// Where to: .glb, .obj or .json; the flat pattern as .svg, .pdf or .dxf.
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
    let is_combed =
        garment.panels.iter().any(|panel| project.as_ref().is_some_and(|it| it.comb(&panel.id).is_some()));
    // Strokes are followed as the fabric's symmetry has it; without strokes fabrics say nothing.
    let mut fabrics = Fabrics::default();
    let (starting, wanted) = ((project.as_ref(), None), is_combed.then_some(&mut fabrics));
    let looks = panel_looks(&garment, starting, &arguments.panel, wanted, &Progress::none())?;
    let directions = directions(&looks);
    let (panels, vertices) = (garment.panels.len(), garment.positions.len());
    if tech_sheet::is_tech_sheet(&arguments.output) {
        let said = said(&garment, project.as_ref(), &directions)?;
        let title = Asset::named(&arguments.mesh.to_string_lossy()).name();
        tech_sheet::save(&title, Arc::new(garment), &said, &arguments.output, &Progress::none())?;
    } else {
        let combed = combed_directions(&looks, &garment, project.as_ref(), &fabrics.into_tables());
        let tangents = direction::combed_tangents(&garment, &combed, Progress::none())?;
        export::tangents(&garment, &tangents, &directions, &[], &arguments.output)?;
    }
    let exported = Exported { file: &arguments.output, panels, vertices, notices: &notices };
    output.result(&exported, || {
        format!("{}: {} panels, {} vertices", exported.file.display(), exported.panels, exported.vertices)
    })?;
    Ok(())
}

/// What stands on a tech sheet beside the panels' directions: fabrics and laying, where a project says them.
fn said(garment: &Garment, project: Option<&Project>, directions: &[Direction]) -> Result<Vec<Said>> {
    let assignments = project.map(Assignments::of).transpose()?.unwrap_or_default();
    let fabric = |panel| {
        let project = project?;
        Some(project.fabric(project.look_of(panel).fabric?)?.name.clone())
    };
    let said = garment.panels.iter().zip(directions).map(|(panel, &direction)| Said {
        direction,
        fabric: fabric(panel),
        assignment: assignments.panel(&panel.id),
    });
    Ok(said.collect())
}
