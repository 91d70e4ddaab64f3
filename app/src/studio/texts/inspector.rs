//! The pane of the selected panels.

pub(crate) const SWAP: &str = "Swap warp and weft";
pub(crate) const SWAP_TIP: &str =
    "Turns the direction of the selected panels (of all, where none is) by 90 degrees";
pub(crate) const BIAS: &str = "Turn to the bias";
pub(crate) const BIAS_TIP: &str =
    "Turns the direction of the selected panels (of all, where none is) by 45 degrees";
pub(crate) const GRAIN: &str = "Back to the grain";
pub(crate) const GRAIN_TIP: &str = "The selected panels (all, where none is) are cut along their grain again";
pub(crate) const NAME: &str = "Direction";
pub(crate) const PANE: &str = "Panel";
pub(crate) const ALL: &str = "All panels";
pub(crate) const CLICK: &str = "Click a panel in the view or in the list to change it alone.";
pub(crate) const UNIT: &str = "Unit of the file";
pub(crate) const UNIT_TIP: &str = "What the numbers in it mean";
pub(crate) const AREA: &str = "Area";
pub(crate) const TRIANGLES: &str = "Triangles";
pub(crate) const GRAIN_FACT: &str = "Grain";
pub(crate) const MIRROR: &str = "Mirror";
pub(crate) const SEVERAL: &str = "several";
pub(crate) const FABRIC: &str = "Fabric";
pub(crate) const FABRIC_TIP: &str = "What the panels are made of";
pub(crate) const ANGLE_TIP: &str =
    "Counter-clockwise in the flat pattern, from the right as drawn with v up; drag or type";
pub(crate) const GRADIENT: &str = "Gradient";
pub(crate) const GRADIENT_TIP: &str = "Across the lines of equal u: the paper's direction";
pub(crate) const YARN: &str = "Yarn";
pub(crate) const YARN_TIP: &str = "Where the yarn really goes on sheared cloth";

/// So many panels are selected.
pub(crate) fn panels(count: usize) -> String {
    format!("{count} panels")
}

/// An area, given in square metres.
pub(crate) fn area(square_metres: f32) -> String {
    format!("{:.0} cm2", square_metres * 1e4)
}

/// An angle, given in radians.
pub(crate) fn degrees(radians: f32) -> String {
    format!("{:.1} degrees", radians.to_degrees())
}
