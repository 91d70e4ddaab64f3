//! Patterns written out whole: halves unfolded, mirror images drawn, curves flattened.

use amc_core::{Error, Result};
use glam::DVec2;

use super::{
    CLOSE, Cloth, Edge, Fold, FoldPlace, Line, LineKind, Notch, Pattern, Piece, Placement, SeamKind, check,
    mirror, path, seam_check,
};
use crate::body::Figure;

/// A pattern, checked, with every piece and every seam written out whole.
#[derive(Debug, Clone)]
pub struct Unfolded {
    /// The garment's name.
    pub name: String,
    /// What it is draped on.
    pub figure: Figure,
    /// The cloth of every piece that has none of its own.
    pub cloth: Cloth,
    /// The pieces.
    pub pieces: Vec<WholePiece>,
    /// The seams, mirror images after their originals.
    pub seams: Vec<WholeSeam>,
}

/// A whole piece.
#[derive(Debug, Clone)]
pub struct WholePiece {
    /// Its name.
    pub name: String,
    /// The warp's direction, radians counter-clockwise from +u.
    pub grain: f64,
    /// Its lines: the edges of the outline first, counter-clockwise, then the lines and the points inside.
    pub lines: Vec<Line>,
    /// The marks on its edges.
    pub notches: Vec<WholeNotch>,
    /// Where it is folded.
    pub folds: Vec<WholeFold>,
    /// Where it lies before it is sewn.
    pub placement: Placement,
    /// Its own cloth.
    pub cloth: Option<Cloth>,
    /// The piece of which it is the mirror image: its index.
    pub mirror: Option<usize>,
}

/// A mark on an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeNotch {
    /// Its name; may be empty.
    pub name: String,
    /// The edge: an index of [`WholePiece::lines`].
    pub line: usize,
    /// How far along the edge, metres.
    pub along: f64,
}

/// A line along which a piece is folded.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeFold {
    /// The line: an index of [`WholePiece::lines`].
    pub line: usize,
    /// How far, radians: positive where the two right sides move apart.
    pub angle: f64,
}

/// A seam between lines of whole pieces.
#[derive(Debug, Clone)]
pub struct WholeSeam {
    /// Its name.
    pub name: String,
    /// How it is joined.
    pub kind: SeamKind,
    /// The two sides, in the order of sewing.
    pub sides: [Vec<SidePart>; 2],
    /// Where the ease starts and ends: which side is longer, and the distances along it, metres. `None`: evenly spread.
    pub between: Option<(usize, [f64; 2])>,
}

/// A part of a line on one side of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SidePart {
    /// Index of the piece.
    pub piece: usize,
    /// Index of the line in [`WholePiece::lines`].
    pub line: usize,
    /// The part's lower end, metres along the line.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// Whether it is sewn from `to` to `from`.
    pub backwards: bool,
}

impl SidePart {
    /// Its length, metres.
    pub fn length(&self) -> f64 {
        self.to - self.from
    }
}

impl WholeSeam {
    /// The length of each side, metres.
    pub fn lengths(&self) -> [f64; 2] {
        self.sides.each_ref().map(|side| side.iter().map(SidePart::length).sum())
    }
}

impl WholePiece {
    /// The edges of its outline, counter-clockwise.
    pub fn outline(&self) -> &[Line] {
        let count = self.lines.iter().take_while(|line| line.kind == LineKind::Edge).count();
        &self.lines[..count]
    }

    /// Its area, square metres.
    pub fn area(&self) -> f64 {
        super::crossing::area(&self.polygon())
    }

    /// The outline's points, each once.
    pub fn polygon(&self) -> Vec<DVec2> {
        self.outline().iter().flat_map(|edge| &edge.points[..edge.points.len() - 1]).copied().collect()
    }
}

pub(super) fn unfold(pattern: &Pattern) -> Result<Unfolded> {
    check::names(pattern)?;
    let mut pieces: Vec<WholePiece> = Vec::with_capacity(pattern.pieces.len());
    for piece in &pattern.pieces {
        let whole = match &piece.mirror_of {
            Some(of) => mirror_image(piece, of, &pieces),
            None => unfold_piece(piece),
        };
        let named = |error: Error| error.at_element(format!("piece '{}'", piece.name));
        let mut whole = whole.map_err(named)?;
        check::piece(&mut whole, pattern.figure).map_err(named)?;
        pieces.push(whole);
    }
    let seams = seam_check::seams(pattern, &pieces)?;
    let Pattern { name, figure, cloth, .. } = pattern;
    Ok(Unfolded { name: name.clone(), figure: *figure, cloth: *cloth, pieces, seams })
}

