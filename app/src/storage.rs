//! Where the program keeps its own files.

use std::path::{Path, PathBuf};

/// The folder of caches: baked fabrics, occlusion. Deleting it costs time only. None where the system names no such
/// folder; then nothing is cached.
pub(crate) fn cache_folder() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "amc-studio");
    if folders.is_none() {
        log::warn!("the system names no folder for caches: everything is made anew");
    }
    folders.map(|folders| folders.cache_dir().to_owned())
}

/// Where the program keeps what it cannot make again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folders {
    /// Settings, recent projects.
    pub settings: PathBuf,
    /// Unsaved work of all windows.
    pub recovery: PathBuf,
    /// Locks of open projects.
    pub locks: PathBuf,
}

impl Folders {
    /// Those of the person who runs the program. None where the system names none; then nothing is remembered and unsaved
    /// work is not kept, of which the person is to be told.
    pub fn of_the_person() -> Option<Self> {
        let folders = directories::ProjectDirs::from("", "", "amc-studio")?;
        Some(Self {
            settings: folders.config_dir().to_owned(),
            recovery: folders.data_local_dir().join("recovery"),
            locks: folders.data_local_dir().join("locks"),
        })
    }

    /// All of them within one folder.
    pub fn in_folder(folder: &Path) -> Self {
        Self {
            settings: folder.to_owned(),
            recovery: folder.join("recovery"),
            locks: folder.join("locks"),
        }
    }
}
