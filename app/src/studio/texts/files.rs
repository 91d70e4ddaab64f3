//! Files that are opened, missed and found again.

use std::fmt::Display;

pub(crate) const SAVED_AFTER: &str = "The file was saved after it: it probably holds this work already.";

pub(crate) const HAS_NO_PANEL_FOR: &str = "It has no panels to wear this:";
pub(crate) const COMES_BACK: &str =
    "It stays in the project, and is worn again by a garment that has these panels.";
pub(crate) const OPEN_ANYWAY: &str = "Open anyway";
pub(crate) const ITS_FABRIC: &str = "its fabric";

/// Asks before another garment is opened.
pub(crate) fn other_garment(name: &str) -> String {
    format!("Open {name}?")
}

/// Asks for a missing file.
pub(crate) fn where_is(file: impl Display) -> String {
    format!("Where is {file}?")
}

/// A place that was looked at.
pub(crate) fn not_at(place: impl Display) -> String {
    format!("not at {place}")
}

/// What a file's name must end in.
pub(crate) fn ends_in(suffixes: &str) -> String {
    format!("A file that ends in {suffixes}")
}

/// Nothing takes a file in.
pub(crate) fn nothing_opens(name: &str) -> String {
    format!(
        "nothing here opens '{name}': projects end in .amcproj, garments in .glb, .gltf or .obj, fabrics in .amc.ktx2"
    )
}

/// A garment that nobody could wear.
pub(crate) fn unlikely_size(metres: f64) -> String {
    format!(
        "the garment is {metres:.2} m large: if its file counts in another unit, say so in the pane 'Panel', where no panel is selected"
    )
}
