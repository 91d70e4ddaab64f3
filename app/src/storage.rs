//! Where the program keeps what is no project.

use std::path::PathBuf;

/// The folder of caches: baked fabrics, occlusion. Deleting it costs time only. None where the system names no such
/// folder; then nothing is cached.
pub(crate) fn cache_folder() -> Option<PathBuf> {
    let folders = folders();
    if folders.is_none() {
        log::warn!("the system names no folder for caches: everything is made anew");
    }
    folders.map(|folders| folders.cache_dir().to_owned())
}

/// The folder of recovery files, locks and settings. None where the system names no such folder.
pub(crate) fn data_folder() -> Option<PathBuf> {
    folders().map(|folders| folders.data_local_dir().to_owned())
}

fn folders() -> Option<directories::ProjectDirs> {
    directories::ProjectDirs::from("", "", "amc-studio")
}
