//! The prints of a project: each picture read once.

use std::collections::HashMap;
use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::image::decode;
use amc_core::mesh::{Garment, Panel};
use amc_core::render::{Cloth, LaidPrint, Laying, Print};
use amc_core::{Error, Result};
use studio_plugin::document::{Asset, ColourwayId, Project};

use super::asset_path;

/// A print as a panel wears it.
#[derive(Debug, Clone)]
pub(crate) struct WornPrint {
    pub(crate) print: Arc<Print>,
    pub(crate) laying: Laying,
}

impl PartialEq for WornPrint {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.print, &other.print) && self.laying == other.laying
    }
}

/// Reads a print's picture.
///
/// # Errors
/// It cannot be read; the error names the file.
pub(crate) fn load_print(picture: &Asset) -> Result<Print> {
    let path = asset_path(picture);
    let raster = decode::read_raster(&path)?;
    Print::new(&raster.to_picture()).map_err(|error: Error| error.in_file(&path))
}

/// The pictures of all prints that are worn in `project` on panels of `garment` that are drawn.
///
/// # Errors
/// As [`load_print`].
pub(crate) fn load_prints(project: &Project, garment: &Garment) -> Result<HashMap<Asset, Arc<Print>>> {
    let mut prints = HashMap::new();
    for panel in garment.panels.iter().filter(|panel| project.look_of(panel).visible) {
        if let Some(print) = project.print(&panel.id)
            && !prints.contains_key(&print.picture)
        {
            prints.insert(print.picture.clone(), Arc::new(load_print(&print.picture)?));
        }
    }
    Ok(prints)
}

/// What each panel of `garment` wears of `prints` in a colourway.
pub(crate) fn worn_prints(
    (project, colourway): (&Project, ColourwayId),
    garment: &Garment,
    prints: &HashMap<Asset, Arc<Print>>,
) -> Vec<Option<WornPrint>> {
    let worn = |panel: &Panel| {
        let print = project.print_in(colourway, &panel.id)?;
        Some(WornPrint { print: Arc::clone(prints.get(&print.picture)?), laying: print.laying })
    };
    garment.panels.iter().map(worn).collect()
}

/// `fabric` with a print over it, where the panel has a flat pattern that it can lie on.
pub(crate) fn printed(
    fabric: usize,
    print: Option<&WornPrint>,
    garment: &Garment,
    panel: &Panel,
    direction: &Direction,
) -> Cloth {
    match print.and_then(|print| Some((print, garment.uv_to_metres(panel)?))) {
        Some((WornPrint { print, laying }, metres)) => {
            Cloth::Printed(fabric, LaidPrint::new(print, laying, panel, direction, metres))
        }
        None => Cloth::Fabric(fabric),
    }
}
