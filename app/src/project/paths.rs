//! Paths in project files: relative where a project and its files are likely to be moved together.

use std::path::{Component, Path, PathBuf};

use amc_core::{Error, Result};

/// How `path` is written in a project that lies in `folder` (absolute): relative where it lies below the folder or
/// below the one around it, with `/` between names; else, and without a folder, absolute.
pub(super) fn written(path: &Path, folder: Option<&Path>) -> Result<String> {
    let absolute =
        std::path::absolute(path).map_err(|error| Error::io("no such path", error).in_file(path))?;
    if let Some(folder) = folder {
        if let Ok(below) = absolute.strip_prefix(folder) {
            return joined(below, "");
        }
        // A file in the root folder is beside everything.
        if let Some(around) = folder.parent().filter(|around| around.parent().is_some())
            && let Ok(beside) = absolute.strip_prefix(around)
        {
            return joined(beside, "../");
        }
    }
    unicode(&absolute).map(str::to_owned)
}

fn joined(relative: &Path, before: &str) -> Result<String> {
    let names: Result<Vec<&str>> = relative.iter().map(|name| unicode(Path::new(name))).collect();
    let text = format!("{before}{}", names?.join("/"));
    Ok(if text.is_empty() { ".".to_owned() } else { text })
}

fn unicode(path: &Path) -> Result<&str> {
    path.to_str().ok_or_else(|| {
        Error::unsupported("the file's name is not Unicode, so no project can name it: rename it")
            .in_file(path)
    })
}

/// The path that `text`, in a project in `folder` (absolute), means, without any `..` in it. Without a folder it stays as
/// it is written.
pub(super) fn meant(text: &str, folder: Option<&Path>) -> PathBuf {
    let path = Path::new(text);
    if text.is_empty() || (folder.is_none() && !path.is_absolute()) {
        return path.to_owned();
    }
    // An absolute one begins with its root, which takes the place of the folder.
    let mut meant = folder.map(Path::to_owned).unwrap_or_default();
    for component in path.components() {
        match component {
            Component::ParentDir => {
                meant.pop();
            }
            Component::CurDir => {}
            other => meant.push(other),
        }
    }
    meant
}

/// The folder a file lies in, absolute.
pub(super) fn folder_of(path: &Path) -> Result<PathBuf> {
    let absolute =
        std::path::absolute(path).map_err(|error| Error::io("no such path", error).in_file(path))?;
    match absolute.parent() {
        Some(folder) => Ok(folder.to_owned()),
        None => Err(Error::invalid("this is no file").in_file(path)),
    }
}

/// The last name of a path, whichever system wrote it.
pub(super) fn last_name(path: &Path) -> Option<String> {
    let text = path.to_str()?;
    text.rsplit(['/', '\\']).next().filter(|name| !name.is_empty() && *name != "..").map(str::to_owned)
}
