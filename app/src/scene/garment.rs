//! A garment by its file, or a bundled garment or shape by its name.

use std::path::Path;

use amc_core::mesh::{self, Garment, Unit};
use amc_core::{Result, shape};
use studio_plugin::document::Project;

use super::{asset_path, bundled};

/// How a scene names a bundled garment.
const GARMENT_PREFIX: &str = "garment:";

/// How a scene names a shape.
const SHAPE_PREFIX: &str = "shape:";

/// The garment that `scene` names: a mesh file whose numbers are in `unit`, `garment:NAME` or `shape:NAME`.
pub(crate) fn load_garment(scene: &Path, unit: Unit) -> Result<Garment> {
    let named = |prefix| scene.to_str().and_then(|text| text.strip_prefix(prefix));
    let mesh = match (named(GARMENT_PREFIX), named(SHAPE_PREFIX)) {
        (Some(name), _) => bundled::garment(name)?,
        (_, Some(name)) => shape::mesh(name)?,
        (None, None) => mesh::read(scene, unit)?,
    };
    Garment::new(mesh).map_err(|error| error.in_file(scene))
}

/// The garment of `project` as its panels were merged, split and renamed; what did not fit is among its notices.
pub(crate) fn load_arranged(project: &Project) -> Result<Garment> {
    let garment = load_garment(&asset_path(&project.garment), project.unit)?;
    let (mut garment, faults) = garment.arranged(&project.arrangement);
    garment.notices.extend(faults);
    Ok(garment)
}
