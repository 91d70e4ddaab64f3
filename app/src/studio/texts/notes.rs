//! The pane of notes.

pub(crate) const NAME: &str = "Notes";
pub(crate) const HINT: &str = "Orders, widths, who to ask: kept with the project";
pub(crate) const FIELD: &str = "Notes on the project";
