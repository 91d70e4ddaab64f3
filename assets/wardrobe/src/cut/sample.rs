//! Vertices along the lines of all pieces.

use amc_core::Result;
use glam::DVec2;

use super::breaks::{self, Breaks, Sewn, Span};
use super::{At, Join, JoinKind};
use crate::pattern::{Line, LineKind, SeamKind, SidePart, Unfolded, WholePiece};

/// Ends and points this close to a vertex are that vertex, metres.
const SAME: f64 = 2.5e-4;

/// A piece's lines, divided.
#[derive(Debug)]
pub(super) struct SampledPiece {
    /// All vertices on lines: those of the outline first, counter-clockwise.
    pub(super) points: Vec<DVec2>,
    /// The outline's vertices, counter-clockwise, each once.
    pub(super) outline: Vec<u32>,
    /// Pairs of vertices along lines inside.
    pub(super) inner: Vec<[u32; 2]>,
    /// The vertices of every line, both ends included.
    pub(super) lines: Vec<Vec<u32>>,
    /// For every line and span, the place of its first vertex in `lines`.
    starts: Vec<Vec<usize>>,
}

/// All pieces, divided, and which spans are sewn.
#[derive(Debug)]
pub(super) struct Sampled {
    pub(super) pieces: Vec<SampledPiece>,
    sewn: Vec<Vec<Sewn>>,
}

/// Divides all lines of all pieces.
pub(super) fn sample(whole: &Unfolded, edge_length: f64) -> Result<Sampled> {
    let (breaks, sewn) = breaks::breaks(whole, edge_length)?;
    let counts = counts(&breaks, &sewn, edge_length);
    let pieces = whole
        .pieces
        .iter()
        .enumerate()
        .map(|(i, piece)| sample_piece(piece, &breaks[i], &counts[i]))
        .collect();
    Ok(Sampled { pieces, sewn })
}

