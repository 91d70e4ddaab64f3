//! The pane of colourways.

pub(crate) const NAME: &str = "Colourways";
pub(crate) const HINT: &str =
    "What all panels wear, under a name. A click wears it; directions and strokes are the same in all.";
pub(crate) const NAME_FIELD: &str = "Name of the colourway";
pub(crate) const WEAR_TIP: &str = "Click: wear it. Twice: rename it";
pub(crate) const COMPARE: &str = "Compare";
pub(crate) const COMPARE_TIP: &str =
    "Shows it right of a divider, beside the worn one; again: the view is whole";
pub(crate) const ADD: &str = "New colourway";
pub(crate) const ADD_TIP: &str = "A copy of the worn one, to be changed";
pub(crate) const RENAME: &str = "Rename";
pub(crate) const RENAME_TIP: &str = "Another name for the worn one";
pub(crate) const REMOVE: &str = "Remove";
pub(crate) const REMOVE_TIP: &str = "Removes the worn one, and wears the next";
pub(crate) const NEXT: &str = "Next colourway";
pub(crate) const PREVIOUS: &str = "Previous colourway";
pub(crate) const STEP_TIP: &str = "Wears it; after the last comes the first";
pub(crate) const UP: &str = "Move the colourway up";
pub(crate) const DOWN: &str = "Move the colourway down";
pub(crate) const MOVE_TIP: &str = "Changes places with its neighbour in the list";

/// A colourway and the names of what is worn in it.
pub(crate) fn row(name: &str, fabrics: &[&str]) -> String {
    match fabrics {
        [] => name.to_owned(),
        fabrics => format!("{name}: {}", fabrics.join(", ")),
    }
}

/// What is compared.
pub(crate) fn compare(name: &str) -> String {
    format!("{COMPARE} with {name}")
}
