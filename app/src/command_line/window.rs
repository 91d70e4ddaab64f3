//! Without a command: the window. Without a display or a graphics adapter: a picture in its place.

use std::path::PathBuf;

use amc_core::Error;

use super::output::Output;
use super::{Failure, Outcome, demo};

pub(super) fn run(files: Vec<PathBuf>, timings: bool, output: &Output) -> Outcome {
    // A word that is no file was most likely meant as a command.
    if let Some(word) = files.iter().find(|file| file.extension().is_none() && !file.exists()) {
        let what = format!("there is no command and no file called '{}'; see --help", word.display());
        return Err(Failure::Usage(what));
    }
    let is_bare = files.is_empty();
    let why = match open(files, timings, output) {
        Ok(()) => return Ok(()),
        Err(Closed::Failed(error)) => return Err(error.into()),
        Err(Closed::NotOpened(why)) => why,
    };
    if is_bare {
        return demo::run(&why.to_string(), output);
    }
    let what = format!("no window can be opened: {why}; commands such as 'render' need none");
    Err(Error::device(what).because(why).into())
}

/// Why there is no window, or no longer.
#[cfg_attr(not(feature = "window"), expect(dead_code, reason = "a window that never opens never closes"))]
enum Closed {
    /// It could not be opened.
    NotOpened(Error),
    /// It was open.
    Failed(Error),
}

#[cfg(not(feature = "window"))]
fn open(_: Vec<PathBuf>, _: bool, _: &Output) -> Result<(), Closed> {
    Err(Closed::NotOpened(Error::device("this program is built without it")))
}

#[cfg(feature = "window")]
fn open(files: Vec<PathBuf>, timings: bool, output: &Output) -> Result<(), Closed> {
    use crate::studio::{Ended, Studio};
    if !has_display() {
        return Err(Closed::NotOpened(Error::device("neither DISPLAY nor WAYLAND_DISPLAY is set")));
    }
    let mut studio = Studio::new().open(files);
    if timings {
        let output = *output;
        let start = std::time::Instant::now();
        studio = studio.telling(move |milestone| output.milestone(milestone.name(), start.elapsed()));
    }
    studio.run_windows().map_err(|ended| match ended {
        Ended::NotOpened(error) => Closed::NotOpened(error),
        Ended::Lost(error) => Closed::Failed(error),
    })
}

/// Whether there is anything to open a window on. On systems other than these there always is.
#[cfg(feature = "window")]
fn has_display() -> bool {
    let named = |variable: &str| std::env::var_os(variable).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || named("DISPLAY") || named("WAYLAND_DISPLAY")
}
