//! The flat pattern laid out: every piece in its true proportions, side by side.

pub(crate) mod line;

use std::sync::Arc;

use amc_core::mesh::{FlatLocator, Garment, Panel};
use amc_core::{Progress, Result};
use glam::{Affine2, Vec2};

use self::line::{Edge, edges, simplified};

/// Between pieces, of the mean length of a piece's side.
const GAP: f32 = 0.12;
/// How far a drawn outline may be off, of a piece's size.
const TOLERANCE: f32 = 4e-4;
/// Width over height of the whole.
const SHAPE: f32 = 1.5;

/// All pieces of a garment that have a flat pattern. Sheet coordinates are metres on the cloth, y up.
#[derive(Debug)]
pub(crate) struct Sheet {
    pub(crate) garment: Arc<Garment>,
    pub(crate) pieces: Vec<Piece>,
    /// From the origin.
    pub(crate) size: Vec2,
}

/// One panel's flat piece, as its UVs draw it.
#[derive(Debug)]
pub(crate) struct Piece {
    /// Its number.
    pub(crate) panel: usize,
    pub(crate) uv_to_sheet: Affine2,
    /// How far it is turned from how the UVs draw it, radians counter-clockwise: how it lies here, not how it is cut.
    pub(crate) turn: f32,
    /// Closed lines, the longest first.
    pub(crate) outlines: Vec<Vec<Vec2>>,
    /// Triangles that fill them: indices of all their points, one line after the other.
    pub(crate) fill: Vec<u32>,
    /// Between corners.
    pub(crate) edges: Vec<Edge>,
    pub(crate) seams: Vec<SeamLine>,
    /// Where the arrow of the grain has its middle, well inside.
    pub(crate) middle: Vec2,
    pub(crate) low: Vec2,
    pub(crate) high: Vec2,
    pub(crate) locator: FlatLocator,
}

/// A seam on its piece.
#[derive(Debug)]
pub(crate) struct SeamLine {
    pub(crate) name: String,
    /// The number of the panel across.
    pub(crate) partner: usize,
    pub(crate) line: Vec<Vec2>,
}

impl Sheet {
    /// Lays out a garment's pieces; work for a job.
    pub(crate) fn new(garment: Arc<Garment>, progress: &Progress<'_>) -> Result<Self> {
        let mut pieces = Vec::new();
        for panel in 0..garment.panels.len() {
            progress.step("laying out the flat pattern", panel, garment.panels.len())?;
            pieces.extend(Piece::new(&garment, panel));
        }
        let size = lay_out(&mut pieces);
        Ok(Self { garment, pieces, size })
    }

    /// The piece of the panel of this number.
    pub(crate) fn piece(&self, panel: usize) -> Option<&Piece> {
        self.pieces.iter().find(|piece| piece.panel == panel)
    }

    /// Turns every piece to where it is to lie, `turn` being asked by the panel's id for radians, and lays all out again where one
    /// lay otherwise. Says whether one did.
    pub(crate) fn lie(&mut self, turn: impl Fn(&str) -> f32) -> bool {
        let mut has_moved = false;
        for piece in &mut self.pieces {
            let turn = turn(&self.garment.panels[piece.panel].id);
            if piece.turn != turn {
                piece.lie(turn);
                has_moved = true;
            }
        }
        if has_moved {
            self.size = lay_out(&mut self.pieces);
        }
        has_moved
    }

    pub(crate) fn panel(&self, piece: &Piece) -> &Panel {
        &self.garment.panels[piece.panel]
    }
}

