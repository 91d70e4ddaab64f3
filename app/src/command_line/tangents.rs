//! `amc-studio tangents`: the panels' directions, for other programs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Unit};
use amc_core::{Progress, Result, direction, export};
use studio_plugin::document::{Asset, Document, Project};
use tangent_editor::Assignments;
use tangent_editor::import::{self, Found, Import};
use tangent_editor::tech_sheet::{self, Said};

use super::Outcome;
use super::output::Output;
use super::values::unit;
use crate::scene::{Fabrics, PanelOption, Scene, combed_directions, directions, open_scene, panel_looks};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A project (.amcproj), a mesh (.obj, .glb, .gltf), garment:NAME or shape:NAME.
    mesh: PathBuf,
    /// Where to: .glb (tangents, turned UVs, anisotropy), .obj (turned UVs) or .json; the flat pattern as .svg, .pdf or .dxf.
    #[arg(short, long)]
    output: PathBuf,
    /// Directions to begin with: .json (as is exported, or {"panels": [{"id": ..., "angle_deg": ...}]}), .dxf (grain lines on
    /// layer 7) or .glb, .gltf (KHR_materials_anisotropy). What cannot be matched to a panel is said.
    #[arg(long, value_name = "FILE")]
    import: Option<PathBuf>,
    /// ID|all[,angle=DEGREES][,source=NAME][,class=two-way|one-way|nap][,amc=FABRIC]; repeatable, later ones win. Default: along
    /// the panel's grain, else 0. A fabric is only named.
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
    let Scene { garment, project, mut notices } =
        open_scene(&arguments.mesh, arguments.unit, &Progress::none())?;
    // A mesh alone is worn in no fabric.
    let mut project = project.unwrap_or_else(|| Project { fabrics: Vec::new(), ..Project::default() });
    let mut fabrics = Vec::new();
    if let Some(file) = &arguments.import {
        let (taken, import) = take_in(file, &garment, project)?;
        let told = import.notices.iter().map(|notice| format!("{}: {notice}", file.display()));
        notices.extend(told);
        fabrics = import.found.into_iter().filter_map(|found| Some((found.panel, found.fabric?))).collect();
        project = taken;
    }
    for notice in &notices {
        output.notice(notice);
    }
    let is_combed = garment.panels.iter().any(|panel| project.comb(&panel.id).is_some());
    // Strokes are followed as the fabric's symmetry has it; without strokes fabrics say nothing.
    let mut tables = Fabrics::default();
    let (starting, wanted) = ((Some(&project), None), is_combed.then_some(&mut tables));
    let looks = panel_looks(&garment, starting, &arguments.panel, wanted, &Progress::none())?;
    let directions = directions(&looks);
    let (panels, vertices) = (garment.panels.len(), garment.positions.len());
    let mut said = said(&garment, &project, &directions)?;
    for (panel, fabric) in fabrics {
        said[panel].fabric = Some(fabric);
    }
    choose(&mut said, &garment, &arguments.panel);
    if tech_sheet::is_tech_sheet(&arguments.output) {
        let title = Asset::named(&arguments.mesh.to_string_lossy()).name();
        tech_sheet::save(&title, Arc::new(garment), &said, &arguments.output, &Progress::none())?;
    } else {
        let combed = combed_directions(&looks, &garment, Some(&project), &tables.into_tables());
        let tangents = direction::combed_tangents(&garment, &combed, Progress::none())?;
        let said: Vec<export::Said> = said.iter().map(Said::exported).collect();
        export::tangents(&garment, &tangents, &directions, &said, &arguments.output)?;
    }
    let exported = Exported { file: &arguments.output, panels, vertices, notices: &notices };
    output.result(&exported, || {
        format!("{}: {} panels, {} vertices", exported.file.display(), exported.panels, exported.vertices)
    })?;
    Ok(())
}

/// The project with what a file says of the garment's panels.
fn take_in(file: &Path, garment: &Garment, project: Project) -> Result<(Project, Import)> {
    let now: Vec<Direction> = garment
        .panels
        .iter()
        .map(|panel| project.look_of(panel).direction.unwrap_or_else(|| Direction::along_grain(panel)))
        .collect();
    let mut import = import::read(garment, &now, file, &Progress::none())?;
    // A fabric's name is kept as it is: no project is made of it.
    let unworn = Import {
        found: import.found.iter().map(|found| Found { fabric: None, ..found.clone() }).collect(),
        notices: Vec::new(),
    };
    let planned = import::edits(&unworn, garment, &project)?;
    import.notices.extend(planned.notices);
    let mut document = Document::new(project);
    for edit in planned.edits {
        document.submit(edit, None)?;
    }
    Ok((document.project().clone(), import))
}

/// What a project says of the panels beside their directions: fabrics and laying.
fn said(garment: &Garment, project: &Project, directions: &[Direction]) -> Result<Vec<Said>> {
    let assignments = Assignments::of(project)?;
    let fabric = |panel| Some(project.fabric(project.look_of(panel).fabric?)?.name.clone());
    let said = garment.panels.iter().zip(directions).map(|(panel, &direction)| Said {
        direction,
        fabric: fabric(panel),
        assignment: assignments.panel(&panel.id),
    });
    Ok(said.collect())
}

/// What the options say of fabrics and laying; later ones win.
fn choose(said: &mut [Said], garment: &Garment, options: &[PanelOption]) {
    for option in options {
        let meant = said.iter_mut().zip(&garment.panels).filter(|(_, panel)| option.is_for(panel));
        for (said, _) in meant {
            if let Some(amc) = &option.amc {
                said.fabric = Some(Asset::named(&amc.to_string_lossy()).name());
            }
            said.assignment.orientation = option.class.unwrap_or(said.assignment.orientation);
        }
    }
}
