//! What a pattern's names and pieces must be like.

use std::collections::BTreeSet;

use amc_core::{Error, Result};
use glam::{DVec2, DVec3};

use super::crossing::{Stroke, area, crossing, inside};
use super::{CLOSE, Cloth, Line, LineKind, Pattern, Placement, WholePiece};
use crate::body::Figure;

/// The most pieces, seams, lines of a piece, notches of a piece.
const MOST: usize = 200;
/// The most points of a piece, curves flattened.
const MOST_POINTS: usize = 20_000;
/// The least and the largest extent of a piece, metres.
const EXTENT: [f64; 2] = [0.005, 10.0];
/// The shortest edge, metres.
const SHORTEST: f64 = 0.001;
/// The longest name, bytes.
const LONGEST_NAME: usize = 80;

/// Refuses names that are missing, too long or there twice, and more of anything than a garment has.
pub(super) fn names(pattern: &Pattern) -> Result<()> {
    if pattern.pieces.is_empty() {
        return Err(Error::invalid("the pattern has no pieces"));
    }
    name(&pattern.name)?;
    unique("piece", pattern.pieces.iter().map(|piece| piece.name.as_str()))?;
    unique("seam", pattern.seams.iter().map(|seam| seam.name.as_str()))?;
    cloth(&pattern.cloth)?;
    for piece in &pattern.pieces {
        let named = |error: Error| error.at_element(format!("piece '{}'", piece.name));
        let counts = [
            piece.outline.len(),
            piece.lines.len(),
            piece.folds.len(),
            piece.notches.len(),
            piece.points.len(),
        ];
        at_most(counts.into_iter().max().unwrap_or_default(), "edges, lines or notches").map_err(named)?;
        if piece.name.contains(':') {
            return Err(named(Error::invalid("a piece's name has no colon")));
        }
        piece.cloth.as_ref().map_or(Ok(()), cloth).map_err(named)?;
    }
    Ok(())
}

fn at_most(count: usize, what: &str) -> Result<()> {
    if count > MOST {
        return Err(Error::too_large(format!("{count} {what}; at most {MOST}")));
    }
    Ok(())
}

fn name(name: &str) -> Result<()> {
    let printable = !name.trim().is_empty() && name.trim() == name && !name.chars().any(char::is_control);
    if printable && name.len() <= LONGEST_NAME {
        return Ok(());
    }
    Err(Error::invalid(format!("{name:?} is no name: 1 to {LONGEST_NAME} letters, no space at either end")))
}

fn unique<'a>(what: &str, all: impl Iterator<Item = &'a str>) -> Result<()> {
    let mut seen = BTreeSet::new();
    for each in all {
        name(each)?;
        if !seen.insert(each) {
            return Err(
                Error::invalid(format!("two are called '{each}'")).at_element(format!("{what} '{each}'"))
            );
        }
        at_most(seen.len(), what)?;
    }
    Ok(())
}

fn cloth(cloth: &Cloth) -> Result<()> {
    let Cloth { density, warp, weft, shear, bending, friction, thickness } = *cloth;
    let ranges = [
        ("density", density, 0.01, 5.0),
        ("warp", warp, 1.0, 1e6),
        ("weft", weft, 1.0, 1e6),
        ("shear", shear, 0.1, 1e6),
        ("bending", bending, 0.0, 1.0),
        ("friction", friction, 0.0, 2.0),
        ("thickness", thickness, 1e-5, 0.02),
    ];
    for (name, value, least, most) in ranges {
        if !(least..=most).contains(&value) {
            return Err(Error::invalid(format!(
                "the cloth's {name} is {value}; it is between {least} and {most}"
            )));
        }
    }
    Ok(())
}

/// Refuses a piece that cannot be cut, and joins the ends of its inner lines to what they touch.
pub(super) fn piece(piece: &mut WholePiece, figure: Figure) -> Result<()> {
    if !piece.grain.is_finite() {
        return Err(Error::invalid("its grain is not a number"));
    }
    unique_lines(piece)?;
    placement(&piece.placement, figure)?;
    for line in &piece.lines {
        if line.kind != LineKind::Points && line.length() < SHORTEST {
            let length = line.length() * 1000.0;
            return Err(Error::invalid(format!("'{}' is {length:.2} mm long: too short to sew", line.name)));
        }
    }
    let points: usize = piece.lines.iter().map(|line| line.points.len()).sum();
    if points > MOST_POINTS {
        return Err(Error::too_large(format!("{points} points; at most {MOST_POINTS}")));
    }
    let polygon = piece.polygon();
    extent(&polygon)?;
    if let Some((a, b)) = crossing(&outline_strokes(piece)) {
        return Err(overlap(&piece.lines, &a, &b));
    }
    if area(&polygon) <= 0.0 {
        return Err(Error::invalid(
            "its outline runs clockwise; it is drawn counter-clockwise, right side up",
        ));
    }
    attach(piece);
    inner_lines(piece, &polygon)
}

fn unique_lines(piece: &WholePiece) -> Result<()> {
    let mut seen = BTreeSet::new();
    for line in &piece.lines {
        name(&line.name)?;
        if !seen.insert(line.name.as_str()) {
            return Err(Error::invalid(format!("two of its lines are called '{}'", line.name)));
        }
    }
    Ok(())
}

fn extent(polygon: &[DVec2]) -> Result<()> {
    let low = polygon.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = polygon.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let size = high - low;
    if size.min_element() >= EXTENT[0] && size.max_element() <= EXTENT[1] {
        return Ok(());
    }
    Err(Error::invalid(format!(
        "it is {:.4} m by {:.4} m; a piece measures {} to {} m each way",
        size.x, size.y, EXTENT[0], EXTENT[1]
    )))
}