impl Piece {
    /// At the origin. None where the panel has no flat pattern.
    fn new(garment: &Garment, panel: usize) -> Option<Self> {
        let of = garment.panels.get(panel)?;
        // The pattern is shown as the UVs draw it, mirrored or not.
        let uv_to_sheet = garment.uv_to_drawn_metres(of)?;
        let place = |vertex: &u32| uv_to_sheet.transform_point2(garment.uvs[*vertex as usize]);
        let whole: Vec<Vec<Vec2>> =
            garment.outlines(of).iter().map(|line| line.iter().map(place).collect()).collect();
        let points = || whole.iter().flatten().copied();
        let (low, high) = (points().reduce(Vec2::min)?, points().reduce(Vec2::max)?);
        let size = (high - low).max_element();
        let outlines: Vec<Vec<Vec2>> = whole.iter().map(|line| simplified(line, size * TOLERANCE)).collect();
        let edges: Vec<Edge> = outlines.iter().flat_map(|line| edges(line)).collect();
        let seams = of.pattern.seams.iter().map(|seam| {
            let ends = seam.edge.map(|end| uv_to_sheet.transform_point2(end));
            SeamLine { name: seam.name.clone(), partner: seam.partner, line: run(&whole, ends) }
        });
        let middle = middle(&outlines, &edges, low, high);
        Some(Self {
            panel,
            uv_to_sheet,
            turn: 0.0,
            fill: fill(&outlines),
            edges,
            seams: seams.collect(),
            middle,
            low,
            high,
            locator: FlatLocator::new(garment, of),
            outlines,
        })
    }

    /// Whether a point of the sheet is on the cloth.
    pub(crate) fn holds(&self, at: Vec2) -> bool {
        is_inside(&self.outlines, at)
    }

    /// Half the length of an arrow along `along`: it ends before the outline does, and is never longer than a third of the piece.
    pub(crate) fn half_arrow(&self, along: Vec2) -> f32 {
        let ways = self.edges.iter().flat_map(|edge| edge.line.windows(2)).filter_map(|ends| {
            let (a, side) = (ends[0] - self.middle, ends[1] - ends[0]);
            let turn = along.perp_dot(side);
            let (way, share) = (a.perp_dot(side) / turn, a.perp_dot(along) / turn);
            (0.0..=1.0).contains(&share).then_some(way.abs())
        });
        let most = (self.high - self.low).max_element() / 3.0;
        0.8 * ways.fold(most, f32::min)
    }

    fn shift(&mut self, by: Vec2) {
        self.moved(Affine2::from_translation(by));
        (self.low, self.high) = (self.low + by, self.high + by);
    }

    /// Turns it to where it is to lie.
    fn lie(&mut self, turn: f32) {
        self.moved(Affine2::from_angle(turn - self.turn));
        self.turn = turn;
        let points = || self.outlines.iter().flatten().copied();
        (self.low, self.high) = points()
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    }

    fn moved(&mut self, by: Affine2) {
        self.uv_to_sheet = by * self.uv_to_sheet;
        let edges = self.edges.iter_mut().flat_map(|edge| edge.line.iter_mut());
        let seams = self.seams.iter_mut().flat_map(|seam| seam.line.iter_mut());
        let points = self.outlines.iter_mut().flatten().chain(edges).chain(seams);
        points.chain([&mut self.middle]).for_each(|point| *point = by.transform_point2(*point));
    }
}

/// Puts the pieces in rows from the top, the highest first, and gives the size of the whole.
fn lay_out(pieces: &mut [Piece]) -> Vec2 {
    let size = |piece: &Piece| piece.high - piece.low;
    let mean =
        pieces.iter().map(|piece| size(piece).element_sum() / 2.0).sum::<f32>() / pieces.len().max(1) as f32;
    let gap = mean * GAP;
    let area: f32 = pieces.iter().map(|piece| (size(piece) + gap).element_product()).sum();
    let widest = pieces.iter().map(|piece| size(piece).x + 2.0 * gap).fold(0.0, f32::max);
    let width = (area * SHAPE).sqrt().max(widest);
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&a, &b| size(&pieces[b]).y.total_cmp(&size(&pieces[a]).y));
    let (mut at, mut row) = (Vec2::splat(gap), 0.0_f32);
    let mut corners = Vec::with_capacity(order.len());
    for piece in order {
        let size = size(&pieces[piece]);
        if at.x + size.x + gap > width * 1.0001 && at.x > gap {
            at = Vec2::new(gap, at.y + row + gap);
            row = 0.0;
        }
        corners.push((piece, at));
        at.x += size.x + gap;
        row = row.max(size.y);
    }
    let height = at.y + row + gap;
    for (piece, corner) in corners {
        // Rows go down, y goes up.
        let size = size(&pieces[piece]);
        let low = Vec2::new(corner.x, height - corner.y - size.y);
        let by = low - pieces[piece].low;
        pieces[piece].shift(by);
    }
    Vec2::new(width, height)
}