/// Into how many edges each span is divided: spans that are sewn to each other into equally many.
fn counts(breaks: &Breaks, sewn: &[Vec<Sewn>], edge_length: f64) -> Vec<Vec<Vec<usize>>> {
    // Spans are numbered through; each group of sewn ones is known by its lowest number.
    let mut first = Vec::new();
    let mut lengths = Vec::new();
    for piece in breaks {
        let mut of_piece = Vec::new();
        for line in piece {
            of_piece.push(lengths.len());
            lengths.extend(line.windows(2).map(|ends| ends[1] - ends[0]));
        }
        first.push(of_piece);
    }
    let mut parent: Vec<usize> = (0..lengths.len()).collect();
    let number = |(piece, line, span): Span| first[piece][line] + span;
    for [(a, _), (b, _)] in sewn.iter().flatten() {
        let (a, b) = (root(&mut parent, number(*a)), root(&mut parent, number(*b)));
        parent[a.max(b)] = a.min(b);
    }
    let roots: Vec<usize> = (0..lengths.len()).map(|i| root(&mut parent, i)).collect();
    let mut sums = vec![(0.0, 0usize); lengths.len()];
    for (length, &root) in lengths.iter().zip(&roots) {
        sums[root].0 += length;
        sums[root].1 += 1;
    }
    let count = |(piece, line, span): Span| {
        let (sum, members) = sums[roots[number((piece, line, span))]];
        (sum / members as f64 / edge_length).round().max(1.0) as usize
    };
    let of_line = |piece: usize, line: usize| {
        (0..breaks[piece][line].len().saturating_sub(1)).map(|span| count((piece, line, span))).collect()
    };
    (0..breaks.len())
        .map(|piece| (0..breaks[piece].len()).map(|line| of_line(piece, line)).collect())
        .collect()
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

fn sample_piece(piece: &WholePiece, breaks: &[Vec<f64>], counts: &[Vec<usize>]) -> SampledPiece {
    let mut sampled = SampledPiece {
        points: Vec::new(),
        outline: Vec::new(),
        inner: Vec::new(),
        lines: Vec::new(),
        starts: Vec::new(),
    };
    let edges = piece.outline().len();
    for (i, line) in piece.lines.iter().enumerate() {
        let (places, starts) = divide(line, &breaks[i], &counts[i]);
        let vertices: Vec<u32> = if i < edges {
            sampled.edge(&places, i + 1 == edges)
        } else {
            places
                .iter()
                .enumerate()
                .map(|(k, p)| sampled.inner_vertex(*p, is_joint(line, k, places.len())))
                .collect()
        };
        if line.kind == LineKind::Inner {
            sampled.inner.extend(vertices.windows(2).map(|ends| [ends[0], ends[1]]));
        }
        sampled.lines.push(vertices);
        sampled.starts.push(starts);
    }
    sampled
}

/// Whether a line's vertex may be one that another line has.
fn is_joint(line: &Line, index: usize, count: usize) -> bool {
    line.kind == LineKind::Points || index == 0 || index + 1 == count
}

/// A line's vertices, and for each span the place of its first among them.
fn divide(line: &Line, breaks: &[f64], counts: &[usize]) -> (Vec<DVec2>, Vec<usize>) {
    if line.kind == LineKind::Points {
        return (line.points.clone(), Vec::new());
    }
    let mut places = vec![line.start()];
    let mut starts = Vec::with_capacity(counts.len());
    for (ends, &count) in breaks.windows(2).zip(counts) {
        starts.push(places.len() - 1);
        let step = (ends[1] - ends[0]) / count as f64;
        places.extend(
            (1..=count).map(|i| line.at(if i == count { ends[1] } else { ends[0] + step * i as f64 })),
        );
    }
    (places, starts)
}

impl SampledPiece {
    /// Adds an edge's vertices; its first is the last of the edge before it.
    fn edge(&mut self, places: &[DVec2], closing: bool) -> Vec<u32> {
        let mut vertices = Vec::with_capacity(places.len());
        for (i, place) in places.iter().enumerate() {
            if i == 0 && !self.points.is_empty() {
                vertices.push(self.points.len() as u32 - 1);
            } else if closing && i + 1 == places.len() {
                vertices.push(0);
            } else {
                self.outline.push(self.points.len() as u32);
                vertices.push(self.points.len() as u32);
                self.points.push(*place);
            }
        }
        vertices
    }

    fn inner_vertex(&mut self, place: DVec2, joint: bool) -> u32 {
        let nearest = |&(_, a): &(usize, &DVec2), &(_, b): &(usize, &DVec2)| {
            a.distance_squared(place).total_cmp(&b.distance_squared(place))
        };
        let found = self.points.iter().enumerate().min_by(|a, b| nearest(a, b));
        match found {
            Some((i, point)) if joint && point.distance(place) <= SAME => i as u32,
            _ => {
                self.points.push(place);
                self.points.len() as u32 - 1
            }
        }
    }

    /// The vertices of a span in order.
    fn span(&self, line: usize, span: usize) -> &[u32] {
        let starts = &self.starts[line];
        let end = starts.get(span + 1).copied().unwrap_or(self.lines[line].len() - 1);
        &self.lines[line][starts[span]..=end]
    }
}

impl Sampled {
    /// Which vertices every seam brings together.
    pub(super) fn joins(&self, whole: &Unfolded) -> Vec<Join> {
        let join = |(seam, sewn): (&crate::pattern::WholeSeam, &Vec<Sewn>)| {
            let sides = [0, 1].map(|i| self.along(&seam.sides[i], sewn.iter().map(|pair| pair[i]).collect()));
            let mut pairs: Vec<(At, At)> = sides[0].iter().copied().zip(sides[1].iter().copied()).collect();
            pairs.retain(|(a, b)| a != b);
            pairs.dedup();
            let name = |part: &SidePart| (part.piece, whole.pieces[part.piece].lines[part.line].name.clone());
            Join {
                name: seam.name.clone(),
                kind: match seam.kind {
                    SeamKind::Sewn => JoinKind::Sewn,
                    SeamKind::Layered => JoinKind::Layered,
                },
                late: seam.late,
                pairs,
                sides: seam.sides.each_ref().map(|side| side.iter().map(name).collect()),
            }
        };
        whole.seams.iter().zip(&self.sewn).map(join).collect()
    }

    /// The vertices along a side, span after span, each with both its ends; points where the seam joins points.
    fn along(&self, side: &[SidePart], spans: Vec<(Span, bool)>) -> Vec<At> {
        let at = |piece: usize, vertices: &[u32], backwards: bool| {
            let mut all: Vec<At> =
                vertices.iter().map(|&vertex| At { piece: piece as u32, vertex }).collect();
            if backwards {
                all.reverse();
            }
            all
        };
        if spans.is_empty() {
            let whole =
                |part: &SidePart| at(part.piece, &self.pieces[part.piece].lines[part.line], part.backwards);
            return side.iter().flat_map(whole).collect();
        }
        let of_span = |((piece, line, span), backwards): (Span, bool)| {
            at(piece, self.pieces[piece].span(line, span), backwards)
        };
        spans.into_iter().flat_map(of_span).collect()
    }
}
