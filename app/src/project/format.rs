//! A `.amcproj` as bytes.

use std::path::Path;

use amc_core::{Error, Place, Result};
use serde_json::Value;
use studio_plugin::document::Project;

use super::form::ProjectForm;
use super::{Unknown, migrations};

/// The version this program writes; it reads all up to it.
pub const VERSION: u32 = 1;

/// What a project's file ends with, without the dot.
pub const SUFFIX: &str = "amcproj";

/// The largest file that is taken for a project, bytes: 16 MiB.
pub const FILE_LIMIT: u64 = 16 << 20;

/// What a project's file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The project, checked.
    pub project: Project,
    /// Keys that this program does not know, to be saved again.
    pub unknown: Unknown,
    /// The version it was written in; less than [`VERSION`]: it was brought up to it.
    pub version: u32,
}

/// Reads the bytes of a project in `folder` (absolute): relative paths start there. Without a folder they stay as they
/// are written.
///
/// # Errors
/// No JSON or not of a project's form (with line and column), a newer version, or a project that
/// [`Project::check`] refuses (with the element); larger than [`FILE_LIMIT`].
pub fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<Read> {
    if bytes.len() as u64 > FILE_LIMIT {
        let what = format!("a project of more than {} MiB: this is something else", FILE_LIMIT >> 20);
        return Err(Error::too_large(what));
    }
    // Some editors begin a file with a mark of its encoding.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let value: Value = serde_json::from_slice(bytes).map_err(json_error)?;
    let version = version(&value)?;
    match version == VERSION {
        // Once more from the bytes: only so are line and column known.
        true => read(serde_json::from_slice(bytes).map_err(json_error)?, &value, version, folder),
        false => parse_value(value, folder),
    }
}

/// As [`parse`], from JSON that was read already: faults are named without line and column.
pub(super) fn parse_value(value: Value, folder: Option<&Path>) -> Result<Read> {
    let version = version(&value)?;
    let value = migrations::migrated(value, version)?;
    let form = ProjectForm::deserialize_value(&value)?;
    read(form, &value, version, folder)
}

fn read(form: ProjectForm, value: &Value, version: u32, folder: Option<&Path>) -> Result<Read> {
    let project = form.into_project(folder)?;
    project.check()?;
    // What would be written of it; all else in the file is unknown.
    let known = json(&ProjectForm::new(&project, folder)?)?;
    // A number too large for its kind is endless when it is read, and nothing when it is written.
    if ProjectForm::deserialize_value(&known).is_err() {
        return Err(Error::invalid("a number is too large").at_element("view"));
    }
    Ok(Read { unknown: Unknown::between(value, &known), project, version })
}

fn version(value: &Value) -> Result<u32> {
    let Some(object) = value.as_object() else {
        return Err(Error::malformed("not a project: a project is an object, { ... }"));
    };
    let refused = |error: Error| Err(error.at_element("version"));
    match object.get("version") {
        // Before there were versions.
        None => Ok(0),
        Some(version) => match version.as_u64() {
            None => refused(Error::malformed("the version is not a whole number")),
            Some(newer) if newer > u64::from(VERSION) => refused(Error::unsupported(format!(
                "a project of version {newer}, and this program knows those up to {VERSION}: open it with a newer AMC Studio"
            ))),
            Some(known) => Ok(known as u32),
        },
    }
}

/// The bytes of `project` as it is saved in `folder` (absolute), with keys of a newer program that were read with it.
///
/// # Errors
/// A file's name is not Unicode, or all is larger than [`FILE_LIMIT`] and so could not be read again.
pub fn encode(project: &Project, unknown: &Unknown, folder: Option<&Path>) -> Result<Vec<u8>> {
    let value = encode_value(project, unknown, folder)?;
    let mut bytes = serde_json::to_vec_pretty(&value).map_err(json_error)?;
    bytes.push(b'\n');
    if bytes.len() as u64 > FILE_LIMIT {
        return Err(Error::too_large(format!(
            "the project would be larger than {} MiB and could not be opened again: shorten the notes",
            FILE_LIMIT >> 20
        )));
    }
    Ok(bytes)
}

/// As [`encode`], as a part of other JSON.
pub(super) fn encode_value(project: &Project, unknown: &Unknown, folder: Option<&Path>) -> Result<Value> {
    let mut value = json(&ProjectForm::new(project, folder)?)?;
    unknown.put_into(&mut value);
    Ok(value)
}

fn json(form: &ProjectForm) -> Result<Value> {
    serde_json::to_value(form).map_err(json_error)
}

impl ProjectForm {
    fn deserialize_value(value: &Value) -> Result<Self> {
        serde::Deserialize::deserialize(value).map_err(json_error)
    }
}

/// What is wrong with the JSON, and where.
pub(super) fn json_error(error: serde_json::Error) -> Error {
    let message = error.to_string();
    // The place is said by ours; serde_json says it again at the end of its message.
    let what = message.rsplit_once(" at line ").map_or(message.as_str(), |(what, _)| what);
    let told = Error::malformed(format!("not a project: {what}"));
    match error.line() {
        // It came from no text.
        0 => told,
        line => told.at(Place::LineColumn(line as u64, error.column() as u64)),
    }
}
