//! The pane of prints.

pub(crate) const NAME: &str = "Print";
pub(crate) const HINT: &str =
    "A picture on the cloth. It colours what the fabric gives back, and turns with the warp.";
pub(crate) const CHOOSE: &str = "Print a picture ...";
pub(crate) const CHOOSE_TIP: &str = "Prints a picture on the selected panels (on all, where none is)";
pub(crate) const OTHER: &str = "Another picture ...";
pub(crate) const REMOVE: &str = "Take the print off";
pub(crate) const REMOVE_TIP: &str = "The selected panels (all, where none is) show their fabric alone again";
pub(crate) const TITLE: &str = "Which picture?";
pub(crate) const PICTURES: &str = "Pictures";
pub(crate) const WIDTH: &str = "Width";
pub(crate) const WIDTH_TIP: &str = "How wide the picture is on the cloth";
pub(crate) const TURN: &str = "Turn";
pub(crate) const TURN_TIP: &str = "Counter-clockwise, from upright along the warp";
pub(crate) const ACROSS: &str = "Across";
pub(crate) const ACROSS_TIP: &str = "How far the picture is to the right of the panel's middle";
pub(crate) const UP: &str = "Up";
pub(crate) const UP_TIP: &str = "How far the picture is above the panel's middle";
pub(crate) const REPEAT: &str = "Repeat all over";
pub(crate) const REPEAT_TIP: &str = "Off: the picture is printed once";
pub(crate) const NO_UVS: &str =
    "This panel has no flat pattern (UVs) that a print could lie on: it shows its fabric alone.";
pub(crate) const NO_FABRIC: &str = "A print shows on a fabric only: give the panel one.";
pub(crate) const CENTIMETRES: &str = " cm";
pub(crate) const DEGREES: &str = "\u{b0}";

/// So many of the selected panels have another picture than the one that is shown, or none.
pub(crate) fn others(count: usize) -> String {
    if count == 1 {
        "1 panel has another print, or none.".to_owned()
    } else {
        format!("{count} panels have other prints, or none.")
    }
}
