//! A scene by the name that a person gives it: a project, a mesh, a bundled garment, a shape.

use std::path::Path;

use amc_core::mesh::{Garment, Unit};
use amc_core::{Error, Progress, Result};
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

impl Scene {
    /// Wears a project's colourway of this name.
    ///
    /// # Errors
    /// There is none; the message says which there are.
    pub(crate) fn wear(&mut self, name: &str) -> Result<()> {
        let Some(project) = &mut self.project else {
            return Err(Error::invalid("only projects (.amcproj) have colourways: leave out --colourway"));
        };
        let named = project.colourways.labels().find(|label| label.name == name).map(|label| label.id);
        let Some(id) = named else {
            let known: Vec<_> =
                project.colourways.labels().map(|label| format!("'{}'", label.name)).collect();
            let known = known.join(", ");
            return Err(Error::invalid(format!(
                "there is no colourway '{name}'; the colourways are {known}"
            )));
        };
        project.wear(id)
    }
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
