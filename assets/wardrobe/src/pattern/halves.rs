//! Pieces cut on the fold, unfolded.

use amc_core::{Error, Result};

use super::{CLOSE, Line, LineKind, WholeNotch, mirror};

/// The whole outline of a piece cut on the fold, and its notches.
pub(super) fn outline(half: &[Line], marks: &[WholeNotch]) -> Result<(Vec<Line>, Vec<WholeNotch>)> {
    let last = half.len() - 1;
    for (i, edge) in half.iter().enumerate() {
        let reaches = i == 0 || i == last;
        if !reaches && !mirror::has_side(&edge.name) {
            return Err(Error::invalid(format!(
                "edge '{}' has a mirror image: its name needs 'left' or 'right' to tell the two apart",
                edge.name
            )));
        }
    }
    let crosses = |i: usize| !mirror::has_side(&half[i].name);
    let (mut edges, mut notches) = (Vec::new(), Vec::new());
    let mut marked = |i: usize, line: usize, shift: f64, image: bool| {
        for mark in marks.iter().filter(|mark| mark.line == i) {
            let (name, along) = if image {
                (mirror::name(&mark.name), half[i].length() - mark.along)
            } else {
                (mark.name.clone(), mark.along)
            };
            notches.push(WholeNotch { name, line, along: along + shift });
        }
    };
    for (i, edge) in half.iter().enumerate() {
        let image = mirror::line(edge);
        let line = edges.len();
        let (mut whole, mut shift) = (edge.clone(), 0.0);
        if i == 0 && crosses(i) {
            shift = image.length();
            whole = mirror::join(&image, edge);
            marked(i, line, 0.0, true);
        } else if i == last && crosses(i) {
            marked(i, line, edge.length(), true);
            whole = mirror::join(edge, &image);
        }
        marked(i, line, shift, false);
        edges.push(whole);
    }
    for (i, edge) in half.iter().enumerate().rev() {
        if !crosses(i) {
            marked(i, edges.len(), 0.0, true);
            edges.push(mirror::line(edge));
        }
    }
    notches.dedup_by(|a, b| a.line == b.line && (a.along - b.along).abs() < CLOSE);
    Ok((edges, notches))
}

/// An inner line of a piece cut on the fold, and its mirror image: one line where it reaches the fold line.
pub(super) fn inner(line: &Line) -> Result<Vec<Line>> {
    if line.points.iter().all(|point| point.x.abs() <= CLOSE) {
        return Ok(vec![line.clone()]);
    }
    let image = mirror::line(line);
    if mirror::has_side(&line.name) {
        return Ok(vec![line.clone(), image]);
    }
    if line.kind == LineKind::Inner && line.start().x.abs() <= CLOSE {
        return Ok(vec![mirror::join(&image, line)]);
    }
    if line.kind == LineKind::Inner && line.end().x.abs() <= CLOSE {
        return Ok(vec![mirror::join(line, &image)]);
    }
    Err(Error::invalid(format!(
        "line '{}' has a mirror image: its name needs 'left' or 'right' to tell the two apart",
        line.name
    )))
}
