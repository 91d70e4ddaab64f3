//! A scene: a garment, its panels' fabrics and directions, ready to draw. From a project, or from the command line.

mod bundled;
mod fabric;
mod garment;
mod look;
mod open;
mod panel_option;
mod print;
mod project;
#[cfg(feature = "window")]
mod staged;

pub(crate) use fabric::Fabrics;
#[cfg(feature = "window")]
pub(crate) use fabric::load_fabric;
pub(crate) use garment::{load_arranged, load_garment};
pub(crate) use look::{PanelLook, StartingLook, combed_directions, directions, panel_looks};
pub(crate) use open::{Scene, open_scene};
pub(crate) use panel_option::PanelOption;
#[cfg(feature = "window")]
pub(crate) use print::load_print;
pub(crate) use print::{WornPrint, load_prints, worn_prints};
pub(crate) use project::{asset_path, hidden_panels, is_project, starting_looks};
#[cfg(feature = "window")]
pub(crate) use staged::{Outfit, document_looks, dressed};

use amc_core::mesh::Garment;
use amc_core::render::{Cloth, Drawing};
use amc_core::{Progress, Result, direction, occlusion};
use glam::Vec2;
use studio_plugin::document::Project;

use crate::storage::cache_folder;

/// Occlusion of every vertex, from the cache where it is there.
pub(crate) fn vertex_occlusion(garment: &Garment, progress: &Progress<'_>) -> Result<Vec<Vec2>> {
    let options = occlusion::Options::default();
    match cache_folder() {
        Some(folder) => occlusion::cached(garment, options, &folder.join("occlusion"), progress),
        None => occlusion::compute(garment, options, progress),
    }
}

/// What is drawn: `garment` in these looks, combed as `project` has it, with these prints (none: without any). Occlusion is left out where it is not
/// wanted.
pub(crate) fn drawing(
    (garment, project): (&Garment, Option<&Project>),
    (looks, prints): (&[PanelLook], &[Option<WornPrint>]),
    fabrics: Fabrics,
    with_occlusion: bool,
    progress: &Progress<'_>,
) -> Result<Drawing> {
    let tables = fabrics.into_tables();
    let directions = combed_directions(looks, garment, project, &tables);
    let tangents = direction::combed_tangents(garment, &directions, *progress)?;
    let occlusion = if with_occlusion { Some(vertex_occlusion(garment, progress)?) } else { None };
    Drawing::new(garment, tangents.vectors, occlusion.as_deref(), tables, |panel| {
        let (look, print) = (&looks[panel], prints.get(panel).and_then(Option::as_ref));
        let of = |fabric| print::printed(fabric, print, garment, &garment.panels[panel], &look.direction);
        look.fabric.map_or(Cloth::Plain, of)
    })
}
