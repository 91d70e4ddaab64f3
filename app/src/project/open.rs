//! Opening a project, and finding what lies no longer where it was.

use std::path::{Path, PathBuf};

use amc_core::file::content_key;
use amc_core::{Progress, Result};
use studio_plugin::document::{Asset, Edit, Project};

use super::format::{FILE_LIMIT, Read, VERSION, parse};
use super::{Disk, Unknown, paths};

/// The largest file whose content is compared with what it was, bytes: that of a mesh.
const ASSET_LIMIT: u64 = amc_core::mesh::FILE_LIMIT;

/// A project that was opened.
#[derive(Debug)]
pub struct Opened {
    /// The project. Missing files are named in it as they were.
    pub project: Project,
    /// Keys of a newer program, for [`super::save`].
    pub unknown: Unknown,
    /// Files that are not there.
    pub missing: Vec<Missing>,
    /// What else there is to say: files that changed or were found elsewhere, an older version.
    pub notices: Vec<String>,
    /// Whether it is no longer what its file says: a file was found elsewhere, or it was brought from an older version.
    pub is_changed: bool,
}

/// A file that a project uses and that is not there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// As the project names it.
    pub asset: Asset,
    /// Where it was looked for.
    pub looked_for: Vec<PathBuf>,
}

/// Opens a project and looks at the files it uses. They are read whole, so this is work for a job.
///
/// A file that is not where it should be is taken from the project's own folder if it has the same name and content
/// there; else it is [`Missing`].
///
/// # Errors
/// As [`parse`]; or the file cannot be read. The error names the file. Cancelled.
pub fn open(disk: &dyn Disk, path: &Path, progress: &Progress<'_>) -> Result<Opened> {
    let folder = paths::folder_of(path)?;
    let bytes = disk.read(path, FILE_LIMIT)?;
    let Read { project, unknown, version } =
        parse(&bytes, Some(&folder)).map_err(|error| error.in_file(path))?;
    let mut opened =
        Opened { project, unknown, missing: Vec::new(), notices: Vec::new(), is_changed: version != VERSION };
    if version != VERSION {
        opened.notices.push(format!(
            "{} was written in version {version}: saving it writes version {VERSION}",
            path.display()
        ));
    }
    opened.look_for_files(disk, Some(&folder), progress)?;
    Ok(opened)
}

impl Opened {
    /// A project that was recovered; `folder` is that of the file it belongs to.
    ///
    /// # Errors
    /// Cancelled.
    pub fn recovered(
        disk: &dyn Disk,
        read: Read,
        folder: Option<&Path>,
        progress: &Progress<'_>,
    ) -> Result<Self> {
        let Read { project, unknown, .. } = read;
        let mut opened =
            Self { project, unknown, missing: Vec::new(), notices: Vec::new(), is_changed: true };
        opened.look_for_files(disk, folder, progress)?;
        Ok(opened)
    }

    fn look_for_files(
        &mut self,
        disk: &dyn Disk,
        folder: Option<&Path>,
        progress: &Progress<'_>,
    ) -> Result<()> {
        let total = self.project.assets().count();
        for (k, asset) in self.project.assets_mut().enumerate() {
            progress.step("looking for files", k, total)?;
            match look(disk, asset, folder) {
                Found::AsItWas => {}
                Found::Changed(now) => {
                    self.notices.push(format!("{} has changed since the project was saved", shown(&now)));
                    *asset = now;
                }
                Found::Elsewhere(now) => {
                    self.notices.push(format!("{} was found beside the project", shown(&now)));
                    *asset = now;
                    self.is_changed = true;
                }
                Found::Nowhere(looked_for) => {
                    let missing = Missing { asset: asset.clone(), looked_for };
                    // Two fabrics may use one file.
                    if !self.missing.contains(&missing) {
                        self.missing.push(missing);
                    }
                }
            }
        }
        self.notices.dedup();
        Ok(())
    }
}

fn shown(asset: &Asset) -> String {
    asset.path().map_or_else(|| asset.name(), |path| path.display().to_string())
}

enum Found {
    AsItWas,
    Changed(Asset),
    Elsewhere(Asset),
    Nowhere(Vec<PathBuf>),
}

fn look(disk: &dyn Disk, asset: &Asset, folder: Option<&Path>) -> Found {
    let Asset::File { path, content: was } = asset else { return Found::AsItWas };
    if disk.is_file(path) {
        return match (was, key(disk, path)) {
            (Some(was), Some(is)) if *was != is => {
                Found::Changed(Asset::File { path: path.clone(), content: Some(is) })
            }
            // What cannot be read is for whoever loads it to say.
            _ => Found::AsItWas,
        };
    }
    let beside = folder.zip(paths::last_name(path)).map(|(folder, name)| folder.join(name));
    let mut looked_for = vec![path.clone()];
    if let Some(beside) = beside.filter(|beside| beside != path) {
        if was.is_some() && disk.is_file(&beside) && key(disk, &beside) == *was {
            return Found::Elsewhere(Asset::File { path: beside, content: was.clone() });
        }
        looked_for.push(beside);
    }
    Found::Nowhere(looked_for)
}

/// What a file holds; none where it cannot be read.
pub(super) fn key(disk: &dyn Disk, path: &Path) -> Option<String> {
    match disk.read(path, ASSET_LIMIT) {
        Ok(bytes) => Some(content_key(&bytes)),
        Err(error) => {
            log::warn!("its content is not compared: {error}");
            None
        }
    }
}

/// The edits that put `new` in place of the missing `old`, and with it every other missing file that lies to `new` as it
/// lay to `old`: whole folders are moved more often than files. To be submitted in one gesture.
///
/// # Errors
/// `new` cannot be read.
pub fn locate(disk: &dyn Disk, missing: &[Missing], old: &Path, new: &Path) -> Result<Vec<Edit>> {
    let new = std::path::absolute(new).unwrap_or_else(|_| new.to_owned());
    let content = Some(content_key(&disk.read(&new, ASSET_LIMIT)?));
    let mut edits =
        vec![Edit::Relocate { old: old.to_owned(), new: Asset::File { path: new.clone(), content } }];
    let (Some(from), Some(to)) = (old.parent(), new.parent()) else { return Ok(edits) };
    for Missing { asset, .. } in missing {
        let Asset::File { path, content: was } = asset else { continue };
        let Ok(below) = path.strip_prefix(from) else { continue };
        let moved = to.join(below);
        if path == old || !disk.is_file(&moved) {
            continue;
        }
        let is = key(disk, &moved);
        if is.is_some() && (was.is_none() || is == *was) {
            edits.push(Edit::Relocate { old: path.clone(), new: Asset::File { path: moved, content: is } });
        }
    }
    Ok(edits)
}
