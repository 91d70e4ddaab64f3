//! Projects that were opened or saved lately.

use std::path::{Path, PathBuf};

use amc_core::Result;
use serde::{Deserialize, Serialize};

use super::Disk;
use super::settings::{self, Loaded};

/// How many are remembered.
pub const MOST: usize = 12;

/// The list, in the settings' folder.
const FILE: &str = "recent.json";

#[derive(Debug, Default, Serialize, Deserialize)]
struct List {
    projects: Vec<PathBuf>,
}

/// The projects, the latest first. A list that cannot be read is set aside, and is empty.
pub fn list(disk: &dyn Disk, folder: &Path) -> Loaded<Vec<PathBuf>> {
    let Loaded { value: List { mut projects }, notice } = settings::load(disk, &folder.join(FILE));
    projects.truncate(MOST);
    Loaded { value: projects, notice }
}

/// Puts `project` first; the list is read again before, as another window may have written it.
///
/// # Errors
/// The list cannot be written.
pub fn add(disk: &dyn Disk, folder: &Path, project: &Path) -> Result<()> {
    let project = std::path::absolute(project).unwrap_or_else(|_| project.to_owned());
    let mut projects = without(disk, folder, &project);
    projects.insert(0, project);
    projects.truncate(MOST);
    settings::save(disk, &folder.join(FILE), &List { projects })
}

/// Takes `project` off the list: it is gone, or nobody's business.
///
/// # Errors
/// The list cannot be written.
pub fn forget(disk: &dyn Disk, folder: &Path, project: &Path) -> Result<()> {
    let projects = without(disk, folder, project);
    settings::save(disk, &folder.join(FILE), &List { projects })
}

fn without(disk: &dyn Disk, folder: &Path, project: &Path) -> Vec<PathBuf> {
    let Loaded { value: mut projects, notice } = list(disk, folder);
    if let Some(notice) = notice {
        log::warn!("the list of recent projects starts anew: {notice}");
    }
    projects.retain(|known| known != project);
    projects
}
