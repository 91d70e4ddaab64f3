//! Where lines are divided so that vertex meets vertex along every seam.
//!
//! A *break* is a place on a line that must be a vertex: a corner, a notch, an end of a part that is sewn, the end of an inner
//! line. Each has its counterpart on the other side of the seam, found here: a break that is already near, or a new one.
//! A *span* lies between two neighbouring breaks; spans that are sewn to each other are divided equally often.

use amc_core::{Error, Result};

use crate::pattern::{Line, LineKind, SidePart, Unfolded, WholePiece, WholeSeam};

/// Breaks of one line closer than this are one, metres.
const SAME: f64 = 1e-4;
/// Places closer than this are equal up to rounding, metres.
const ROUNDING: f64 = 1e-7;
/// Breaks on the two sides of a seam this close meet, metres; less where edges are short.
const NEAR: f64 = 0.003;
/// How often breaks are handed on from seam to seam before that is given up.
const ROUNDS: usize = 64;
/// The most breaks of one line.
const MOST: usize = 5000;

/// The breaks of every line, metres along it, rising: `[piece][line]`. Lines of points have none.
pub(super) type Breaks = Vec<Vec<Vec<f64>>>;

/// A span: piece, line, and the index of the break at its start.
pub(super) type Span = (usize, usize, usize);

/// Two spans that are sewn to each other, and whether each is sewn backwards.
pub(super) type Sewn = [(Span, bool); 2];

/// All breaks, and for each seam which spans meet, in order.
pub(super) fn breaks(whole: &Unfolded, edge_length: f64) -> Result<(Breaks, Vec<Vec<Sewn>>)> {
    let mut breaks: Breaks = whole.pieces.iter().map(own_breaks).collect();
    for part in whole.seams.iter().flat_map(|seam| seam.sides.iter().flatten()) {
        let line = &mut breaks[part.piece][part.line];
        if !line.is_empty() {
            insert(line, part.from, SAME);
            insert(line, part.to, SAME);
        }
    }
    let near = NEAR.min(0.25 * edge_length);
    for _ in 0..ROUNDS {
        let mut changed = false;
        for seam in &whole.seams {
            let handed_on = hand_on(seam, &mut breaks, near);
            changed |= handed_on.map_err(|error| error.at_element(format!("seam '{}'", seam.name)))?;
        }
        if !changed {
            let sewn = whole.seams.iter().map(|seam| sewn_spans(seam, &breaks)).collect::<Result<_>>()?;
            return Ok((breaks, sewn));
        }
    }
    Err(Error::invalid("the seams hand their notches on to each other without end"))
}

/// The breaks that a piece has of itself.
fn own_breaks(piece: &WholePiece) -> Vec<Vec<f64>> {
    let mut breaks: Vec<Vec<f64>> = piece.lines.iter().map(ends_and_corners).collect();
    for notch in &piece.notches {
        insert(&mut breaks[notch.line], notch.along, SAME);
    }
    for (i, line) in piece.lines.iter().enumerate().skip(piece.outline().len()) {
        let touching =
            if line.kind == LineKind::Points { line.points.clone() } else { vec![line.start(), line.end()] };
        let others =
            piece.lines.iter().enumerate().filter(|(j, other)| *j != i && other.kind != LineKind::Points);
        for (j, other) in others {
            for point in &touching {
                let (along, distance) = other.nearest(*point);
                if distance <= SAME {
                    insert(&mut breaks[j], along, SAME);
                }
            }
        }
    }
    breaks
}

fn ends_and_corners(line: &Line) -> Vec<f64> {
    if line.kind == LineKind::Points {
        return Vec::new();
    }
    let mut breaks = vec![0.0, line.length()];
    for &corner in &line.corners {
        insert(&mut breaks, corner, SAME);
    }
    breaks
}

/// Adds a break unless there is one within `same`.
fn insert(breaks: &mut Vec<f64>, at: f64, same: f64) -> bool {
    let next = breaks.partition_point(|&b| b < at);
    let taken = |i: usize| breaks.get(i).is_some_and(|b| (b - at).abs() <= same);
    if taken(next) || (next > 0 && taken(next - 1)) {
        return false;
    }
    breaks.insert(next, at);
    true
}

/// The breaks along a side of a seam: distances from the side's start, rising.
fn along_side(side: &[SidePart], breaks: &Breaks) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::new();
    let mut before = 0.0;
    for part in side {
        let line = breaks[part.piece][part.line].iter();
        let within = line.filter(|b| (part.from - SAME..=part.to + SAME).contains(b));
        let mut places: Vec<f64> =
            within.map(|b| before + along_part(part, b.clamp(part.from, part.to))).collect();
        if part.backwards {
            places.reverse();
        }
        for place in places {
            if all.last().is_none_or(|last| place > last + ROUNDING) {
                all.push(place);
            }
        }
        before += part.length();
    }
    all
}

