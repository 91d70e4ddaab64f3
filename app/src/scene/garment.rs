//! A garment by its file, or a shape by its name.

use std::path::Path;

use amc_core::mesh::{self, Garment, Unit};
use amc_core::{Result, shape};

/// How a scene names a shape.
const SHAPE_PREFIX: &str = "shape:";

/// The garment that `scene` names: a mesh file whose numbers are in `unit`, or `shape:NAME`.
pub(crate) fn load_garment(scene: &Path, unit: Unit) -> Result<Garment> {
    let mesh = match scene.to_str().and_then(|text| text.strip_prefix(SHAPE_PREFIX)) {
        Some(name) => shape::mesh(name)?,
        None => mesh::read(scene, unit)?,
    };
    Garment::new(mesh).map_err(|error| error.in_file(scene))
}
