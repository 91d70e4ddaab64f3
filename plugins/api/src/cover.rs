//! What lies over the cloth while it is looked at.

use std::sync::Arc;

use amc_core::direction::comb::CombedField;
use amc_core::mesh::Garment;
use amc_core::render::LaidPrint;
use glam::Vec3;

/// Pictures over a garment's panels, in place of their fabrics and prints. A way of looking: no part of the document, in no export.
/// Of a split view they cover what is left of the divider.
#[derive(Debug, Clone)]
pub struct Cover {
    /// What it covers; no other garment is.
    pub garment: Arc<Garment>,
    /// One for each panel; a panel without one is plain grey.
    pub panels: Vec<Option<LaidPrint>>,
}

/// The direction of the cloth as it is drawn.
#[derive(Debug, Clone)]
pub struct Directions {
    /// Whose it is.
    pub garment: Arc<Garment>,
    /// One for each vertex: unit, object space, perpendicular to the normal. Another list in memory is a new direction.
    pub vectors: Arc<Vec<Vec3>>,
    /// What the strokes of each panel made; none where there are none.
    pub fields: Vec<Option<Arc<CombedField>>>,
}
