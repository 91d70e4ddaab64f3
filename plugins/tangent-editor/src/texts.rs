//! The words of the editor.

pub(crate) mod comb;

use crate::seeing::{Binding, SHARES, Show, Square, Weave};

pub(crate) const NAME: &str = "Grain";
pub(crate) const PATTERN: &str = "Flat pattern";
pub(crate) const GRAIN: &str = "Grain";
pub(crate) const COMB: &str = "Comb";
pub(crate) const OPENING: &str = "The flat pattern is being laid out.";
pub(crate) const NO_UVS: &str =
    "The garment has no flat pattern (UVs). Give its panels a direction in the Panel pane.";
pub(crate) const FIT: &str = "Show the whole pattern";
pub(crate) const FIT_TIP: &str = "Brings all pieces of the flat pattern into its pane";
pub(crate) const FIT_BUTTON: &str = "Fit";
pub(crate) const SHORT_HELP: &str = "Drag an arrow to turn the grain.";
pub(crate) const HELP: &str = "Drag the tip of an arrow to turn the grain (Shift: by 15 degrees). Click an edge, or two points with Alt held, to pick what the grain can be laid along. Drag beside the pieces to move, scroll to zoom.";
pub(crate) const ALL: &str = "All panels";
pub(crate) const ANGLE: &str = "Warp";
pub(crate) const ANGLE_TIP: &str =
    "Counter-clockwise from the right of the flat piece; drag, or type a number or a sum like 90 - 12.5";
pub(crate) const DEGREES: &str = "\u{b0}";
pub(crate) const TURN_LEFT: &str = "Turn the grain by +90\u{b0}";
pub(crate) const TURN_RIGHT: &str = "Turn the grain by -90\u{b0}";
pub(crate) const TURN_AROUND: &str = "Turn the grain by 180\u{b0}";
pub(crate) const TURN_TIP: &str = "The selected panels (all, where none is)";
pub(crate) const LEFT_90: &str = "+90\u{b0}";
pub(crate) const RIGHT_90: &str = "-90\u{b0}";
pub(crate) const AROUND: &str = "180\u{b0}";
pub(crate) const NUDGE_LEFT: &str = "Nudge the grain by +1\u{b0}";
pub(crate) const NUDGE_RIGHT: &str = "Nudge the grain by -1\u{b0}";
pub(crate) const NUDGE_TIP: &str = "The selected panels (all, where none is)";
pub(crate) const PRESETS: &str = "Cut";
pub(crate) const WARP: &str = "Along the grain of the piece";
pub(crate) const WARP_SHORT: &str = "Straight";
pub(crate) const WEFT: &str = "Across the grain of the piece";
pub(crate) const WEFT_SHORT: &str = "Cross";
pub(crate) const BIAS_45: &str = "On the bias, 45\u{b0}";
pub(crate) const BIAS_45_SHORT: &str = "Bias 45\u{b0}";
pub(crate) const BIAS_135: &str = "On the bias, 135\u{b0}";
pub(crate) const BIAS_135_SHORT: &str = "Bias 135\u{b0}";
pub(crate) const PRESET_TIP: &str =
    "Counted from the grain that the garment's file names, or from upright in the flat pattern";
pub(crate) const ALIGN: &str = "Align to";
pub(crate) const EDGE: &str = "Align the grain to the picked edge or points";
pub(crate) const EDGE_SHORT: &str = "Picked edge";
pub(crate) const EDGE_TIP: &str = "Click an edge of a piece in the flat pattern first, or two points with Alt held; the panel that it belongs to is turned";
pub(crate) const NEXT_EDGE: &str = "Pick the next edge";
pub(crate) const NEXT_EDGE_TIP: &str = "Of the first selected panel, from edge to edge round its piece";
pub(crate) const PASTE_RELATIVE: &str = "Paste the grain relative to the piece";
pub(crate) const PASTE_RELATIVE_TIP: &str =
    "As far off the grain of each piece as the copied one is off its own";
