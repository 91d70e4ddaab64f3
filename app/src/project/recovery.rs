//! Recovery files: unsaved work that outlives its process.
//!
//! Each session has a file of work and a lock in the recovery folder, of one unlikely name. The lock is held while the
//! session lives, so a work file whose lock can be had is a dead session's.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use amc_core::file::{content_key, make_folder};
use amc_core::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use studio_plugin::document::{Asset, Project};

use super::format::{FILE_LIMIT, Read, encode_value, json_error, parse, parse_value};
use super::lock::{LockFile, hold};
use super::settings::aside_notice;
use super::{Disk, Unknown};

/// What a file of unsaved work ends with, without the dot.
const WORK: &str = "amcrecovery";

/// What a session's lock ends with, without the dot.
const LOCK: &str = "lock";

/// The version of the frame around the project, which has its own.
const VERSION: u32 = 1;

/// The largest recovery file, bytes: its project has longer paths than the same one beside its files.
const WORK_LIMIT: u64 = 2 * FILE_LIMIT;

/// What a recovery file holds. The project's paths are absolute: it lies in another folder than the project.
#[derive(Debug, Serialize, Deserialize)]
struct RecoveryForm {
    version: u32,
    process: u32,
    belongs_to: Option<PathBuf>,
    project: Value,
}

/// A living session's place for unsaved work.
#[derive(Debug)]
pub(super) struct Session {
    lock: Option<LockFile>,
    lock_path: PathBuf,
    work_path: PathBuf,
}

impl Session {
    /// A place of its own in `folder`.
    pub(super) fn begin(folder: &Path) -> Result<Self> {
        make_folder(folder)?;
        for attempt in 0..100_u32 {
            let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
            let unlikely = format!("{} {} {attempt}", std::process::id(), now.as_nanos());
            let name = format!("{}-{}", std::process::id(), &content_key(unlikely.as_bytes())[..12]);
            let (lock_path, work_path) =
                (folder.join(format!("{name}.{LOCK}")), folder.join(format!("{name}.{WORK}")));
            // Somebody who clears up may have taken the lock, or removed it, between its making and its holding.
            if !work_path.exists()
                && let Some(lock) = hold(&lock_path)?
                && lock_path.exists()
            {
                return Ok(Self { lock: Some(lock), lock_path, work_path });
            }
        }
        Err(Error::invalid("no name is free for a recovery file").in_file(folder))
    }

    /// Keeps `project`, which belongs to the file `belongs_to`.
    pub(super) fn keep(
        &self,
        disk: &dyn Disk,
        project: &Project,
        unknown: &Unknown,
        belongs_to: Option<&Path>,
    ) -> Result<()> {
        let form = RecoveryForm {
            version: VERSION,
            process: std::process::id(),
            belongs_to: belongs_to.map(Path::to_owned),
            project: encode_value(project, unknown, None)?,
        };
        let bytes = serde_json::to_vec(&form).map_err(json_error)?;
        if bytes.len() as u64 > WORK_LIMIT {
            return Err(Error::too_large(format!("it is larger than {} MiB", WORK_LIMIT >> 20)));
        }
        disk.save(&self.work_path, &bytes)
    }

    /// Forgets what was kept.
    pub(super) fn forget(&self, disk: &dyn Disk) -> Result<()> {
        disk.remove(&self.work_path)
    }

    /// Ends the session; what was kept and not forgotten stays, for the next one to offer.
    pub(super) fn end(mut self, disk: &dyn Disk) -> Result<()> {
        if disk.is_file(&self.work_path) {
            return Ok(());
        }
        remove_lock(disk, self.lock.take(), &self.lock_path)
    }
}

fn remove_lock(disk: &dyn Disk, lock: Option<LockFile>, path: &Path) -> Result<()> {
    // Removed while it is held, so that nobody takes what is about to go. Windows removes it once it is let go.
    let removed = disk.remove(path);
    drop(lock);
    if removed.is_err() { disk.remove(path) } else { removed }
}

/// Unsaved work of a dead session. It is this process's until it is dropped: another window is not offered it meanwhile.
#[derive(Debug)]
pub struct Recoverable {
    /// The work.
    pub read: Read,
    /// The file it was opened from or saved to; none: nowhere yet.
    pub belongs_to: Option<PathBuf>,
    /// The process that did it.
    pub process: u32,
    /// When it was kept, where that is known.
    pub kept: Option<SystemTime>,
    /// Whether the file it belongs to was written after it: that probably holds the work already, and more.
    pub is_older: bool,
    work_path: PathBuf,
    lock_path: PathBuf,
    lock: Option<LockFile>,
}

