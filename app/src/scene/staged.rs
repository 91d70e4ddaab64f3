//! A document's garment in its fabrics, as they are loaded: what the window shows, and what it exports.

use std::collections::BTreeMap;
use std::sync::Arc;

use amc_core::Result;
use amc_core::amc::Amc;
use amc_core::direction::{Direction, PanelDirection};
use amc_core::mesh::{Garment, Panel};
use amc_core::render::{Cloth, Drawing};
use glam::Vec3;
use studio_plugin::document::{ColourwayId, FabricId, Project};

use super::WornPrint;
use super::look::symmetry;
use super::print::printed;

/// A panel's fabric (none: plain grey) and direction.
pub(crate) type DocumentLook = (Option<FabricId>, PanelDirection);

/// Every panel's fabric in a colourway, where it is among those that are loaded, and direction.
pub(crate) fn document_looks(
    (project, colourway): (&Project, ColourwayId),
    garment: &Garment,
    fabrics: &BTreeMap<FabricId, Arc<Amc>>,
) -> Vec<DocumentLook> {
    let look = |panel: &Panel| {
        let look = project.look_in(colourway, panel);
        let fabric = look.fabric.filter(|id| fabrics.contains_key(id));
        let own = look.direction.unwrap_or_else(|| Direction::along_grain(panel));
        let table = fabric.and_then(|id| fabrics.get(&id)).map(|table| &**table);
        (fabric, PanelDirection { own, comb: project.comb(&panel.id).cloned(), symmetry: symmetry(table) })
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

impl Outfit {
    /// The direction of each panel.
    pub(crate) fn directions(&self) -> Vec<PanelDirection> {
        self.looks.iter().map(|look| look.1.clone()).collect()
    }
}

/// What is drawn: `plain`, which is `garment` without any fabric, in this outfit; `vectors` are the tangents of its directions.
pub(crate) fn dressed(
    plain: &Drawing,
    garment: &Garment,
    outfit: &Outfit,
    vectors: &Arc<Vec<Vec3>>,
) -> Result<Drawing> {
    let Outfit { looks, prints, fabrics } = outfit;
    let numbers: BTreeMap<FabricId, usize> = fabrics.keys().copied().zip(0..).collect();
    let cloth = |panel: usize| {
        let (fabric, direction) = &looks[panel];
        let (print, panel) = (prints[panel].as_ref(), &garment.panels[panel]);
        let number = fabric.and_then(|id| numbers.get(&id));
        number.map_or(Cloth::Plain, |&number| printed(number, print, garment, panel, &direction.own))
    };
    plain.dressed(Arc::clone(vectors), fabrics.values().cloned().collect(), cloth)
}