pub(crate) const SHORT_PASTE_RELATIVE: &str = "Paste relative";
pub(crate) const LIE_LEFT: &str = "Turn the piece on the screen by +90\u{b0}";
pub(crate) const LIE_RIGHT: &str = "Turn the piece on the screen by -90\u{b0}";
pub(crate) const LIE_DRAWN: &str = "Lay the piece on the screen as it is drawn";
pub(crate) const LIE_TIP: &str = "How the flat piece lies on the screen; its grain stays as it is";
pub(crate) const LIE: &str = "On screen";
pub(crate) const SHORT_LIE_DRAWN: &str = "As drawn";
pub(crate) const UP: &str = "Align the grain to the wearer's up";
pub(crate) const UP_SHORT: &str = "Wearer's up";
pub(crate) const ACROSS: &str = "Align the grain to the wearer's right";
pub(crate) const ACROSS_SHORT: &str = "Wearer's right";
pub(crate) const FORWARD: &str = "Align the grain to the wearer's front";
pub(crate) const FORWARD_SHORT: &str = "Wearer's front";
pub(crate) const AXIS_TIP: &str = "As the panel hangs on the body, in the mean over its area";
pub(crate) const PARTNER: &str = "Align the grain to the seam partner";
pub(crate) const PARTNER_SHORT: &str = "Seam partner";
pub(crate) const PARTNER_TIP: &str = "The direction goes straight on across the longest seam";
pub(crate) const SPLIT: &str = "Split panel";
pub(crate) const SPLIT_BUTTON: &str = "Split";
pub(crate) const SPLIT_TIP: &str = "Drag a line across a piece of the flat pattern, or across a panel of the garment: it is cut in two there";
pub(crate) const SPLIT_PICKED: &str = "Cut panel in two along the picked line";
pub(crate) const SPLIT_PICKED_TIP: &str =
    "Pick two points of a piece in the flat pattern first, or an edge: it is cut straight through them";
pub(crate) const SPLIT_ALONG: &str = "Cut panel in two along the warp";
pub(crate) const SPLIT_ACROSS: &str = "Cut panel in two across the warp";
pub(crate) const SPLIT_ALONG_TIP: &str =
    "Cuts the selected panel in two, through the middle of its flat piece";
pub(crate) const NOT_ACROSS: &str = "The line crosses no piece that has a flat pattern.";
pub(crate) const PRINT_MOVES: &str = "A print is laid from the middle of its panel: those of the halves have moved. Undo brings back the whole.";
pub(crate) const ORIENTATION: &str = "Laying";
pub(crate) const ORIENTATION_TIP: &str = "In which turns the piece may be laid on the cloth";
pub(crate) const TWO_WAY: &str = "two-way";
pub(crate) const ONE_WAY: &str = "one-way";
pub(crate) const NAP: &str = "with nap";
pub(crate) const SEVERAL: &str = "several";
pub(crate) const LOCK: &str = "Locked";
pub(crate) const LOCK_TIP: &str = "The direction of a locked panel stays as it is";
pub(crate) const LINK: &str = "The mirror partner follows";
pub(crate) const LINK_TIP: &str = "What turns this panel turns its mirror image the other way";
pub(crate) const COPY: &str = "Copy the grain";
pub(crate) const COPY_TIP: &str = "Of the first selected panel";
pub(crate) const PASTE: &str = "Paste the grain";
pub(crate) const PASTE_TIP: &str = "On the selected panels (on all, where none is)";
pub(crate) const PASTE_MIRRORED: &str = "Paste the grain mirrored";
pub(crate) const MIRROR: &str = "Mirror the grain to the partner";
pub(crate) const MIRROR_TIP: &str = "Gives the mirror partners of the selected panels the mirrored direction";
pub(crate) const RESET: &str = "Reset the grain";
pub(crate) const RESET_TIP: &str = "The panels are cut along their grain again";
pub(crate) const SHORT_COPY: &str = "Copy";
pub(crate) const SHORT_PASTE: &str = "Paste";
pub(crate) const SHORT_PASTE_MIRRORED: &str = "Paste mirrored";
pub(crate) const SHORT_MIRROR: &str = "Mirror to partner";
pub(crate) const SHORT_RESET: &str = "Reset";
pub(crate) const NO_PARTNER: &str = "None of these panels has a mirror partner.";
pub(crate) const NOT_ALIGNED: &str =
    "There is nothing to align to: the panel has no flat pattern, no such seam, or lies square to that axis.";