impl Recoverable {
    /// Removes it, once the work is unwanted, or is kept elsewhere ([`super::Autosave::adopt`] sees to that).
    ///
    /// # Errors
    /// The operating system refused.
    pub fn discard(mut self, disk: &dyn Disk) -> Result<()> {
        disk.remove(&self.work_path)?;
        remove_lock(disk, self.lock.take(), &self.lock_path)
    }
}

/// What dead sessions left.
#[derive(Debug, Default)]
pub struct Recovery {
    /// Their unsaved work, the latest first.
    pub works: Vec<Recoverable>,
    /// What could not be read, and where it is kept.
    pub notices: Vec<String>,
}

/// Looks for what dead sessions left in `folder`. Work that its file holds already is cleared away, and so is what is
/// empty; what cannot be read is set aside.
///
/// # Errors
/// The folder cannot be listed.
pub fn recoverable(disk: &dyn Disk, folder: &Path) -> Result<Recovery> {
    let mut found = Recovery::default();
    for lock_path in disk.list(folder)? {
        if lock_path.extension().is_none_or(|it| it != LOCK) {
            continue;
        }
        // One that cannot be locked may be alive.
        let lock = hold(&lock_path).unwrap_or_else(|error| {
            found.notices.push(format!("it is not known whether there is unsaved work: {error}"));
            None
        });
        if let Some(lock) = lock {
            look(disk, lock_path, lock, &mut found);
        }
    }
    found.works.sort_by_key(|work| std::cmp::Reverse(work.kept));
    Ok(found)
}

fn look(disk: &dyn Disk, lock_path: PathBuf, lock: LockFile, found: &mut Recovery) {
    let work_path = lock_path.with_extension(WORK);
    match read(disk, &work_path) {
        None => {}
        // A newer program reads it.
        Some(Err(error)) if error.kind() == ErrorKind::Unsupported => {
            found.notices.push(error.to_string());
            return;
        }
        Some(Err(error)) => {
            found.notices.push(aside_notice(disk, &work_path, &error));
            if disk.is_file(&work_path) {
                return;
            }
        }
        Some(Ok((form, read))) => {
            let file = form.belongs_to.as_deref();
            if !file.is_some_and(|file| is_saved(disk, file, &read)) {
                let kept = disk.modified(&work_path);
                let is_older = file.and_then(|file| disk.modified(file)) > kept;
                let RecoveryForm { belongs_to, process, .. } = form;
                let lock = Some(lock);
                let work =
                    Recoverable { read, belongs_to, process, kept, is_older, work_path, lock_path, lock };
                found.works.push(work);
                return;
            }
        }
    }
    clear_away(disk, &work_path, lock, &lock_path);
}

/// Removes what nobody needs.
fn clear_away(disk: &dyn Disk, work_path: &Path, lock: LockFile, lock_path: &Path) {
    let removed = disk.remove(work_path).and_then(|()| remove_lock(disk, Some(lock), lock_path));
    if let Err(error) = removed {
        log::warn!("a dead session's file stays: {error}");
    }
}

fn read(disk: &dyn Disk, path: &Path) -> Option<Result<(RecoveryForm, Read)>> {
    disk.is_file(path).then(|| {
        let bytes = disk.read(path, WORK_LIMIT)?;
        parse_recovery(&bytes).map_err(|error| error.in_file(path))
    })
}

fn parse_recovery(bytes: &[u8]) -> Result<(RecoveryForm, Read)> {
    let mut form: RecoveryForm = serde_json::from_slice(bytes).map_err(json_error)?;
    if form.version != VERSION {
        let what = format!("unsaved work in version {}: a newer AMC Studio opens it", form.version);
        return Err(Error::unsupported(what));
    }
    let read = parse_value(form.project.take(), None)?;
    Ok((form, read))
}

/// Whether `file` holds this very work. The view is no work, and that a save looked into files is none either.
fn is_saved(disk: &dyn Disk, file: &Path, work: &Read) -> bool {
    let folder = super::paths::folder_of(file).ok();
    let saved = disk.read(file, FILE_LIMIT).and_then(|bytes| parse(&bytes, folder.as_deref()));
    let Ok(Read { project: saved, .. }) = saved else { return false };
    let mut work = Project { view: saved.view.clone(), ..work.project.clone() };
    for (asset, saved) in work.assets_mut().zip(saved.assets()) {
        if let Asset::File { content: None, path } = asset
            && saved.path() == Some(path)
        {
            *asset = saved.clone();
        }
    }
    work == saved
}
