//! The pane of panels.

pub(crate) const HIDE: &str = "Hide selected panels";
pub(crate) const HIDE_TIP: &str = "They are not drawn until they are shown again";
pub(crate) const ISOLATE: &str = "Hide all others";
pub(crate) const ISOLATE_TIP: &str = "Only the selected panels are drawn";
pub(crate) const SHOW_ALL: &str = "Show all panels";
pub(crate) const SHOW_ALL_TIP: &str = "Panels that were hidden are drawn again";
pub(crate) const RENAME: &str = "Rename panel";
pub(crate) const RENAME_TIP: &str = "Gives the selected panel another name; an empty one is that of its file";
pub(crate) const NEW_NAME: &str = "Name of the panel";
pub(crate) const GROUP: &str = "Group panels";
pub(crate) const GROUP_TIP: &str =
    "Puts the selected panels under one name in the list, to be selected together";
pub(crate) const GROUP_NAME: &str = "Name of the group";
pub(crate) const GROUP_ANSWER: &str = "Group";
pub(crate) const GROUP_ROW_TIP: &str = "Selects all of the group";
pub(crate) const UNGROUP: &str = "Ungroup panels";
pub(crate) const UNGROUP_TIP: &str = "Takes the selected panels out of their groups";
pub(crate) const MERGE: &str = "Merge panels";
pub(crate) const MERGE_TIP: &str =
    "Makes one panel of those selected; it looks as the first of them in the list";
pub(crate) const MERGE_ANSWER: &str = "Merge";
pub(crate) const UNDO_BRINGS_BACK: &str = "Undo brings all of it back.";
pub(crate) const ITS_PRINT: &str = "its print";
pub(crate) const ITS_NAME: &str = "its name";
pub(crate) const ITS_COMB: &str = "what its direction follows away from strokes";
pub(crate) const HIDDEN: &str = "that it is hidden";
pub(crate) const SHOWN: &str = "that it is shown";
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

/// Before panels are merged.
pub(crate) fn merged(name: &str) -> String {
    format!("They become one panel that looks as '{name}' does. This cannot be kept:")
}

/// What is said of a panel, in a list.
pub(crate) fn of_panel(name: &str, parts: &[String]) -> String {
    format!("{name}: {}", parts.join(", "))
}

/// The print's place is counted from the middle of its panel.
pub(crate) fn print_moves(name: &str) -> String {
    format!("{name}: its print moves to the middle of what they become")
}

/// None: plain grey.
pub(crate) fn its_fabric(name: Option<&str>) -> String {
    format!("its fabric ({})", name.unwrap_or(super::NO_FABRIC))
}

/// Its own direction.
pub(crate) fn its_angle(degrees: f32) -> String {
    format!("its angle ({degrees:.1}\u{b0})")
}

/// Strokes that are not kept, of all of them.
pub(crate) fn its_strokes(lost: usize, all: usize) -> String {
    let strokes = if all == 1 { "stroke" } else { "strokes" };
    if lost == all { format!("its {all} {strokes}") } else { format!("{lost} of its {all} {strokes}") }
}
