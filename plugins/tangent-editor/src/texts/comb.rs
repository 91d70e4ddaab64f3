//! The words of the comb.

pub(crate) const TOOL: &str = "Comb the direction";
pub(crate) const TOOL_TIP: &str = "Drag on the garment or on its flat pattern to draw strokes that the warp follows; drag a stroke to move it";
pub(crate) const DELETE_COMMAND: &str = "Delete the chosen stroke";
pub(crate) const EDGE: &str = "Comb along the picked edge";
pub(crate) const EDGE_TIP: &str =
    "Draws a stroke along the edge, or between the two points, that were picked";
pub(crate) const DRAW: &str = "Draw strokes";
pub(crate) const DRAW_TIP: &str = "Drag on the garment or on its flat pattern: the warp follows. Drag a stroke to move it, its ends to turn it";
pub(crate) const NEW: &str = "New strokes";
pub(crate) const ONE_PANEL: &str = "Select one panel to see its strokes.";
pub(crate) const FULL: &str = "The panel has as many strokes as it can: delete some.";
pub(crate) const ON_TIP: &str = "Whether the stroke counts";
pub(crate) const DELETE: &str = "Delete";
pub(crate) const DELETE_TIP: &str = "Deletes the stroke";
pub(crate) const UNPLACED: &str = "says nothing";
pub(crate) const UNPLACED_TIP: &str = "The stroke has no length, or lies off the panel";
pub(crate) const EXACT: &str = "Exact";
pub(crate) const EXACT_TIP: &str = "Wherever the stroke goes the warp has its direction";
pub(crate) const SOFT: &str = "Soft";
pub(crate) const SOFT_TIP: &str = "The warp leans towards the stroke, the more so the greater its weight";
pub(crate) const WEIGHT: &str = "Weight";
pub(crate) const WEIGHT_TIP: &str = "How strongly the stroke pulls";
pub(crate) const RADIUS: &str = "Radius";
pub(crate) const RADIUS_TIP: &str = "How far to its sides the stroke is felt";
pub(crate) const REVERSE: &str = "Reverse";
pub(crate) const REVERSE_TIP: &str = "The stroke runs the other way: for cloth with a nap";
pub(crate) const ELSEWHERE: &str = "Elsewhere";
pub(crate) const ELSEWHERE_TIP: &str = "What the warp follows away from the strokes";
pub(crate) const OWN: &str = "The panel's own grain";
pub(crate) const SMOOTH: &str = "The strokes alone, smoothly";
pub(crate) const BOUNDARY: &str = "Along the edge of the panel";
pub(crate) const RADIAL: &str = "Away from a point";
pub(crate) const CIRCULAR: &str = "Round a point";
pub(crate) const ALONG_X: &str = "From the wearer's right to the left";
pub(crate) const ALONG_Y: &str = "Up";
pub(crate) const ALONG_Z: &str = "To the front";
pub(crate) const AROUND_Y: &str = "Round the upright through the panel's middle";
pub(crate) const OTHER: &str = "As the file says";
pub(crate) const CENTRE: &str = "Drag the point on the flat pattern while you draw strokes.";
pub(crate) const REACH: &str = "Falloff";
pub(crate) const REACH_TIP: &str =
    "Over how far the warp turns from the strokes to what it follows elsewhere";
pub(crate) const ALONG: &str = "Along the strokes";
pub(crate) const WARP: &str = "Warp";
pub(crate) const WEFT: &str = "Weft";
pub(crate) const ALONG_TIP: &str = "Which of the yarns runs along the strokes";
pub(crate) const REMOVE: &str = "Remove the comb";
pub(crate) const REMOVE_TIP: &str = "The panel has its own direction everywhere again";
pub(crate) const SINGULAR_TIP: &str =
    "Where the field has no direction: discs turn with the way round them, diamonds against it";

// For the history.
pub(crate) const DRAWN: &str = "Draw a stroke";
pub(crate) const MOVED: &str = "Move a stroke";
pub(crate) const MOVED_CENTRE: &str = "Move the centre of a direction";
pub(crate) const DELETED: &str = "Delete a stroke";
pub(crate) const SWITCHED_ON: &str = "Switch a stroke on";
pub(crate) const SWITCHED_OFF: &str = "Switch a stroke off";
pub(crate) const FOLLOWED: &str = "Change how a stroke is followed";
pub(crate) const REVERSED: &str = "Reverse a stroke";
pub(crate) const ELSEWHERE_CHANGED: &str = "Change the direction beside the strokes";
pub(crate) const REACH_CHANGED: &str = "Change the falloff of strokes";
pub(crate) const TURNED: &str = "Lay the other yarn along the strokes";
pub(crate) const REMOVED: &str = "Remove the comb";

/// A stroke by its number.
pub(crate) fn stroke(number: usize) -> String {
    format!("Stroke {number}")
}

/// The tick of a stroke, for who cannot see it.
pub(crate) fn on(stroke: &str) -> String {
    format!("{stroke} counts")
}

/// The button that deletes a stroke, for who cannot see it.
pub(crate) fn delete(stroke: &str) -> String {
    format!("Delete {stroke}")
}

/// So many singular points.
pub(crate) fn singular(count: usize) -> String {
    match count {
        0 => "No singular points".to_owned(),
        1 => "1 singular point".to_owned(),
        count => format!("{count} singular points"),
    }
}