/// The run of a line between the points nearest to two ends, as it goes from the first to the second; both ends alone where they
/// are inside of the piece.
fn run(lines: &[Vec<Vec2>], [from, to]: [Vec2; 2]) -> Vec<Vec2> {
    let nearest = |line: &[Vec2], end: Vec2| {
        let distance = |k: &usize| line[*k].distance_squared(end);
        (0..line.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let off = |line: &&Vec<Vec2>| {
        let ends = [from, to].map(|end| nearest(line, end).map_or(f32::INFINITY, |k| line[k].distance(end)));
        ends[0] + ends[1]
    };
    let best = lines.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(line) = best.filter(|line| off(line) < 0.1 * from.distance(to) + 1e-3) else {
        return vec![from, to];
    };
    let (Some(first), Some(last)) = (nearest(line, from), nearest(line, to)) else { return vec![from, to] };
    let count = (last + line.len() - first) % line.len();
    (0..=count).map(|k| line[(first + k) % line.len()]).collect()
}

/// Indices of the triangles that fill closed lines by the even-odd rule of a piece with holes: the first line bounds it, the others
/// are cut out of it or stand beside it.
fn fill(lines: &[Vec<Vec2>]) -> Vec<u32> {
    let mut filled = Vec::new();
    let mut starts = Vec::with_capacity(lines.len());
    let mut next = 0;
    for line in lines {
        starts.push(next);
        next += line.len();
    }
    let area =
        |line: &[Vec2]| (0..line.len()).map(|k| line[k].perp_dot(line[(k + 1) % line.len()])).sum::<f32>();
    let sense = lines.first().map_or(1.0, |line| area(line).signum());
    let is_outer: Vec<bool> = lines.iter().map(|line| area(line) * sense > 0.0).collect();
    for (outer, line) in lines.iter().enumerate().filter(|(outer, _)| is_outer[*outer]) {
        let inside =
            |hole: &usize| !is_outer[*hole] && lines[*hole].first().is_some_and(|&at| holds(line, at));
        let holes: Vec<usize> = (0..lines.len()).filter(inside).collect();
        let parts: Vec<usize> = std::iter::once(outer).chain(holes).collect();
        let points: Vec<[f32; 2]> =
            parts.iter().flat_map(|&part| lines[part].iter().map(|at| at.to_array())).collect();
        let numbers: Vec<usize> =
            parts.iter().flat_map(|&part| starts[part]..starts[part] + lines[part].len()).collect();
        let mut ends = parts.iter().scan(0, |end, &part| {
            *end += lines[part].len();
            Some(*end as u32)
        });
        let holes: Vec<u32> = ends.by_ref().take(parts.len() - 1).collect();
        let mut triangles: Vec<u32> = Vec::new();
        earcut::Earcut::new().earcut(points, &holes, &mut triangles);
        filled.extend(triangles.iter().map(|&k| numbers[k as usize] as u32));
    }
    filled
}

/// Whether a point is on the cloth that closed lines bound.
fn is_inside(lines: &[Vec<Vec2>], at: Vec2) -> bool {
    lines.iter().filter(|line| holds(line, at)).count() % 2 == 1
}

/// Whether a closed line goes round a point.
fn holds(line: &[Vec2], at: Vec2) -> bool {
    let crosses = |k: &usize| {
        let (a, b) = (line[*k], line[(*k + 1) % line.len()]);
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..line.len()).filter(crosses).count() % 2 == 1
}

/// A point well inside: of a grid of points the one farthest from all lines.
fn middle(lines: &[Vec<Vec2>], edges: &[Edge], low: Vec2, high: Vec2) -> Vec2 {
    const POINTS: usize = 15;
    let place = |k: usize| {
        let share = (Vec2::new((k % POINTS) as f32, (k / POINTS) as f32) + 0.5) / POINTS as f32;
        low + share * (high - low)
    };
    let inside = (0..POINTS * POINTS).map(place).filter(|&at| is_inside(lines, at));
    let room = |at: &Vec2| edges.iter().map(|edge| edge.distance(*at)).fold(f32::INFINITY, f32::min);
    // In a strip there is as much room anywhere: the nearer to the middle of the box, the better.
    let box_middle = (low + high) / 2.0;
    let worth = |at: &Vec2| room(at) - 0.1 * at.distance(box_middle);
    inside.max_by(|a, b| worth(a).total_cmp(&worth(b))).unwrap_or(box_middle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use amc_core::shape;

    fn square(low: f32, high: f32) -> Vec<Vec2> {
        [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Vec2::new(x, y)).to_vec()
    }

    fn area(lines: &[Vec<Vec2>]) -> f32 {
        let points: Vec<Vec2> = lines.iter().flatten().copied().collect();
        let triangle = |corners: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| points[corners[k] as usize]);
            (b - a).perp_dot(c - a).abs() / 2.0
        };
        fill(lines).chunks_exact(3).map(triangle).sum()
    }

    #[test]
    fn holes_are_left_free_and_islands_filled() {
        let hole: Vec<Vec2> = square(1.0, 2.0).into_iter().rev().collect();
        assert!((area(&[square(0.0, 4.0)]) - 16.0).abs() < 1e-4);
        assert!((area(&[square(0.0, 4.0), hole.clone()]) - 15.0).abs() < 1e-4);
        assert!((area(&[square(0.0, 4.0), hole, square(5.0, 6.0)]) - 16.0).abs() < 1e-4);
        assert!(fill(&[]).is_empty());
    }

    #[test]
    fn a_turned_piece_keeps_its_shape_its_arrow_and_its_places() {
        let garment = Arc::new(Garment::new(shape::mesh("cylinder").unwrap()).unwrap());
        let mut sheet = Sheet::new(Arc::clone(&garment), &Progress::none()).unwrap();
        let before = sheet.pieces[0].high - sheet.pieces[0].low;
        assert!(sheet.lie(|_| std::f32::consts::FRAC_PI_2) && !sheet.lie(|_| std::f32::consts::FRAC_PI_2));
        let piece = &sheet.pieces[0];
        let after = piece.high - piece.low;
        assert!((after - Vec2::new(before.y, before.x)).length() < 1e-4, "{before} {after}");
        assert!(piece.holds(piece.middle) && sheet.size.cmpgt(after).all());
        let uv = piece.uv_to_sheet.inverse().transform_point2(piece.middle);
        assert!(piece.locator.locate(&garment, uv).is_some());
        assert!(sheet.lie(|_| 0.0));
        let back = sheet.pieces[0].high - sheet.pieces[0].low;
        assert!((back - before).length() < 1e-4);
    }

    #[test]
    fn pieces_keep_their_proportions_and_do_not_touch() {
        let garment = Arc::new(Garment::new(shape::mesh("cylinder").unwrap()).unwrap());
        let one = Sheet::new(Arc::clone(&garment), &Progress::none()).unwrap();
        let piece = &one.pieces[0];
        let size = piece.high - piece.low;
        let area = garment.panels[0].area;
        assert!((size.element_product() / area - 1.0).abs() < 0.01, "{size} {area}");
        assert!(piece.holds(piece.middle));
        for along in [Vec2::X, Vec2::Y, Vec2::from_angle(0.7)] {
            let half = along * piece.half_arrow(along);
            assert!(
                half.length() > 0.0 && piece.holds(piece.middle + half) && piece.holds(piece.middle - half)
            );
        }

        let mut pieces: Vec<Piece> = (0..7).filter_map(|_| Piece::new(&garment, 0)).collect();
        let whole = lay_out(&mut pieces);
        for (k, a) in pieces.iter().enumerate() {
            assert!(a.low.min_element() > 0.0 && (whole - a.high).min_element() > 0.0);
            for b in &pieces[k + 1..] {
                assert!((a.low - b.high).max_element() > 0.0 || (b.low - a.high).max_element() > 0.0);
            }
        }
    }
}
