//! What the document refers to, loaded.

use std::collections::BTreeMap;
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::mesh::Garment;

use crate::document::FabricId;

/// The garment and the fabrics of the document, as far as they are loaded.
#[derive(Debug, Clone, Default)]
pub struct Stage {
    /// The garment; none while it is being loaded, or when it could not be.
    pub garment: Option<Arc<Garment>>,
    /// The fabrics that are there.
    pub fabrics: BTreeMap<FabricId, Arc<Amc>>,
}
