//! The panes of jobs and of notices.

pub(crate) const NAME: &str = "Activity";
pub(crate) const JOBS: &str = "Jobs";
pub(crate) const LOG: &str = "Log";
pub(crate) const NO_JOBS: &str = "Nothing is running.";
pub(crate) const CANCEL: &str = "Cancel";
pub(crate) const NO_NOTICES: &str = "Nothing has happened yet.";

/// What a button stops.
pub(crate) fn stops(job: &str) -> String {
    format!("Stops '{job}'")
}
