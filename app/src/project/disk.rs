//! The few things that are done to files, so that tests can make each of them fail.

use std::fmt::Debug;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use amc_core::{Error, Result, file};

/// Where projects, recovery files and settings are kept.
pub trait Disk: Debug + Send + Sync {
    /// The whole of a file of at most `limit` bytes.
    ///
    /// # Errors
    /// The file cannot be read, or is larger.
    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>>;

    /// Saves a file so that at every instant the old or the new one is whole.
    ///
    /// # Errors
    /// The file cannot be written; then what stood there is untouched.
    fn save(&self, path: &Path, bytes: &[u8]) -> Result<()>;

    /// Removes a file; one that is not there is as good as removed.
    ///
    /// # Errors
    /// The operating system refused.
    fn remove(&self, path: &Path) -> Result<()>;

    /// Gives a file another name, in place of whatever has that name.
    ///
    /// # Errors
    /// The operating system refused.
    fn rename(&self, from: &Path, to: &Path) -> Result<()>;

    /// What is in a folder, sorted; nothing where there is no such folder.
    ///
    /// # Errors
    /// The operating system refused.
    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>>;

    /// Whether an ordinary file is there: no folder, no pipe, no device.
    fn is_file(&self, path: &Path) -> bool;

    /// When a file was last written, where that is known.
    fn modified(&self, path: &Path) -> Option<SystemTime>;
}

/// The operating system's files.
#[derive(Debug, Clone, Copy, Default)]
pub struct System;

impl Disk for System {
    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>> {
        file::read(path, limit)
    }

    fn save(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        file::save_bytes(path, bytes)
    }

    fn remove(&self, path: &Path) -> Result<()> {
        match std::fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(Error::io("cannot remove", error).in_file(path))
            }
            _ => Ok(()),
        }
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        std::fs::rename(from, to).map_err(|error| Error::io("cannot rename", error).in_file(from))
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        let refused = |error| Error::io("cannot list the folder", error).in_file(folder);
        let entries = match std::fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(refused(error)),
        };
        let paths: io::Result<Vec<PathBuf>> = entries.map(|entry| entry.map(|entry| entry.path())).collect();
        let mut paths = paths.map_err(refused)?;
        paths.sort();
        Ok(paths)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }

    fn modified(&self, path: &Path) -> Option<SystemTime> {
        std::fs::metadata(path).and_then(|it| it.modified()).ok()
    }
}

/// `error`, met while saving `path`, with what to do about it.
pub(super) fn with_advice(error: Error, path: &Path) -> Error {
    let cause = std::error::Error::source(&error).and_then(|source| source.downcast_ref::<io::Error>());
    let Some(cause) = cause else { return error.in_file(path) };
    let advice = match cause.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
            "there is no room on the disk: make some and save again, or save it elsewhere"
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "it may not be written there: save it elsewhere, or allow writing and save again"
        }
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => {
            "its folder is gone: bring it back and save again, or save it elsewhere"
        }
        _ => "save again, or save it elsewhere",
    };
    let what = format!("not saved, the file is as it was: {advice} ({cause})");
    Error::new(error.kind(), what).in_file(path).because(error)
}
