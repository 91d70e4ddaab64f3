//! Reading whole files under a limit, and saving without ever leaving half a file.

use std::fs::File;
use std::io::{BufWriter, Read, Seek, Write};
use std::path::Path;

use crate::{Error, Result};

/// Reads a whole file of at most `limit` bytes.
///
/// # Errors
/// The file cannot be read, or is larger than `limit`; the error names the file.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let mut open = File::open(path).map_err(|source| Error::io("cannot open", source).in_file(path))?;
    let size = open.metadata().map_err(|source| Error::io("cannot read", source).in_file(path))?.len();
    let too_large = || Error::too_large(format!("larger than the limit of {limit} bytes")).in_file(path);
    if size > limit {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(size).map_err(|_| too_large())?);
    let mut limited = (&mut open).take(limit + 1);
    limited.read_to_end(&mut bytes).map_err(|source| Error::io("cannot read", source).in_file(path))?;
    // A pipe or a file that grew while it was read.
    if bytes.len() as u64 > limit {
        return Err(too_large());
    }
    Ok(bytes)
}

/// Saves a file: written beside its place, flushed to the disk, then renamed, so that at every instant the old or
/// the new file is whole.
///
/// # Errors
/// `write` failed, or the operating system refused; the error names the file and what stood there is untouched.
pub fn save(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
    save_seekable(path, |out| write(out))
}

/// What can be written and gone back in.
pub trait WriteSeek: Write + Seek {}

impl<T: Write + Seek> WriteSeek for T {}

/// As [`save`], for formats that are written here and there: tables at their start that are known at the end.
///
/// # Errors
/// As [`save`].
pub fn save_seekable(path: &Path, write: impl FnOnce(&mut dyn WriteSeek) -> Result<()>) -> Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let io = |source| Error::io("cannot write", source).in_file(path);
    let temporary = tempfile::Builder::new().prefix(".saving-").tempfile_in(folder).map_err(io)?;
    let mut buffered = BufWriter::new(temporary);
    write(&mut buffered).map_err(|error| error.in_file(path))?;
    let temporary = buffered.into_inner().map_err(|error| io(error.into_error()))?;
    temporary.as_file().sync_all().map_err(io)?;
    set_usual_permissions(temporary.as_file(), path);
    temporary.persist(path).map_err(|error| io(error.error))?;
    // The rename itself is durable once the folder is; where a folder cannot be opened (Windows), the rename stands alone.
    if let Ok(folder) = File::open(folder) {
        folder.sync_all().map_err(io)?;
    }
    Ok(())
}

/// Saves bytes that are ready, as [`save`] does.
///
/// # Errors
/// As [`save`].
pub fn save_bytes(path: &Path, bytes: &[u8]) -> Result<()> {
    save(path, |out| out.write_all(bytes).map_err(|source| Error::io("cannot write", source)))
}

/// Makes a folder and those above it, where they are missing.
///
/// # Errors
/// The operating system refused; the error names the folder.
pub fn make_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder)
        .map_err(|source| Error::io("cannot make the folder", source).in_file(folder))
}

/// A name for what was made from `content`: 32 hexadecimal digits, the same for the same content.
pub fn content_key(content: &[u8]) -> String {
    blake3::hash(content).to_hex()[..32].to_owned()
}

/// A temporary file is private to its owner; what is saved has the mode of the file it replaces, else the usual one.
#[cfg(unix)]
fn set_usual_permissions(file: &File, replaces: &Path) {
    use std::os::unix::fs::PermissionsExt as _;
    let mode = std::fs::metadata(replaces).map_or(0o644, |old| old.permissions().mode());
    if let Err(error) = file.set_permissions(std::fs::Permissions::from_mode(mode)) {
        log::warn!("the saved file keeps private permissions: {error}: {}", replaces.display());
    }
}

#[cfg(not(unix))]
fn set_usual_permissions(_file: &File, _replaces: &Path) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_save_leaves_the_old_file_and_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kept.txt");
        save_bytes(&path, b"old").unwrap();
        let failed = save(&path, |out| {
            out.write_all(b"half").unwrap();
            Err(Error::invalid("stopped in the middle"))
        });
        assert!(failed.unwrap_err().to_string().contains("kept.txt"));
        assert_eq!(read(&path, 100).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_file_over_the_limit_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        save_bytes(&path, &[0; 11]).unwrap();
        assert_eq!(read(&path, 10).unwrap_err().kind(), crate::ErrorKind::TooLarge);
        assert_eq!(read(&path, 11).unwrap().len(), 11);
    }
}