pub(crate) const NO_FABRIC: &str = "-";
pub(crate) const SAVE: &str = "Save the tech sheet ...";
pub(crate) const SAVE_TIP: &str =
    "The flat pattern to scale, with grain, fabric and laying: SVG or PDF to read, DXF for pattern programs";
pub(crate) const SAVE_TITLE: &str = "Save the tech sheet";
pub(crate) const SVG: &str = "Drawings";
pub(crate) const PDF: &str = "Documents";
pub(crate) const DXF: &str = "Patterns (AAMA)";

/// The tech sheet is being written.
pub(crate) fn saving(file: impl std::fmt::Display) -> String {
    format!("Saving {file}")
}

/// The tech sheet is written.
pub(crate) fn saved(file: impl std::fmt::Display) -> String {
    format!("Saved {file}")
}

/// Over the table of a tech sheet.
pub(crate) const COLUMNS: [&str; 5] = ["", "Piece", "Warp", "Fabric", "Laying"];

/// An angle on a tech sheet.
pub(crate) fn degrees(degrees: f32) -> String {
    format!("{degrees:.1}\u{b0}")
}

/// Beside the title of a sheet.
pub(crate) fn scale(scale: f32) -> String {
    format!("Scale 1:{scale}")
}

/// Beside the bar of the scale.
pub(crate) fn centimetres(length: f32) -> String {
    format!("{length} cm")
}

pub(crate) const IMPORT: &str = "Import directions ...";
pub(crate) const IMPORT_TIP: &str =
    "From a JSON, a DXF (the grain lines of its pieces) or a GLB with anisotropy";
pub(crate) const IMPORT_TITLE: &str = "Import directions";
pub(crate) const DIRECTIONS: &str = "Directions";
pub(crate) const APPLY: &str = "Apply";
pub(crate) const CANCEL: &str = "Cancel";
pub(crate) const EXPORT: &str = "Export directions ...";
pub(crate) const EXPORT_TIP: &str =
    "As GLB (tangents, turned UVs, anisotropy, yarns), OBJ (turned UVs) or JSON (all panels)";
pub(crate) const EXPORT_TITLE: &str = "Export directions";
pub(crate) const GLB: &str = "glTF binaries";
pub(crate) const OBJ: &str = "Wavefront OBJ";
pub(crate) const JSON: &str = "Lists of panels";

pub(crate) const ANOTHER_GARMENT: &str =
    "Another garment has come meanwhile: the directions were not imported.";

/// A file of directions is being read.
pub(crate) fn reading(file: impl std::fmt::Display) -> String {
    format!("Reading {file}")
}

/// What a file of directions is for, before it is applied.
pub(crate) fn reaches(file: &str, count: usize) -> String {
    format!("{file} says something of {}.", panels(count))
}

/// For the history.
pub(crate) fn imported(count: usize) -> String {
    format!("Import directions of {}", panels(count))
}

/// Locked panels of an import.
pub(crate) fn kept_locked(names: &str) -> String {
    format!("locked, so the direction stays: {names}")
}

/// Panels of an import that strokes comb.
pub(crate) fn kept_strokes(names: &str) -> String {
    format!("strokes comb these, and stay over the direction: {names}")
}

/// Fabrics of an import.
pub(crate) fn no_such_fabrics(names: &str) -> String {
    format!("the project has no fabrics of these names: {names}")
}

