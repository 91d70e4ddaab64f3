//! Small JSON files of settings. One that cannot be read is set aside and said, never overwritten.

use std::path::{Path, PathBuf};

use amc_core::{Error, Result, file};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Disk;
use super::disk::with_advice;

/// The largest file of settings, bytes: 4 MiB.
const FILE_LIMIT: u64 = 4 << 20;

/// How many unreadable files of one name are kept.
const MOST_BROKEN: usize = 9;

/// Settings as they were read, or the default ones.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loaded<T> {
    /// The settings.
    pub value: T,
    /// What to tell the person, where they could not be read.
    pub notice: Option<String>,
}

/// The settings in `path`; the default ones where there is no such file. One that is there but cannot be understood is
/// set aside (renamed with `.broken` at its end), and the default ones are used.
pub fn load<T: DeserializeOwned + Default>(disk: &dyn Disk, path: &Path) -> Loaded<T> {
    if !disk.is_file(path) {
        return Loaded { value: T::default(), notice: None };
    }
    let read = disk.read(path, FILE_LIMIT).and_then(|bytes| {
        serde_json::from_slice(&bytes).map_err(|error| Error::malformed(error.to_string()).in_file(path))
    });
    match read {
        Ok(value) => Loaded { value, notice: None },
        Err(error) => Loaded { value: T::default(), notice: Some(aside_notice(disk, path, &error)) },
    }
}

/// Saves settings, making their folder where it is missing.
///
/// # Errors
/// The file cannot be written.
pub fn save<T: Serialize>(disk: &dyn Disk, path: &Path, value: &T) -> Result<()> {
    let json = |error: serde_json::Error| Error::invalid(format!("no JSON: {error}")).in_file(path);
    let mut bytes = serde_json::to_vec_pretty(value).map_err(json)?;
    bytes.push(b'\n');
    if let Some(folder) = path.parent() {
        file::make_folder(folder)?;
    }
    disk.save(path, &bytes).map_err(|error| with_advice(error, path))
}

/// Sets the unreadable `path` aside; what to tell the person.
pub(super) fn aside_notice(disk: &dyn Disk, path: &Path, error: &Error) -> String {
    match set_aside(disk, path) {
        Ok(aside) => format!("{error}; it is kept as {}", aside.display()),
        Err(refused) => format!("{error}; it could not be set aside: {refused}"),
    }
}

fn set_aside(disk: &dyn Disk, path: &Path) -> Result<PathBuf> {
    let name = |number: usize| {
        let mut name = path.as_os_str().to_owned();
        name.push(if number == 0 { ".broken".to_owned() } else { format!(".broken-{number}") });
        PathBuf::from(name)
    };
    // With so many, the last one gives way.
    let aside = (0..MOST_BROKEN).map(name).find(|path| !disk.is_file(path));
    let aside = aside.unwrap_or_else(|| name(MOST_BROKEN));
    disk.rename(path, &aside)?;
    Ok(aside)
}
