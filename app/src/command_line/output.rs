//! What commands print: sentences for people, or one JSON value for programs.

use std::io::Write as _;

use amc_core::{Error, Result};

/// Where results go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Output {
    json: bool,
}

impl Output {
    pub(super) fn new(json: bool) -> Self {
        Self { json }
    }

    /// Prints `value` as JSON where that was asked for, else `text`.
    pub(super) fn result(&self, value: &impl serde::Serialize, text: impl FnOnce() -> String) -> Result<()> {
        let printed = if self.json {
            serde_json::to_string_pretty(value)
                .map_err(|error| Error::invalid("the result cannot be written as JSON").because(error))?
        } else {
            text()
        };
        match writeln!(std::io::stdout(), "{}", printed.trim_end()) {
            // The reader closed its end (`| head`): that is its right.
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
            written => written.map_err(|error| Error::io("cannot write the result", error)),
        }
    }

    /// Prints, as one line of JSON, that something has happened so long after the start.
    #[cfg(feature = "window")]
    pub(super) fn milestone(self, name: &str, after: std::time::Duration) {
        let line = serde_json::json!({ "shown": name, "seconds": after.as_secs_f64() });
        // Nobody may be listening any more; the window goes on.
        writeln!(std::io::stdout(), "{line}").ok();
    }

    /// Tells a person something worth knowing that is no failure.
    pub(super) fn notice(&self, text: &str) {
        // A notice that cannot be shown must not fail the work.
        writeln!(std::io::stderr(), "note: {text}").ok();
    }
}