pub(crate) const WARNINGS: &str = "Look at";

/// A panel has no UVs.
pub(crate) fn no_uvs(name: &str) -> String {
    format!("{name} has no flat pattern (UVs): its direction is made up")
}

/// Some triangles of a panel have no UVs.
pub(crate) fn degenerate(name: &str) -> String {
    format!("{name}: UVs are missing in places; directions there are taken from around")
}

/// A panel's UVs are mirrored.
pub(crate) fn mirrored(name: &str) -> String {
    format!("{name}: the UVs are mirrored, so the piece is drawn from its back")
}

/// Mirror partners are cut differently.
pub(crate) fn partners_differ(one: &str, other: &str, degrees: f32) -> String {
    format!("{one} and {other} are mirror images, but their grains differ by {degrees:.1}\u{b0}")
}

/// What a piece of the flat pattern is called for who cannot see it.
pub(crate) fn piece(name: &str, degrees: f32) -> String {
    format!("Piece {name}, warp at {degrees:.1} degrees")
}

/// What the tip of a piece's arrow is called.
pub(crate) fn arrow(name: &str) -> String {
    format!("Grain of {name}")
}

/// So many panels are selected.
pub(crate) fn panels(count: usize) -> String {
    if count == 1 { "1 panel".to_owned() } else { format!("{count} panels") }
}

/// So many panels could not be turned.
pub(crate) fn locked(count: usize) -> String {
    format!(
        "{} locked: the direction stays as it is",
        if count == 1 { "1 panel is".to_owned() } else { format!("{count} panels are") }
    )
}

/// Why a panel cannot be split.
pub(crate) fn not_split(panel: &str, why: impl std::fmt::Display) -> String {
    format!("{panel} was not split: {why}")
}

/// For the history.
pub(crate) fn laid(count: usize, orientation: &str) -> String {
    format!("Lay {} {orientation}", panels(count))
}

/// For the history.
pub(crate) fn lying(count: usize) -> String {
    format!("Turn {} on the screen", panels(count))
}

/// For the history.
pub(crate) fn locking(count: usize, lock: bool) -> String {
    format!("{} {}", if lock { "Lock" } else { "Unlock" }, panels(count))
}

/// For the history.
pub(crate) fn linking(count: usize, link: bool) -> String {
    format!("{} the mirror partners of {}", if link { "Link" } else { "Part" }, panels(count))
}

/// The panel's mirror image.
pub(crate) fn partner(name: &str) -> String {
    format!("Mirror partner: {name}")
}

// What is seen over the cloth.

pub(crate) const SHOW: &str = "Show";
pub(crate) const SHOW_TIP: &str =
    "Over the cloth, on the pattern and on the garment; a way of looking, no part of the project";
pub(crate) const NOTHING: &str = "Nothing";
pub(crate) const DRAWING_CLOTH: &str = "Drawing over the cloth";
pub(crate) const NOTHING_TO_SHOW: &str = "The garment has no flat pattern (UVs): nothing can be shown over its cloth. Choose the shading Directions instead.";
pub(crate) const SHOW_TOGGLE: &str = "Show over the cloth, or hide";
pub(crate) const SHOW_NOTHING: &str = "Show nothing over the cloth";
pub(crate) const SHOW_ARROWS: &str = "Show arrows along the warp";
pub(crate) const SHOW_STREAMLINES: &str = "Show streamlines along the warp";
pub(crate) const SHOW_LINES: &str = "Show fine lines along the warp (LIC)";
pub(crate) const SHOW_WEAVE: &str = "Show the weave";
pub(crate) const SHOW_CHECKER: &str = "Show a checker of true size (UVs)";
pub(crate) const SHOW_WARP_STRETCH: &str = "Show stretch along the warp";
pub(crate) const SHOW_WEFT_STRETCH: &str = "Show stretch along the weft";
pub(crate) const SHOW_SHEAR: &str = "Show shear: warp against weft";
pub(crate) const SHOW_GRADIENT_YARN: &str = "Show gradient against yarn";
pub(crate) const BINDING: &str = "Weave";
pub(crate) const ENDS: &str = "Ends";
pub(crate) const ENDS_TIP: &str = "Warp threads to the centimetre";
pub(crate) const PICKS: &str = "Picks";
pub(crate) const PICKS_TIP: &str = "Weft threads to the centimetre";
pub(crate) const PER_CM: &str = "/cm";
pub(crate) const ENLARGEMENT: &str = "Drawn";
pub(crate) const SQUARE: &str = "Squares";
pub(crate) const MEASURED_LENGTHS: &str =
    "Against the mean of each panel: the file does not say how long its flat pattern is";

