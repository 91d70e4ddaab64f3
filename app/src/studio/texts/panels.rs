//! The pane of panels.

pub(crate) const HIDE: &str = "Hide selected panels";
pub(crate) const HIDE_TIP: &str = "They are not drawn until they are shown again";
pub(crate) const ISOLATE: &str = "Hide all others";
pub(crate) const ISOLATE_TIP: &str = "Only the selected panels are drawn";
pub(crate) const SHOW_ALL: &str = "Show all panels";
pub(crate) const SHOW_ALL_TIP: &str = "Panels that were hidden are drawn again";
pub(crate) const NAME: &str = "Panels";
pub(crate) const SHOWN_TIP: &str = "Shown in the view";
pub(crate) const MIRRORED_AND_DEGENERATE: &str =
    "Its UVs are mirrored, and some of it has none: directions there are filled from the neighbours";
pub(crate) const MIRRORED: &str = "Its UVs are mirrored";
pub(crate) const DEGENERATE: &str = "Some of it has no UVs: directions there are filled from the neighbours";
pub(crate) const REGULAR: &str = "Its UVs are as they should be";

/// A part of the file, with so many panels.
pub(crate) fn part(name: &str, panels: usize) -> String {
    format!("{name} ({panels})")
}

/// What a check box shows.
pub(crate) fn show(panel: &str) -> String {
    format!("Show {panel}")
}
