//! Locks of the operating system's own: they die with the process that holds them, however it dies.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use amc_core::file::{content_key, make_folder};
use amc_core::{Error, Result};

/// A file held by this process until it is dropped.
#[derive(Debug)]
pub(super) struct LockFile {
    _held: File,
}

/// Holds the file at `path`, which is made where it is missing. None: another process holds it, or another part of this
/// one.
pub(super) fn hold(path: &Path) -> Result<Option<LockFile>> {
    let refused = |error| Error::io("cannot lock", error).in_file(path);
    let open = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
    let mut file = open.map_err(refused)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Ok(None),
        Err(TryLockError::Error(error)) => return Err(refused(error)),
    }
    let process = std::process::id().to_string();
    file.set_len(0)
        .and_then(|()| file.rewind())
        .and_then(|()| file.write_all(process.as_bytes()))
        .map_err(refused)?;
    Ok(Some(LockFile { _held: file }))
}

/// Which process wrote its number into a lock file, where it says so.
fn holder(path: &Path) -> Option<u32> {
    let mut text = String::new();
    File::open(path).ok()?.take(32).read_to_string(&mut text).ok()?;
    text.parse().ok()
}

/// A project that is open in this window, until it is dropped.
///
/// It is a lock file in the program's data folder, named after the project's real path, and stays there when it is
/// empty of use: removing it could pull it from under another window.
#[derive(Debug)]
pub struct ProjectLock {
    _file: LockFile,
    project: PathBuf,
}

/// What came of asking for a project.
#[derive(Debug)]
pub enum Claim {
    /// It is this window's.
    Ours(ProjectLock),
    /// It is open in another window.
    Theirs {
        /// Of which process, where that is known.
        process: Option<u32>,
    },
}

impl ProjectLock {
    /// Claims the project at `project`, whether or not it is saved there yet. `folder` is where locks are kept, the same
    /// for all windows.
    ///
    /// # Errors
    /// The folder of the project is gone, or the lock's folder cannot be written; editing may go on unlocked, but the
    /// person is to be told.
    pub fn claim(folder: &Path, project: &Path) -> Result<Claim> {
        let project = real_path(project)?;
        make_folder(folder)?;
        let key = content_key(project.as_os_str().as_encoded_bytes());
        let path = folder.join(format!("{key}.lock"));
        Ok(match hold(&path)? {
            Some(file) => Claim::Ours(Self { _file: file, project }),
            None => Claim::Theirs { process: holder(&path) },
        })
    }

    /// The real path of the project: no links in it.
    pub fn project(&self) -> &Path {
        &self.project
    }
}

/// The path without links, of a file that need not be there.
fn real_path(path: &Path) -> Result<PathBuf> {
    if let Ok(real) = path.canonicalize() {
        return Ok(real);
    }
    let absolute =
        std::path::absolute(path).map_err(|error| Error::io("no such path", error).in_file(path))?;
    match (absolute.parent(), absolute.file_name()) {
        (Some(folder), Some(name)) => {
            let refused = |error| Error::io("cannot find the folder", error).in_file(folder);
            Ok(folder.canonicalize().map_err(refused)?.join(name))
        }
        _ => Err(Error::invalid("this is no file").in_file(path)),
    }
}