/// What is shown.
pub(crate) fn show(show: Show) -> &'static str {
    match show {
        Show::Arrows => "Arrows",
        Show::Streamlines => "Streamlines",
        Show::Lines => "Fine lines (LIC)",
        Show::Weave => "Threads",
        Show::Checker => "Checker",
        Show::WarpStretch => "Stretch, warp",
        Show::WeftStretch => "Stretch, weft",
        Show::Shear => "Shear",
        Show::GradientAgainstYarn => "Gradient against yarn",
    }
}

/// How threads cross.
pub(crate) fn binding(binding: Binding) -> &'static str {
    match binding {
        Binding::Plain => "plain",
        Binding::Twill => "twill 2/2",
        Binding::Satin => "satin 8",
    }
}

/// The side of a square.
pub(crate) fn square(square: Square) -> &'static str {
    match square {
        Square::Centimetre => "1 cm",
        Square::Inch => "1 inch",
    }
}

/// So many times larger.
pub(crate) fn times(enlargement: f32) -> String {
    if enlargement > 1.0 { format!("{enlargement:.0} times larger") } else { "true to size".to_owned() }
}

/// In a legend.
pub(crate) fn squares(square: Square) -> String {
    format!("Squares of {}, lines every ten; letters are mirrored where the UVs are", self::square(square))
}

/// In a legend.
pub(crate) fn weave(weave: &Weave) -> String {
    let Weave { binding, ends, picks, enlargement } = weave;
    format!(
        "{}, {ends:.1} ends and {picks:.1} picks to the cm, {}",
        self::binding(*binding),
        times(*enlargement)
    )
}

/// In a legend.
pub(crate) fn drawn_larger(enlargement: f32) -> String {
    format!("Where the direction varies: in patches, up to {enlargement:.0} times larger")
}

/// In a legend.
pub(crate) fn without_pattern(panels: usize) -> String {
    format!("Nothing on {}: no flat pattern (UVs)", self::panels(panels))
}

/// What a heat map's values are.
pub(crate) fn unit(show: Show) -> &'static str {
    match show {
        Show::Shear => "warp against weft, degrees",
        Show::GradientAgainstYarn => "degrees",
        _ => "per cent of its length",
    }
}

/// A value of a heat map.
pub(crate) fn value(show: Show, value: f32) -> String {
    // No minus before zero.
    let value = if value.abs() < 0.05 { 0.0 } else { value };
    match show {
        Show::Shear | Show::GradientAgainstYarn => format!("{value:.1}\u{b0}"),
        _ => format!("{value:+.1} %"),
    }
}

/// Over percentiles; of so many selected panels, 0: of all.
pub(crate) fn percentiles_of(selected: usize) -> String {
    if selected == 0 {
        "Of the area of all panels".to_owned()
    } else {
        format!("Of the area of {}", panels(selected))
    }
}

/// Percentiles of a heat map.
pub(crate) fn percentiles(show: Show, values: [f32; 5]) -> String {
    let told = SHARES.iter().zip(values).map(|(share, it)| format!("{share} %: {}", value(show, it)));
    told.collect::<Vec<_>>().join("   ")
}
