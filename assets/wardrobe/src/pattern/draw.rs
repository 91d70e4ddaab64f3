//! A piece's lines as they are written.

use amc_core::{Error, Result};
use glam::DVec2;

use super::{CLOSE, Edge, Fold, FoldPlace, Line, LineKind, Notch, Piece, WholeNotch, path};

/// The edges of the outline, closed, or from fold line to fold line.
pub(super) fn outline(piece: &Piece) -> Result<Vec<Line>> {
    let mut at = path::checked(piece.start)?;
    if piece.mirrored {
        at = on_the_fold_line(at, "starts")?;
    }
    let first = at;
    let mut edges = Vec::with_capacity(piece.outline.len());
    for (i, edge) in piece.outline.iter().enumerate() {
        let last = i + 1 == piece.outline.len();
        let mut drawn =
            draw_edge(at, edge).map_err(|error| Error::invalid(format!("edge '{}': {error}", edge.name)))?;
        at = drawn.points.last().copied().unwrap_or(at);
        if last {
            at = if piece.mirrored { on_the_fold_line(at, "ends")? } else { closed(at, first)? };
            if let Some(end) = drawn.points.last_mut() {
                *end = at;
            }
        }
        edges.push(Line::new(&edge.name, LineKind::Edge, drawn.points, &drawn.joints));
    }
    if edges.is_empty() {
        return Err(Error::invalid("it has no outline"));
    }
    Ok(edges)
}

fn draw_edge(at: DVec2, edge: &Edge) -> Result<path::Path> {
    if edge.path.is_empty() {
        return Err(Error::invalid("it has no path"));
    }
    path::flatten(at, &edge.path)
}

fn closed(end: DVec2, start: DVec2) -> Result<DVec2> {
    if end.distance(start) <= CLOSE {
        return Ok(start);
    }
    Err(Error::invalid(format!(
        "its outline is open: it starts at {:?} and ends at {:?}, {:.1} mm apart",
        start.to_array(),
        end.to_array(),
        end.distance(start) * 1000.0
    )))
}

fn on_the_fold_line(point: DVec2, does: &str) -> Result<DVec2> {
    if point.x.abs() <= CLOSE {
        return Ok(DVec2::new(0.0, point.y));
    }
    Err(Error::invalid(format!(
        "its outline is open: half a piece, it {does} at {:?}, which is not on the fold line u = 0",
        point.to_array()
    )))
}

pub(super) fn notch(notch: &Notch, edges: &[Line]) -> Result<WholeNotch> {
    let Some(line) = edges.iter().position(|edge| edge.name == notch.edge) else {
        return Err(Error::invalid(format!("a notch lies on '{}', and no edge is called so", notch.edge)));
    };
    if !(0.0..=1.0).contains(&notch.at) {
        return Err(Error::invalid(format!(
            "the notch on '{}' is at {}; 0 is the edge's start and 1 its end",
            notch.edge, notch.at
        )));
    }
    Ok(WholeNotch { name: notch.name.clone(), line, along: notch.at * edges[line].length() })
}

/// The lines and the points inside; folds between two points become lines called `fold 1`, `fold 2` and so on.
pub(super) fn inner(piece: &Piece) -> Result<Vec<Line>> {
    let mut inner = Vec::new();
    for line in &piece.lines {
        let named = |error: Error| Error::invalid(format!("line '{}': {error}", line.name));
        if line.path.is_empty() {
            return Err(named(Error::invalid("it has no path")));
        }
        let drawn = path::flatten(DVec2::from(line.start), &line.path).map_err(named)?;
        inner.push(Line::new(&line.name, LineKind::Inner, drawn.points, &drawn.joints));
    }
    for (i, fold) in piece.folds.iter().enumerate() {
        if let FoldPlace::Across([from, to]) = fold.along {
            let points = vec![path::checked(from)?, path::checked(to)?];
            inner.push(Line::new(&fold_name(i), LineKind::Inner, points, &[]));
        }
    }
    for points in &piece.points {
        let at = points.at.iter().map(|&point| path::checked(point)).collect::<Result<Vec<_>>>()?;
        if at.is_empty() {
            return Err(Error::invalid(format!("'{}' has no points", points.name)));
        }
        inner.push(Line::new(&points.name, LineKind::Points, at, &[]));
    }
    Ok(inner)
}

fn fold_name(index: usize) -> String {
    format!("fold {}", index + 1)
}

/// The line's name and the angle, radians, of every fold.
pub(super) fn folds(folds: &[Fold], inner: &[Line]) -> Result<Vec<(String, f64)>> {
    let draw = |(i, fold): (usize, &Fold)| {
        let name = match &fold.along {
            FoldPlace::Line(name) => name.clone(),
            FoldPlace::Across(_) => fold_name(i),
        };
        if !inner.iter().any(|line| line.name == name && line.kind == LineKind::Inner) {
            return Err(Error::invalid(format!(
                "a fold lies along '{name}', and no inner line is called so"
            )));
        }
        if !(-180.0..=180.0).contains(&fold.angle_deg) {
            return Err(Error::invalid(format!(
                "the fold along '{name}' has an angle of {}; it is between -180 and 180 degrees",
                fold.angle_deg
            )));
        }
        Ok((name, fold.angle_deg.to_radians()))
    };
    folds.iter().enumerate().map(draw).collect()
}
