//! A document's garment in its fabrics, as they are loaded: what the window shows, and what it exports.

use std::collections::BTreeMap;
use std::sync::Arc;

use amc_core::Result;
use amc_core::amc::Amc;
use amc_core::direction::{self, Direction};
use amc_core::mesh::{Garment, Panel};
use amc_core::render::{Cloth, Drawing};
use studio_plugin::document::{FabricId, Project};

use super::WornPrint;
use super::print::printed;

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

/// What all panels wear.
#[derive(Debug, Clone)]
pub(crate) struct Outfit {
    /// One for each panel.
    pub(crate) looks: Vec<DocumentLook>,
    /// One for each panel.
    pub(crate) prints: Vec<Option<WornPrint>>,
    /// Those that are loaded.
    pub(crate) fabrics: BTreeMap<FabricId, Arc<Amc>>,
}

impl PartialEq for Outfit {
    fn eq(&self, other: &Self) -> bool {
        let same_fabrics = self.fabrics.len() == other.fabrics.len()
            && self.fabrics.iter().zip(&other.fabrics).all(|((a, x), (b, y))| a == b && Arc::ptr_eq(x, y));
        self.looks == other.looks && self.prints == other.prints && same_fabrics
    }
}

/// What is drawn: `plain`, which is `garment` without any fabric, in this outfit.
pub(crate) fn dressed(plain: &Drawing, garment: &Garment, outfit: &Outfit) -> Result<Drawing> {
    let Outfit { looks, prints, fabrics } = outfit;
    let directions: Vec<Direction> = looks.iter().map(|look| look.1).collect();
    let tangents = direction::tangents(garment, &directions)?;
    let numbers: BTreeMap<FabricId, usize> = fabrics.keys().copied().zip(0..).collect();
    let cloth = |panel: usize| {
        let (fabric, direction) = &looks[panel];
        let (print, panel) = (prints[panel].as_ref(), &garment.panels[panel]);
        let number = fabric.and_then(|id| numbers.get(&id));
        number.map_or(Cloth::Plain, |&number| printed(number, print, garment, panel, direction))
    };
    plain.dressed(tangents.vectors, fabrics.values().cloned().collect(), cloth)
}
