//! The pane of exports.

use std::fmt::Display;

pub(crate) const PICTURE: &str = "Picture";
pub(crate) const PICTURE_TIP: &str = "The view as it is";
pub(crate) const VIEWS: &str = "Contact sheet";
pub(crate) const VIEWS_TIP: &str = "The garment from several sides, in one picture";
pub(crate) const TURN: &str = "Turn";
pub(crate) const TURN_TIP: &str = "One turn about the garment's vertical axis, as GIF or animated PNG";
pub(crate) const SMOOTH: &str = "Smooth edges";
pub(crate) const SMOOTH_TIP: &str = "Four samples per pixel in place of one";
pub(crate) const BUTTON: &str = "Export ...";
pub(crate) const BUTTON_TIP: &str = "Asks where to save it; the work goes on meanwhile";
pub(crate) const CANCEL: &str = "Cancel";
pub(crate) const SIZE: &str = "Size";
pub(crate) const VIEW_SIZE: &str = "Size of a view";
pub(crate) const FRAME_SIZE: &str = "Size of a frame";
pub(crate) const OTHER: &str = "Other";
pub(crate) const WIDTH: &str = "Width";
pub(crate) const HEIGHT: &str = "Height";
pub(crate) const AS_VIEW: &str = "As in the view";
pub(crate) const AS_VIEW_TIP: &str = "Transparent where the view has no background of its own";
pub(crate) const TRANSPARENT: &str = "Transparent";
pub(crate) const TRANSPARENT_TIP: &str = "In a GIF pixels are clear or covered, nothing between";
pub(crate) const COLOUR: &str = "A colour";
pub(crate) const COLOUR_TIP: &str = "The same colour everywhere";
pub(crate) const BACKGROUND: &str = "Background";
pub(crate) const FRAMES: &str = "Frames";
pub(crate) const FRAMES_TIP: &str = "How many pictures the turn is made of";
pub(crate) const PER_SECOND: &str = "Frames per second";
pub(crate) const TAKES: &str = "Takes";
pub(crate) const HD: &str = "HD, 1920 x 1080";
pub(crate) const FOUR_K: &str = "4K, 3840 x 2160";
pub(crate) const A4: &str = "A4 upright, 300 dpi";
pub(crate) const A3: &str = "A3 upright, 300 dpi";
pub(crate) const A1: &str = "A1 upright, 300 dpi";
pub(crate) const NAME: &str = "Export";
pub(crate) const PICTURES: &str = "Pictures";
pub(crate) const ANIMATIONS: &str = "Animations";
pub(crate) const EXPORT_PICTURE: &str = "Export picture ...";
pub(crate) const EXPORT_PICTURE_TIP: &str =
    "Saves the view as PNG or OpenEXR, in the size of the Export pane";
pub(crate) const EXPORT_VIEWS: &str = "Export contact sheet ...";
pub(crate) const EXPORT_VIEWS_TIP: &str = "Saves the garment from several sides in one picture";
pub(crate) const EXPORT_TURN: &str = "Export turn ...";
pub(crate) const EXPORT_TURN_TIP: &str = "Saves one turn of the garment as GIF or animated PNG";
pub(crate) const SAVE_PICTURE: &str = "Save the picture";
pub(crate) const SAVE_VIEWS: &str = "Save the contact sheet";
pub(crate) const SAVE_TURN: &str = "Save the turn";
pub(crate) const NO_GARMENT: &str = "there is no garment to export: open one first";
pub(crate) const FRONT: &str = "Front";
pub(crate) const RIGHT: &str = "Right";
pub(crate) const BACK: &str = "Back";
pub(crate) const LEFT: &str = "Left";
pub(crate) const TOP: &str = "Top";
pub(crate) const BOTTOM: &str = "Bottom";

/// What a button stops.
pub(crate) fn stops(job: impl Display) -> String {
    format!("Stops '{job}'; nothing is left of it")
}

/// The job of an export.
pub(crate) fn exporting(file: impl Display) -> String {
    format!("Exporting {file}")
}

/// It is done.
pub(crate) fn exported(file: impl Display) -> String {
    format!("exported: {file}")
}

/// It was called off.
pub(crate) fn cancelled(file: impl Display) -> String {
    format!("the export was cancelled: {file}")
}
