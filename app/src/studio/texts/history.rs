//! The pane of the steps done.

pub(crate) const NAME: &str = "History";
pub(crate) const BEGINNING: &str = "The beginning";
