//! What a pattern says of a panel's halves.

use glam::Vec2;

use super::super::{Garment, Panel, PatternPiece, Seam};
use super::cut::Cut;

/// What the seam between two halves is called.
const CUT: &str = "cut";
/// An end of the line this near to a seam, of the line's length, is on it.
const ON_SEAM: f32 = 1e-2;
/// Less of a seam than this is none.
const LEAST: f32 = 1e-3;

/// The lines that bound a panel in the flat pattern, the cloth on their left (v up).
pub(super) fn lines(garment: &Garment, panel: &Panel) -> Vec<Vec<Vec2>> {
    let place = |line: Vec<u32>| line.iter().map(|&vertex| garment.uvs[vertex as usize]).collect();
    let mut lines: Vec<Vec<Vec2>> = garment.outlines(panel).into_iter().map(place).collect();
    let area = |line: &Vec<Vec2>| -> f32 {
        (0..line.len()).map(|k| line[k].perp_dot(line[(k + 1) % line.len()])).sum()
    };
    // The longest line bounds the piece; holes run the other way.
    if lines.first().is_some_and(|line| area(line) < 0.0) {
        lines.iter_mut().for_each(|line| line.reverse());
    }
    lines
}

/// The patterns of all panels once `panel` has been cut in two: the left half in its place, the right one after it. Seams that go on
/// beyond the cut are parted there, here and across.
pub(super) fn of_halves(
    garment: &Garment,
    panel: usize,
    line: [Vec2; 2],
    cut: &Cut,
) -> Vec<PatternPiece<usize>> {
    let place = |number: usize| number + usize::from(number > panel);
    let count = garment.panels.len();
    let mut patterns: Vec<PatternPiece<usize>> = vec![PatternPiece::default(); count + 1];
    for (number, from) in garment.panels.iter().enumerate() {
        let pattern = PatternPiece { seams: Vec::new(), mirror: None, ..from.pattern };
        let mirror = from.pattern.mirror.filter(|&partner| partner != panel && number != panel);
        patterns[place(number)] = PatternPiece { mirror: mirror.map(place), ..pattern.clone() };
        if number == panel {
            patterns[panel + 1] = pattern;
        }
    }
    let halves = Halves { garment, lines: lines(garment, &garment.panels[panel]), line, cut };
    for (number, from) in garment.panels.iter().enumerate() {
        for seam in &from.pattern.seams {
            for (owner, seam) in halves.parted(panel, number, seam) {
                patterns[owner].seams.push(seam);
            }
        }
    }
    let [a, b] = line;
    let between =
        |edge: [Vec2; 2], partner: usize| Seam { name: CUT.to_owned(), edge, partner, partner_edge: edge };
    patterns[panel].seams.push(between([a, b], panel + 1));
    patterns[panel + 1].seams.push(between([b, a], panel));
    patterns
}

struct Halves<'a> {
    garment: &'a Garment,
    /// Round the panel.
    lines: Vec<Vec<Vec2>>,
    line: [Vec2; 2],
    cut: &'a Cut,
}

/// A stretch of a seam on one half.
struct Stretch {
    is_left: bool,
    /// From which share of the seam's length to which.
    shares: [f32; 2],
}

