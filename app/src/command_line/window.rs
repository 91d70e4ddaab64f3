//! Without a command: the window. Without a display: a picture in its place.

use std::path::PathBuf;

use super::output::Output;
use super::{Failure, Outcome, demo};
use crate::studio::Studio;

pub(super) fn run(files: Vec<PathBuf>, output: &Output) -> Outcome {
    // A word that is no file was most likely meant as a command.
    if let Some(word) = files.iter().find(|file| file.extension().is_none() && !file.exists()) {
        let what = format!("there is no command and no file called '{}'; see --help", word.display());
        return Err(Failure::Usage(what));
    }
    if has_display() {
        return Ok(Studio::new().open(files).run()?);
    }
    if files.is_empty() {
        return demo::run(output);
    }
    let what = "no window can be opened: neither DISPLAY nor WAYLAND_DISPLAY is set; commands such as 'render' need none";
    Err(amc_core::Error::device(what).into())
}

/// Whether there is anything to open a window on. On systems other than these there always is.
fn has_display() -> bool {
    let named = |variable: &str| std::env::var_os(variable).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || named("DISPLAY") || named("WAYLAND_DISPLAY")
}