fn along_part(part: &SidePart, along: f64) -> f64 {
    if part.backwards { part.to - along } else { along - part.from }
}

/// Adds a break at a distance from a side's start.
fn insert_on_side(side: &[SidePart], breaks: &mut Breaks, at: f64) -> bool {
    let mut before = 0.0;
    for part in side {
        if at < before + part.length() {
            let within = at - before;
            let along = if part.backwards { part.to - within } else { part.from + within };
            return insert(&mut breaks[part.piece][part.line], along, ROUNDING);
        }
        before += part.length();
    }
    false
}

/// Gives every break of a seam its counterpart on the other side. Whether any was added.
fn hand_on(seam: &WholeSeam, breaks: &mut Breaks, near: f64) -> Result<bool> {
    let sides = [along_side(&seam.sides[0], breaks), along_side(&seam.sides[1], breaks)];
    let ease = EaseMap::new(seam);
    let [a, b] = &sides;
    let (mut i, mut j) = (0, 0);
    let mut changed = false;
    while i < a.len() && j < b.len() {
        let (here, there) = (ease.across(a[i]), b[j]);
        // The ends of a seam always meet.
        let ends = (i == 0 && j == 0) || (i + 1 == a.len() && j + 1 == b.len());
        if ends || ((here - there).abs() <= near && (i + 1 == a.len()) == (j + 1 == b.len())) {
            i += 1;
            j += 1;
        } else if here < there && i + 1 < a.len() {
            changed |= insert_on_side(&seam.sides[1], breaks, here);
            i += 1;
        } else if j + 1 < b.len() {
            changed |= insert_on_side(&seam.sides[0], breaks, ease.back(there));
            j += 1;
        } else {
            changed |= insert_on_side(&seam.sides[1], breaks, here);
            i += 1;
        }
    }
    if a.len().max(b.len()) > MOST {
        return Err(Error::too_large(format!("more than {MOST} notches and corners along it")));
    }
    Ok(changed)
}

/// Which spans meet along a seam, in order.
fn sewn_spans(seam: &WholeSeam, breaks: &Breaks) -> Result<Vec<Sewn>> {
    let [a, b] = seam.sides.each_ref().map(|side| spans_of_side(side, breaks));
    if a.len() != b.len() {
        let what = "notches and corners lie too close together to divide its two sides alike";
        return Err(Error::invalid(what).at_element(format!("seam '{}'", seam.name)));
    }
    Ok(a.into_iter().zip(b).map(|(a, b)| [a, b]).collect())
}

fn spans_of_side(side: &[SidePart], breaks: &Breaks) -> Vec<(Span, bool)> {
    let mut all = Vec::new();
    for part in side {
        let line = &breaks[part.piece][part.line];
        let inside = |i: &usize| {
            let middle = (line[*i] + line[i + 1]) / 2.0;
            (part.from..part.to).contains(&middle)
        };
        let mut spans: Vec<(Span, bool)> = (0..line.len().saturating_sub(1))
            .filter(inside)
            .map(|i| ((part.piece, part.line, i), part.backwards))
            .collect();
        if part.backwards {
            spans.reverse();
        }
        all.extend(spans);
    }
    all
}

/// How distances along one side of a seam become distances along the other.
struct EaseMap {
    /// Pairs of distances that meet, rising: (a, b).
    knots: Vec<[f64; 2]>,
}

impl EaseMap {
    fn new(seam: &WholeSeam) -> Self {
        let [a, b] = seam.lengths();
        let mut knots = vec![[0.0, 0.0], [a, b]];
        if let Some((longer, [from, to])) = seam.between {
            let lengths = [a, b];
            let excess = lengths[longer] - lengths[1 - longer];
            let knot = |own: f64, other: f64| if longer == 0 { [own, other] } else { [other, own] };
            knots.splice(1..1, [knot(from, from), knot(to, to - excess)]);
        }
        Self { knots }
    }

    fn across(&self, a: f64) -> f64 {
        self.map(a, 0, 1)
    }

    fn back(&self, b: f64) -> f64 {
        self.map(b, 1, 0)
    }

    fn map(&self, at: f64, from: usize, to: usize) -> f64 {
        let next = self.knots.partition_point(|knot| knot[from] <= at).clamp(1, self.knots.len() - 1);
        let (low, high) = (self.knots[next - 1], self.knots[next]);
        let span = high[from] - low[from];
        let share = if span > 0.0 { (at - low[from]) / span } else { 0.0 };
        low[to] + share * (high[to] - low[to])
    }
}
