//! Where the program keeps what it can make again.

use std::path::PathBuf;

/// The folder of caches: baked fabrics, occlusion. Deleting it costs time only. None where the system names no such
/// folder; then nothing is cached.
pub(crate) fn cache_folder() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "amc-studio");
    if folders.is_none() {
        log::warn!("the system names no folder for caches: everything is made anew");
    }
    folders.map(|folders| folders.cache_dir().to_owned())
}
