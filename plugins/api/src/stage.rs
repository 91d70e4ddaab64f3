//! What the document refers to, loaded.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::mesh::Garment;
use amc_core::render::{Mode, Print, Shading};
use egui::ColorImage;

use crate::document::{Asset, FabricId, ViewSettings};
use crate::{Directions, ShadingChoice};

/// The garment and the fabrics of the document, as far as they are loaded.
#[derive(Debug, Clone)]
pub struct Stage {
    /// The garment; none while it is being loaded, or when it could not be.
    pub garment: Option<Arc<Garment>>,
    /// The direction of the garment that is drawn, which may be one before the document's latest; none while none is.
    pub directions: Option<Directions>,
    /// The fabrics that are there.
    pub fabrics: BTreeMap<FabricId, Arc<Amc>>,
    /// A ball in each of them, a small picture.
    pub swatches: BTreeMap<FabricId, Arc<ColorImage>>,
    /// The prints that are there, by their pictures.
    pub prints: HashMap<Asset, Arc<Print>>,
    /// The garment's panels as flat pieces: small pictures in white, one for each panel.
    pub pieces: Vec<Arc<ColorImage>>,
    /// The shading modes there are: the studio's, then the plugins'.
    pub modes: Vec<ShadingChoice>,
}

impl Default for Stage {
    fn default() -> Self {
        Self {
            garment: None,
            directions: None,
            fabrics: BTreeMap::new(),
            swatches: BTreeMap::new(),
            prints: HashMap::new(),
            pieces: Vec::new(),
            modes: ShadingChoice::BUILT_IN.to_vec(),
        }
    }
}

impl Stage {
    /// How the garment is shaded: in a split view left of the divider.
    pub fn shading(&self, view: &ViewSettings) -> Shading {
        Shading { mode: self.mode(&view.mode), ..view.shading() }
    }

    /// How it is shaded right of the divider; none where the view is not split.
    pub fn compared_shading(&self, view: &ViewSettings) -> Option<Shading> {
        let compared = view.compared.as_ref()?;
        let mode = self.mode(compared.mode.as_ref().unwrap_or(&view.mode));
        Some(Shading { mode, ..view.shading() })
    }

    /// The mode of this id. That of a plugin which is not there is cloth.
    fn mode(&self, id: &str) -> Mode {
        self.modes.iter().find(|choice| choice.id == id).map_or(Mode::Amc, |choice| choice.mode.clone())
    }
}
