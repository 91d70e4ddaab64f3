//! A document's garment in its fabrics, as they are loaded: what the window shows, and what it exports.

use std::collections::BTreeMap;
use std::sync::Arc;

use amc_core::Result;
use amc_core::amc::Amc;
use amc_core::direction::{self, Direction};
use amc_core::mesh::{Garment, Panel};
use amc_core::render::{Cloth, Drawing};
use studio_plugin::document::{FabricId, Project};

/// A panel's fabric (none: plain grey) and direction.
pub(crate) type DocumentLook = (Option<FabricId>, Direction);

/// Every panel's fabric, where it is among those that are loaded, and direction.
pub(crate) fn document_looks(
    project: &Project,
    garment: &Garment,
    is_loaded: impl Fn(FabricId) -> bool,
) -> Vec<DocumentLook> {
    let look = |panel: &Panel| {
        let look = project.look_of(panel);
        let fabric = look.fabric.filter(|&id| is_loaded(id));
        (fabric, look.direction.unwrap_or_else(|| Direction::along_grain(panel)))
    };
    garment.panels.iter().map(look).collect()
}

/// What is drawn: `plain`, which is `garment` without any fabric, in these looks.
pub(crate) fn dressed(
    plain: &Drawing,
    garment: &Garment,
    looks: &[DocumentLook],
    fabrics: &BTreeMap<FabricId, Arc<Amc>>,
) -> Result<Drawing> {
    let directions: Vec<Direction> = looks.iter().map(|look| look.1).collect();
    let tangents = direction::tangents(garment, &directions)?;
    let numbers: BTreeMap<FabricId, usize> = fabrics.keys().copied().zip(0..).collect();
    let cloth = |panel: usize| {
        looks[panel].0.and_then(|id| numbers.get(&id)).map_or(Cloth::Plain, |&n| Cloth::Fabric(n))
    };
    plain.dressed(tangents.vectors, fabrics.values().cloned().collect(), cloth)
}
