//! What a project says of its garment.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use amc_core::mesh::Garment;
use amc_core::{Progress, Result};
use studio_plugin::document::{Asset, Project};

use super::{Fabrics, StartingLook};

/// The panels that are not drawn.
pub(crate) fn hidden_panels(project: &Project, garment: &Garment) -> BTreeSet<usize> {
    (0..garment.panels.len()).filter(|&panel| !project.look_of(&garment.panels[panel]).visible).collect()
}

/// The looks that `project` gives to `garment`. Fabrics that are worn where it is seen are loaded into `fabrics`; none:
/// only directions are wanted.
///
/// # Errors
/// A fabric cannot be read; the error names its file.
pub(crate) fn starting_looks(
    project: &Project,
    garment: &Garment,
    mut fabrics: Option<&mut Fabrics>,
    progress: &Progress<'_>,
) -> Result<Vec<StartingLook>> {
    let mut looks = Vec::with_capacity(garment.panels.len());
    for panel in &garment.panels {
        let look = project.look_of(panel);
        let fabric = look.fabric.filter(|_| look.visible).and_then(|id| project.fabric(id));
        let fabric = match (fabric, fabrics.as_deref_mut()) {
            (Some(fabric), Some(fabrics)) => Some(fabrics.find(&asset_path(&fabric.asset), progress)?),
            _ => None,
        };
        looks.push(StartingLook { fabric, direction: look.direction });
    }
    Ok(looks)
}

/// What the loaders know an asset by.
pub(crate) fn asset_path(asset: &Asset) -> PathBuf {
    match asset {
        Asset::Bundled(name) => PathBuf::from(name),
        Asset::File { path, .. } => path.clone(),
    }
}

/// Whether a file is a project, by its suffix.
pub(crate) fn is_project(file: &Path) -> bool {
    file.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case(crate::project::SUFFIX))
}
