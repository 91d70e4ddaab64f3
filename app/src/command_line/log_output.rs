//! Warnings of the work, on standard error: what was made anew, what could not be kept.

use std::io::Write as _;

use log::{Level, LevelFilter, Log, Metadata, Record};

struct Warnings;

impl Log for Warnings {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        // What libraries log a person can do nothing about; what comes of it is in our own errors.
        metadata.target().starts_with("amc_") && metadata.level() <= Level::Warn
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            // A warning that cannot be shown must not fail the work.
            writeln!(std::io::stderr(), "warning: {}", record.args()).ok();
        }
    }

    fn flush(&self) {}
}

/// Shows warnings from here on. A program that has a logger of its own keeps it.
pub(super) fn show_warnings() {
    if log::set_logger(&Warnings).is_ok() {
        log::set_max_level(LevelFilter::Warn);
    }
}
