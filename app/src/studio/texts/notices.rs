//! Jobs and notices.

use std::fmt::Display;

pub(crate) const NO_FOLDERS: &str = "the system names no folder for settings: unsaved work is not kept";
pub(crate) const TAKING_BACK: &str = "Taking the work back";
pub(crate) const TAKEN_BACK: &str = "the unsaved work is back; save it to keep it";

/// A job that opens something.
pub(crate) fn opening(what: impl Display) -> String {
    format!("Opening {what}")
}

/// The job that lays the directions.
pub(crate) const DIRECTIONS: &str = "Directions";

/// The job that reckons the occlusion.
pub(crate) fn shading(what: impl Display) -> String {
    format!("Shading the folds of {what}")
}

/// The job that saves.
pub(crate) fn saving(file: impl Display) -> String {
    format!("Saving {file}")
}

/// It is saved.
pub(crate) fn saved(file: impl Display) -> String {
    format!("saved: {file}")
}

/// The autosave cannot work.
pub(crate) fn not_kept(why: impl Display) -> String {
    format!("unsaved work is not kept: {why}")
}

/// The project's lock cannot be had.
pub(crate) fn not_told(why: impl Display) -> String {
    format!("another window would not be told: {why}")
}

/// Another window has the project too.
pub(crate) fn already_open(file: impl Display, process: Option<u32>) -> String {
    let who = process.map_or_else(String::new, |process| format!(" (process {process})"));
    format!(
        "{file} is open in another window{who}: whoever saves last wins; close one, or save this under another name"
    )
}