/// The mirror image of the piece called `of`.
fn mirror_image(piece: &Piece, of: &str, pieces: &[WholePiece]) -> Result<WholePiece> {
    let only_a_name = Piece { cloth: None, ..piece.clone() } == bare(piece);
    if !only_a_name {
        return Err(Error::invalid("a mirror image has nothing of its own but a name and a cloth"));
    }
    let Some(index) = pieces.iter().position(|piece| piece.name == of) else {
        return Err(Error::invalid(format!("mirror_of: no piece before it is called '{of}'")));
    };
    let original = &pieces[index];
    let count = original.outline().len();
    let images = original.lines.iter().map(mirror::line);
    let mut lines: Vec<Line> = images.clone().take(count).rev().collect();
    lines.extend(images.skip(count));
    let place = |line: usize| if line < count { count - 1 - line } else { line };
    let notch = |notch: &WholeNotch| WholeNotch {
        name: mirror::name(&notch.name),
        line: place(notch.line),
        along: original.lines[notch.line].length() - notch.along,
    };
    Ok(WholePiece {
        name: piece.name.clone(),
        grain: std::f64::consts::PI - original.grain,
        notches: original.notches.iter().map(notch).collect(),
        folds: original
            .folds
            .iter()
            .map(|fold| WholeFold { line: place(fold.line), ..fold.clone() })
            .collect(),
        lines,
        placement: mirror::placement(&original.placement),
        cloth: piece.cloth.or(original.cloth),
        mirror: Some(index),
    })
}

/// What a piece with this name and `mirror_of` looks like that gives nothing else.
fn bare(piece: &Piece) -> Piece {
    Piece {
        name: piece.name.clone(),
        mirror_of: piece.mirror_of.clone(),
        mirrored: false,
        grain_deg: 90.0,
        start: [0.0; 2],
        outline: Vec::new(),
        notches: Vec::new(),
        lines: Vec::new(),
        folds: Vec::new(),
        points: Vec::new(),
        placement: None,
        cloth: None,
    }
}

/// A piece drawn in full, or the half of one.
fn unfold_piece(piece: &Piece) -> Result<WholePiece> {
    let Some(placement) = piece.placement.clone() else {
        return Err(Error::invalid("its placement is missing"));
    };
    let edges = draw_outline(piece)?;
    let notches: Vec<WholeNotch> =
        piece.notches.iter().map(|notch| draw_notch(notch, &edges)).collect::<Result<_>>()?;
    let inner = draw_inner(piece)?;
    let folds = draw_folds(&piece.folds, &inner)?;
    let mut whole = WholePiece {
        name: piece.name.clone(),
        grain: piece.grain_deg.to_radians(),
        lines: Vec::new(),
        notches,
        folds: Vec::new(),
        placement,
        cloth: piece.cloth,
        mirror: None,
    };
    let count = if piece.mirrored {
        let (edges, notches) = both_halves(&edges, &whole.notches)?;
        whole.lines = edges;
        whole.notches = notches;
        let count = whole.lines.len();
        for line in &inner {
            whole.lines.extend(both_lines(line)?);
        }
        count
    } else {
        let count = edges.len();
        whole.lines = edges;
        whole.lines.extend(inner);
        count
    };
    // A fold of a half is a fold of its mirror image too.
    for (name, angle) in folds {
        let also = mirror::name(&name);
        let of_fold = |line: &Line| line.name == name || (piece.mirrored && line.name == also);
        let lines = (count..whole.lines.len()).filter(|&i| of_fold(&whole.lines[i]));
        whole.folds.extend(lines.map(|line| WholeFold { line, angle }));
    }
    Ok(whole)
}

fn draw_outline(piece: &Piece) -> Result<Vec<Line>> {
    let mut at = path::sane(piece.start)?;
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

fn draw_notch(notch: &Notch, edges: &[Line]) -> Result<WholeNotch> {
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
fn draw_inner(piece: &Piece) -> Result<Vec<Line>> {
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
            let points = vec![path::sane(from)?, path::sane(to)?];
            inner.push(Line::new(&fold_name(i), LineKind::Inner, points, &[]));
        }
    }
    for points in &piece.points {
        let at = points.at.iter().map(|&point| path::sane(point)).collect::<Result<Vec<_>>>()?;
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
fn draw_folds(folds: &[Fold], inner: &[Line]) -> Result<Vec<(String, f64)>> {
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

/// The whole outline of a piece cut on the fold, and its notches.
fn both_halves(half: &[Line], marks: &[WholeNotch]) -> Result<(Vec<Line>, Vec<WholeNotch>)> {
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
fn both_lines(line: &Line) -> Result<Vec<Line>> {
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