fn overlap(lines: &[Line], a: &Stroke, b: &Stroke) -> Error {
    let at = a.ends[0].midpoint(a.ends[1]);
    let (first, second) = (&lines[a.line].name, &lines[b.line].name);
    let which = if first == second {
        format!("'{first}' crosses itself")
    } else {
        format!("'{first}' and '{second}' cross or touch")
    };
    Error::invalid(format!("it overlaps itself: {which} near [{:.3}, {:.3}]", at.x, at.y))
}

/// The outline as strokes in a ring.
fn outline_strokes(piece: &WholePiece) -> Vec<Stroke> {
    let mut strokes = Vec::new();
    for (line, edge) in piece.outline().iter().enumerate() {
        for ends in edge.points.windows(2) {
            let joint = strokes.len();
            strokes.push(Stroke { ends: [ends[0], ends[1]], line, joints: [joint, joint + 1] });
        }
    }
    if let Some(last) = strokes.last_mut() {
        last.joints[1] = 0;
    }
    strokes
}

/// Moves the ends of inner lines that lie close to the outline, or to a line before them, onto that.
fn attach(piece: &mut WholePiece) {
    for i in piece.outline().len()..piece.lines.len() {
        if piece.lines[i].kind == LineKind::Points {
            continue;
        }
        let last = piece.lines[i].points.len() - 1;
        for end in [0, last] {
            let point = piece.lines[i].points[end];
            let touched = piece.lines[..i].iter().filter(|line| line.kind != LineKind::Points);
            let touched =
                touched.map(|line| line.at(line.nearest(point).0)).find(|at| at.distance(point) <= CLOSE);
            if let Some(at) = touched {
                let line = &piece.lines[i];
                let mut points = line.points.clone();
                points[end] = at;
                let corners = line.corners.clone();
                piece.lines[i] = Line::new(&line.name, line.kind, points, &[]);
                piece.lines[i].corners = corners;
            }
        }
    }
}

/// Refuses inner lines that leave the piece or cross another, and points outside.
fn inner_lines(piece: &WholePiece, polygon: &[DVec2]) -> Result<()> {
    let mut strokes = outline_strokes(piece);
    // An end that is joined to a line touches it: it is left out here.
    let trim = 2.0 * CLOSE;
    for (index, line) in piece.lines.iter().enumerate().skip(piece.outline().len()) {
        let probe = if line.kind == LineKind::Points {
            line.points.clone()
        } else {
            vec![line.at(line.length() / 2.0)]
        };
        if probe.iter().any(|&point| !inside(polygon, point)) {
            return Err(Error::invalid(format!("'{}' lies outside the outline", line.name)));
        }
        if line.kind == LineKind::Points {
            continue;
        }
        // Past the joints of all strokes before: only those of one line are neighbours.
        let start = strokes.len() + index;
        for (i, ends) in line.part(trim, line.length() - trim).windows(2).enumerate() {
            let joint = start + i;
            strokes.push(Stroke { ends: [ends[0], ends[1]], line: index, joints: [joint, joint + 1] });
        }
    }
    match crossing(&strokes) {
        Some((a, b)) => Err(Error::invalid(format!(
            "'{}' and '{}' cross or touch: a line inside meets others with its ends only",
            piece.lines[a.line].name, piece.lines[b.line].name
        ))),
        None => Ok(()),
    }
}

/// Refuses a placement at which a piece would not be near the figure, or have no extent.
fn placement(placement: &Placement, figure: Figure) -> Result<()> {
    match placement {
        Placement::Around { limb, point, along, angle_deg, radius, flare } => {
            is_limb(limb, figure)?;
            if !(0.005..=EXTENT[1]).contains(radius) || !(-2.0..=2.0).contains(flare) {
                return Err(Error::invalid(format!(
                    "its placement has the radius {radius} and the flare {flare}; they are 0.005 to 10 m and -2 to 2"
                )));
            }
            if !(-720.0..=720.0).contains(angle_deg) {
                return Err(Error::invalid(format!(
                    "its placement has an angle of {angle_deg} degrees; it is between -720 and 720"
                )));
            }
            near(&[point[0], point[1], *along])
        }
        Placement::Hung(hang) => hang.check(),
        Placement::Flat { point, at, across, up } => {
            let area = DVec3::from(*across).cross(DVec3::from(*up)).length();
            if !(1e-3..1e3).contains(&area) {
                let what = "its placement's 'across' and 'up' must be two different directions";
                return Err(Error::invalid(what));
            }
            near(&[point[0], point[1], at[0], at[1], at[2]])
        }
    }
}

fn is_limb(name: &str, figure: Figure) -> Result<()> {
    let limbs = figure.limbs();
    if limbs.iter().any(|limb| limb.name == name) {
        return Ok(());
    }
    let known: Vec<&str> = limbs.iter().map(|limb| limb.name).collect();
    let known = if known.is_empty() { "no limbs".to_owned() } else { known.join(", ") };
    Err(Error::invalid(format!("it is placed round '{name}'; the figure has {known}")))
}

/// Refuses coordinates, metres, that are not those of something near the figure.
fn near(coordinates: &[f64]) -> Result<()> {
    if coordinates.iter().all(|x| x.abs() <= EXTENT[1]) {
        return Ok(());
    }
    Err(Error::invalid("its placement is more than 10 m away, or not a number"))
}
