//! Saving a project.

use std::path::Path;

use amc_core::Result;
use studio_plugin::document::{Asset, Project};

use super::disk::with_advice;
use super::open::key;
use super::{Disk, Unknown, encode, paths};

/// Saves a project: at every instant the old or the new file is whole. Files that nobody has looked into are read for
/// what they hold, so this is work for a job where there are such.
///
/// # Errors
/// As [`encode`]; or the file cannot be written: the message says what to do, and what stood there is untouched.
pub fn save(disk: &dyn Disk, path: &Path, project: &Project, unknown: &Unknown) -> Result<()> {
    let folder = paths::folder_of(path)?;
    let mut project = project.clone();
    for asset in project.assets_mut() {
        if let Asset::File { path, content: content @ None } = asset
            && disk.is_file(path)
        {
            *content = key(disk, path);
        }
    }
    let bytes = encode(&project, unknown, Some(&folder)).map_err(|error| error.in_file(path))?;
    disk.save(path, &bytes).map_err(|error| with_advice(error, path))
}
