//! The look of every panel: its fabric and its direction.

use std::path::Path;
use std::sync::Arc;

use amc_core::amc::{Amc, Symmetry};
use amc_core::direction::{Direction, Field, PanelDirection, Source};
use amc_core::mesh::{Garment, Panel};
use amc_core::{Error, Progress, Result};
use glam::Vec3;
use studio_plugin::document::Project;

use super::panel_option::{PanelOption, SourceName};
use super::{Fabrics, starting_looks};

/// What a panel looks like before anything is said of it on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct StartingLook {
    pub(crate) fabric: Option<usize>,
    /// None: along its grain.
    pub(crate) direction: Option<Direction>,
}

/// One panel's fabric (none: plain grey) and direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PanelLook {
    pub(crate) fabric: Option<usize>,
    pub(crate) direction: Direction,
}

/// The directions alone.
pub(crate) fn directions(looks: &[PanelLook]) -> Vec<Direction> {
    looks.iter().map(|look| look.direction).collect()
}

/// What the comb takes for the same directions: those that look the same in the fabric; without one a cloth like most.
pub(crate) fn symmetry(fabric: Option<&Amc>) -> u32 {
    fabric.map_or(Symmetry::Two, |table| table.symmetry).order()
}

/// The looks' directions with the strokes that `project` has for them.
pub(crate) fn combed_directions(
    looks: &[PanelLook],
    garment: &Garment,
    project: Option<&Project>,
    tables: &[Arc<Amc>],
) -> Vec<PanelDirection> {
    let combed = |(look, panel): (&PanelLook, &Panel)| PanelDirection {
        own: look.direction,
        comb: project.and_then(|project| project.comb(&panel.id)).cloned(),
        symmetry: symmetry(look.fabric.and_then(|fabric| tables.get(fabric)).map(|table| &**table)),
    };
    looks.iter().zip(&garment.panels).map(combed).collect()
}

/// Every panel's look: as `project` has it; without one in `amc` (a file or `fabric:NAME`; default: the bundled satin) on all
/// that take a fabric, along its grain where its file says it. `amc` takes the place of a project's fabrics. Then `options`
/// in their order, later ones winning. `fabrics` none: only directions are wanted.
pub(crate) fn panel_looks(
    garment: &Garment,
    (project, amc): (Option<&Project>, Option<&Path>),
    options: &[PanelOption],
    mut fabrics: Option<&mut Fabrics>,
    progress: &Progress<'_>,
) -> Result<Vec<PanelLook>> {
    check_ids(garment, options)?;
    let starting = match project {
        Some(project) => {
            let fabrics = fabrics.as_deref_mut().filter(|_| amc.is_none());
            starting_looks(project, garment, fabrics, progress)?
        }
        None => vec![StartingLook::default(); garment.panels.len()],
    };
    let mut looks: Vec<PanelLook> = starting
        .iter()
        .map(|look| PanelLook { fabric: look.fabric, direction: look.direction.unwrap_or_default() })
        .collect();
    if let Some(fabrics) = fabrics.as_deref_mut().filter(|_| project.is_none() || amc.is_some()) {
        give_all_cloth(&mut looks, garment, amc, options, fabrics, progress)?;
    }
    let mut angles: Vec<Option<f32>> =
        starting.iter().map(|look| look.direction.map(|direction| direction.angle)).collect();
    let centre = centre(garment);
    for option in options {
        let fabric = match (&option.amc, fabrics.as_deref_mut()) {
            (Some(named), Some(fabrics)) => Some(fabrics.find(named, progress)?),
            _ => None,
        };
        for ((look, angle), panel) in looks.iter_mut().zip(&mut angles).zip(&garment.panels) {
            if !option.is_for(panel) {
                continue;
            }
            look.fabric = fabric.or(look.fabric);
            *angle = option.angle_degrees.map(f32::to_radians).or(*angle);
            if let Some(source) = option.source {
                look.direction.source = source_of(source, centre);
            }
        }
    }
    for ((look, angle), panel) in looks.iter_mut().zip(angles).zip(&garment.panels) {
        look.direction.angle = match (angle, look.direction.source) {
            (Some(angle), _) => angle,
            (None, Source::Gradient | Source::Yarn) => Direction::along_grain(panel).angle,
            // A grain is an angle in the flat pattern, of which a field knows nothing.
            (None, Source::Field(_)) => 0.0,
        };
    }
    Ok(looks)
}

/// Refuses options for panels that are not there.
fn check_ids(garment: &Garment, options: &[PanelOption]) -> Result<()> {
    let there = |id: &String| garment.panels.iter().any(|panel| panel.id == *id);
    match options.iter().filter_map(|option| option.id.as_ref()).find(|id| !there(id)) {
        Some(id) => {
            let known: Vec<_> = garment.panels.iter().map(|panel| panel.id.as_str()).collect();
            Err(Error::invalid(format!("there is no panel '{id}'; the panels are {}", known.join(", "))))
        }
        None => Ok(()),
    }
}

/// Gives the fabric `amc` to every panel that takes one. Where every panel has an option of its own it is not even read.
fn give_all_cloth(
    looks: &mut [PanelLook],
    garment: &Garment,
    amc: Option<&Path>,
    options: &[PanelOption],
    fabrics: &mut Fabrics,
    progress: &Progress<'_>,
) -> Result<()> {
    let has_its_own =
        |panel: &Panel| options.iter().any(|option| option.amc.is_some() && names(option, &panel.id));
    if !garment.panels.iter().any(|panel| panel.takes_fabric && !has_its_own(panel)) {
        return Ok(());
    }
    let number = match amc {
        Some(named) => fabrics.find(named, progress)?,
        None => fabrics.default_fabric(progress)?,
    };
    for (look, panel) in looks.iter_mut().zip(&garment.panels) {
        look.fabric = panel.takes_fabric.then_some(number);
    }
    Ok(())
}

fn names(option: &PanelOption, id: &str) -> bool {
    option.id.as_deref().is_none_or(|named| named == id)
}

fn source_of(name: SourceName, centre: Vec3) -> Source {
    match name {
        SourceName::Gradient => Source::Gradient,
        SourceName::Yarn => Source::Yarn,
        SourceName::Around(axis) => {
            Source::Field(Field::Around { origin: centre, direction: Vec3::AXES[axis] })
        }
        SourceName::Along(axis) => Source::Field(Field::Along { direction: Vec3::AXES[axis] }),
        SourceName::Radial => Source::Field(Field::Radial { origin: centre }),
    }
}

/// The centre of the garment's bounding box, metres.
fn centre(garment: &Garment) -> Vec3 {
    let (low, high) = garment
        .positions
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    (low + high) / 2.0
}