impl Halves<'_> {
    /// A seam of the panel `owner` as it is once `panel` is cut: whose it is then, and how it runs.
    fn parted(&self, panel: usize, owner: usize, seam: &Seam<usize>) -> Vec<(usize, Seam<usize>)> {
        let half = |is_left: bool| panel + usize::from(!is_left);
        let place = |number: usize| number + usize::from(number > panel);
        if owner != panel && seam.partner != panel {
            return vec![(place(owner), Seam { partner: place(seam.partner), ..seam.clone() })];
        }
        let lines_of = |number: usize| match number == panel {
            true => self.lines.clone(),
            false => lines(self.garment, &self.garment.panels[number]),
        };
        let here = run(&lines_of(owner), seam.edge);
        // The ends across stand in the same order, so the way there is clockwise.
        let [first, second] = seam.partner_edge;
        let mut across = run(&lines_of(seam.partner), [second, first]);
        across.reverse();
        let whole = || vec![Stretch { is_left: true, shares: [0.0, 1.0] }];
        let owners = if owner == panel { self.stretches(&here) } else { whole() };
        let partners = if seam.partner == panel { self.stretches(&across) } else { whole() };
        let mut parted = Vec::new();
        for (a, b) in owners.iter().flat_map(|a| partners.iter().map(move |b| (a, b))) {
            let (from, to) = (a.shares[0].max(b.shares[0]), a.shares[1].min(b.shares[1]));
            if to - from < LEAST {
                continue;
            }
            let is_whole = (from, to) == (0.0, 1.0);
            let ends = |line: &[Vec2], ends: [Vec2; 2]| {
                if is_whole { ends } else { [from, to].map(|share| at_share(line, share)) }
            };
            let seam = Seam {
                name: seam.name.clone(),
                edge: ends(&here, seam.edge),
                partner: if seam.partner == panel { half(b.is_left) } else { place(seam.partner) },
                partner_edge: ends(&across, seam.partner_edge),
            };
            parted.push((if owner == panel { half(a.is_left) } else { place(owner) }, seam));
        }
        parted
    }

    /// How a way along the panel's outline is shared out to its halves.
    fn stretches(&self, way: &[Vec2]) -> Vec<Stretch> {
        let near = ON_SEAM * self.line[0].distance(self.line[1]);
        let on_way = self.line.iter().filter_map(|&end| share_at(way, end, near));
        let mut shares: Vec<f32> = on_way.filter(|share| (LEAST..1.0 - LEAST).contains(share)).collect();
        shares.sort_by(f32::total_cmp);
        let ends: Vec<f32> = std::iter::once(0.0).chain(shares).chain([1.0]).collect();
        let stretch = |ends: &[f32]| Stretch {
            is_left: self.is_left(at_share(way, (ends[0] + ends[1]) / 2.0)),
            shares: [ends[0], ends[1]],
        };
        ends.windows(2).filter(|ends| ends[1] - ends[0] >= LEAST).map(stretch).collect()
    }

    /// The half that a place of the flat pattern is nearest to.
    fn is_left(&self, at: Vec2) -> bool {
        let uv = |vertex: u32| match (vertex as usize).checked_sub(self.garment.uvs.len()) {
            None => self.garment.uvs[vertex as usize],
            Some(added) => self.cut.added[added].uv,
        };
        let off = |triangle: &[u32; 3]| triangle.iter().map(|&it| uv(it)).sum::<Vec2>() / 3.0 - at;
        let found = self.cut.triangles.iter().zip(&self.cut.is_left);
        let nearest = found.min_by(|a, b| off(a.0).length_squared().total_cmp(&off(b.0).length_squared()));
        nearest.is_none_or(|(_, is_left)| *is_left)
    }
}

/// The way along the lines between the points nearest to two ends; both ends alone where there is none.
fn run(lines: &[Vec<Vec2>], ends: [Vec2; 2]) -> Vec<Vec2> {
    let nearest = |line: &[Vec2], end: Vec2| {
        let distance = |k: &usize| line[*k].distance_squared(end);
        (0..line.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let off = |line: &&Vec<Vec2>| {
        ends.iter()
            .map(|&end| nearest(line, end).map_or(f32::INFINITY, |k| line[k].distance(end)))
            .sum::<f32>()
    };
    let Some(line) = lines.iter().min_by(|a, b| off(a).total_cmp(&off(b))) else { return ends.to_vec() };
    match ends.map(|end| nearest(line, end)) {
        [Some(first), Some(last)] if first != last => {
            let count = (last + line.len() - first) % line.len();
            (0..=count).map(|k| line[(first + k) % line.len()]).collect()
        }
        _ => ends.to_vec(),
    }
}

fn length(way: &[Vec2]) -> f32 {
    way.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}

/// The place after a share of the way.
fn at_share(way: &[Vec2], share: f32) -> Vec2 {
    let mut left = share * length(way);
    for ends in way.windows(2) {
        let side = ends[0].distance(ends[1]);
        if left <= side && side > 0.0 {
            return ends[0].lerp(ends[1], left / side);
        }
        left -= side;
    }
    way.last().copied().unwrap_or_default()
}

/// The share of the way after which it is nearest to a place; none where it comes no nearer than `near`.
fn share_at(way: &[Vec2], at: Vec2, near: f32) -> Option<f32> {
    let (mut gone, mut best) = (0.0, (near, None));
    for ends in way.windows(2) {
        let side = ends[1] - ends[0];
        let share = ((at - ends[0]).dot(side) / side.length_squared()).clamp(0.0, 1.0);
        let share = if share.is_finite() { share } else { 0.0 };
        let off = at.distance(ends[0] + side * share);
        if off <= best.0 {
            best = (off, Some(gone + share * side.length()));
        }
        gone += side.length();
    }
    best.1.map(|at| at / gone).filter(|share| share.is_finite())
}
