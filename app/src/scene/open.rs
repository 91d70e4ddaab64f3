//! A scene by the name that a person gives it: a project, a mesh, a bundled garment, a shape.

use std::path::Path;

use amc_core::mesh::{Garment, Unit};
use amc_core::{Progress, Result};
use studio_plugin::document::Project;

use super::{is_project, load_arranged, load_garment};
use crate::project::{self, System};

/// A garment, and what a project says of it where it comes from one.
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) garment: Garment,
    pub(crate) project: Option<Project>,
    /// What else there is to say.
    pub(crate) notices: Vec<String>,
}

/// Opens a project (which says its garment's unit), a mesh file whose numbers are in `unit`, `garment:NAME` or `shape:NAME`.
///
/// # Errors
/// A file cannot be read or makes no sense; the error names it.
pub(crate) fn open_scene(named: &Path, unit: Unit, progress: &Progress<'_>) -> Result<Scene> {
    if !is_project(named) {
        let garment = load_garment(named, unit)?;
        return Ok(Scene { notices: garment.notices.clone(), garment, project: None });
    }
    let opened = project::open(&System, named, progress)?;
    let garment = load_arranged(&opened.project)?;
    let notices = opened.notices.into_iter().chain(garment.notices.iter().cloned()).collect();
    Ok(Scene { garment, project: Some(opened.project), notices })
}
