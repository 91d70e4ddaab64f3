//! The viewport's words.

/// The canvas' accessible name.
pub(super) const NAME: &str = "Garment";
/// Its accessible description.
pub(super) const DESCRIPTION: &str = "The garment in its fabrics. Arrow keys turn it, plus and minus zoom, 1 to 6 show \
     it from the front, back, left, right, top and bottom, F frames what is selected.";
/// The divider of a split view.
pub(super) const DIVIDER: &str = "Divider of the two looks";
/// Nothing to draw.
pub(super) const EMPTY: &str = "No garment is open";

/// What each gesture does: for tooltips and the help.
pub const GESTURES: &[(&str, &str)] = &[
    ("Drag", "turn the garment"),
    ("Middle drag, Shift + drag", "move it"),
    ("Ctrl or Alt + drag", "roll it about the line of sight"),
    ("Wheel, pinch", "zoom about the pointer"),
    ("Click", "select a panel; with Ctrl or Shift, add it or take it away"),
    ("Double click", "frame a panel, or beside the garment all of it"),
    ("Right drag, B + drag", "select the panels seen in a box; with Ctrl or Shift, add them"),
    ("One finger, two fingers", "turn; move and zoom"),
    ("Arrow keys", "turn by 15 degrees"),
    ("+ and -", "zoom"),
    ("1 2 3 4 5 6", "from the front, back, left, right, top, bottom"),
    ("F", "frame what is selected, or all"),
];
