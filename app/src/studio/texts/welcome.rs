//! The first steps.

pub(crate) const TURN: &str = "Turn it";
pub(crate) const TURN_TEXT: &str =
    "Drag the garment. The camera and the light stay; the gloss runs over the folds.";
pub(crate) const TURN_BUTTON: &str = "Let it turn";
pub(crate) const DRESS: &str = "Dress a panel";
pub(crate) const DRESS_TEXT: &str =
    "Click a sleeve or the collar, then a fabric. Drop your own files anywhere.";
pub(crate) const DRESS_BUTTON: &str = "Show the fabrics";
pub(crate) const DIRECT: &str = "Change its direction";
pub(crate) const DIRECT_TEXT: &str = "Press R: warp and weft change places. Ctrl+Z takes it back.";
pub(crate) const DIRECT_BUTTON: &str = "Swap them now";
