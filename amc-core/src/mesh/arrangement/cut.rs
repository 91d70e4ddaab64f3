//! A panel's triangles cut along a line of its flat pattern.

use std::collections::HashMap;

use glam::{Vec2, Vec3};

use super::super::forest::Forest;
use super::super::{Garment, Panel};

/// Vertices this near to the line, of its length, are on it: so no slivers are cut.
const ON_LINE: f32 = 2e-4;
/// How far the cut goes on beyond the line's ends, of its length: another save of the file may have its outline elsewhere.
const BEYOND: f32 = 2e-3;

/// A panel cut in two.
pub(super) struct Cut {
    /// Its triangles, in their order.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Whether each is of the half on the left of the line (v up).
    pub(super) is_left: Vec<bool>,
    /// Vertices that follow those of the garment.
    pub(super) added: Vec<Added>,
}

/// A vertex on the line.
#[derive(Clone, Copy)]
pub(super) struct Added {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

/// A line, and where things are by it.
struct Line {
    start: Vec2,
    along: Vec2,
    length: f32,
}

impl Line {
    /// Distance to the left; zero where it is on the line.
    fn off(&self, uv: Vec2) -> f32 {
        let off = self.along.perp_dot(uv - self.start);
        if off.abs() > ON_LINE * self.length { off } else { 0.0 }
    }

    /// Whether what reaches along the line from one of these places to the other has to do with it.
    fn meets(&self, ends: &[Vec2]) -> bool {
        let share = |uv: &Vec2| self.along.dot(*uv - self.start) / self.length;
        let (low, high) = ends
            .iter()
            .map(share)
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        high > -BEYOND && low < 1.0 + BEYOND
    }
}

/// Cuts a panel, without changing the garment yet. The error says why it cannot be done.
pub(super) fn cut(garment: &Garment, panel: &Panel, [start, end]: [Vec2; 2]) -> Result<Cut, String> {
    let length = start.distance(end);
    if !(length > 0.0 && length.is_finite()) {
        return Err("the line has no length".to_owned());
    }
    let line = Line { start, along: (end - start) / length, length };
    let whole = &garment.triangles[panel.triangles.start as usize..panel.triangles.end as usize];
    let same = garment.welded(whole);
    let mut cutter =
        Cutter { garment, line, same, added: Vec::new(), on_edges: HashMap::new(), first_on: HashMap::new() };
    let mut triangles = Vec::with_capacity(whole.len() + whole.len() / 16);
    whole.iter().for_each(|&triangle| cutter.part(triangle, &mut triangles));
    if garment.positions.len() + cutter.added.len() + 3 * triangles.len() >= u32::MAX as usize {
        return Err("it would have more vertices than 32 bits can number".to_owned());
    }
    let is_left = cutter.halves(&triangles).ok_or("the line does not cut it in two")?;
    Ok(Cut { triangles, is_left, added: cutter.added.into_iter().map(|(added, _)| added).collect() })
}

struct Cutter<'a> {
    garment: &'a Garment,
    line: Line,
    /// Each vertex, and the first with the same position and UV.
    same: Vec<(u32, u32)>,
    /// What was added, and the first that was added at the same place.
    added: Vec<(Added, u32)>,
    on_edges: HashMap<(u32, u32), u32>,
    first_on: HashMap<(u32, u32), u32>,
}

impl Cutter<'_> {
    fn uv(&self, vertex: u32) -> Vec2 {
        match (vertex as usize).checked_sub(self.garment.uvs.len()) {
            None => self.garment.uvs[vertex as usize],
            Some(added) => self.added[added].0.uv,
        }
    }

    fn off(&self, vertex: u32) -> f32 {
        match (vertex as usize).checked_sub(self.garment.uvs.len()) {
            None => self.line.off(self.garment.uvs[vertex as usize]),
            Some(_) => 0.0,
        }
    }

    /// The first vertex at the same place.
    fn first(&self, vertex: u32) -> u32 {
        match (vertex as usize).checked_sub(self.garment.uvs.len()) {
            None => self.same.binary_search_by_key(&vertex, |pair| pair.0).map_or(vertex, |k| self.same[k].1),
            Some(added) => self.added[added].1,
        }
    }

    /// The triangle, or what the line makes of it, each with the turn of the whole.
    fn part(&mut self, triangle: [u32; 3], parted: &mut Vec<[u32; 3]>) {
        let off = triangle.map(|vertex| self.off(vertex));
        let has = |sign: f32| off.iter().any(|off| off * sign > 0.0);
        let is_cut = has(1.0) && has(-1.0) && self.line.meets(&self.chord(triangle, off));
        if !is_cut {
            return parted.push(triangle);
        }
        if let Some(k) = off.iter().position(|off| *off == 0.0) {
            let [on, a, b] = [0, 1, 2].map(|step| triangle[(k + step) % 3]);
            let x = self.on_edge(a, b);
            return parted.extend([[on, a, x], [on, x, b]]);
        }
        let is_alone = |k: &usize| off[*k] * off[(*k + 1) % 3] < 0.0 && off[*k] * off[(*k + 2) % 3] < 0.0;
        let alone = (0..3).find(is_alone).unwrap_or_default();
        let [l, m, n] = [0, 1, 2].map(|step| triangle[(alone + step) % 3]);
        let (x, y) = (self.on_edge(l, m), self.on_edge(n, l));
        parted.extend([[l, x, y], [x, m, n], [x, n, y]]);
    }

    /// Where the line goes through a triangle that it crosses.
    fn chord(&self, triangle: [u32; 3], off: [f32; 3]) -> Vec<Vec2> {
        let uvs = triangle.map(|vertex| self.uv(vertex));
        let crossing = |k: usize| {
            let (a, b) = (k, (k + 1) % 3);
            (off[a] * off[b] < 0.0).then(|| uvs[a].lerp(uvs[b], off[a] / (off[a] - off[b])))
        };
        let corners = (0..3).filter(|&k| off[k] == 0.0).map(|k| uvs[k]);
        (0..3).filter_map(crossing).chain(corners).collect()
    }

    /// The vertex where the line crosses an edge. Edges at the same place are crossed at the same place, to the bit.
    fn on_edge(&mut self, a: u32, b: u32) -> u32 {
        if let Some(&known) = self.on_edges.get(&(a.min(b), a.max(b))) {
            return known;
        }
        let (a, b) = if self.first(a) <= self.first(b) { (a, b) } else { (b, a) };
        let share = self.off(a) / (self.off(a) - self.off(b));
        let (from, to) = (a as usize, b as usize);
        let Garment { positions, normals, uvs, .. } = self.garment;
        let added = Added {
            position: positions[from].lerp(positions[to], share),
            normal: normals[from].lerp(normals[to], share).try_normalize().unwrap_or(normals[from]),
            uv: uvs[from].lerp(uvs[to], share),
        };
        let new = (uvs.len() + self.added.len()) as u32;
        let first = *self.first_on.entry((self.first(a), self.first(b))).or_insert(new);
        self.added.push((added, first));
        self.on_edges.insert((a.min(b), a.max(b)), new);
        new
    }

    /// Whether each triangle is left of the line; none where the line does not part them. Triangles hang together by
    /// their edges, but for those on the line; what hangs on neither side goes by where it lies.
    fn halves(&self, triangles: &[[u32; 3]]) -> Option<Vec<bool>> {
        let mut forest = Forest::new(triangles.len());
        let mut edges: HashMap<(u32, u32), u32> = HashMap::with_capacity(2 * triangles.len());
        let mut seeds = Vec::new();
        for (number, triangle) in triangles.iter().enumerate() {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|step| triangle[(k + step) % 3]);
                let is_on = self.off(a) == 0.0 && self.off(b) == 0.0;
                if is_on && self.line.meets(&[self.uv(a), self.uv(b)]) {
                    seeds.push((number as u32, self.off(c)));
                    continue;
                }
                let (a, b) = (self.first(a), self.first(b));
                match edges.entry((a.min(b), a.max(b))) {
                    std::collections::hash_map::Entry::Occupied(other) => {
                        forest.join(*other.get(), number as u32);
                    }
                    std::collections::hash_map::Entry::Vacant(place) => {
                        place.insert(number as u32);
                    }
                }
            }
        }
        let roots = forest.into_roots();
        let mut sides: HashMap<u32, bool> = HashMap::new();
        for &(number, off) in seeds.iter().filter(|seed| seed.1 != 0.0) {
            let side = *sides.entry(roots[number as usize]).or_insert(off > 0.0);
            if side != (off > 0.0) {
                return None;
            }
        }
        if !(sides.values().any(|left| *left) && sides.values().any(|left| !*left)) {
            return None;
        }
        for (triangle, root) in triangles.iter().zip(&roots) {
            let middle = || triangle.iter().map(|&vertex| self.uv(vertex)).sum::<Vec2>() / 3.0;
            sides.entry(*root).or_insert_with(|| self.line.along.perp_dot(middle() - self.line.start) > 0.0);
        }
        Some(roots.iter().map(|root| sides[root]).collect())
    }
}

/// See [`Garment::line_across`]; `lines` bound the piece.
pub(super) fn line_across(lines: &[Vec<Vec2>], [from, to]: [Vec2; 2]) -> Option<[Vec2; 2]> {
    let along = to - from;
    let sides = lines.iter().flat_map(|line| (0..line.len()).map(|k| (line[k], line[(k + 1) % line.len()])));
    let crossing = |(a, b): (Vec2, Vec2)| {
        let (off_a, off_b) = (along.perp_dot(a - from), along.perp_dot(b - from));
        let at = a.lerp(b, off_a / (off_a - off_b));
        ((off_a > 0.0) != (off_b > 0.0)).then(|| along.dot(at - from) / along.length_squared())
    };
    let mut shares: Vec<f32> = sides.filter_map(crossing).filter(|share| share.is_finite()).collect();
    shares.sort_by(f32::total_cmp);
    // Between the first crossing and the second it is on the cloth, and so on.
    let off = |stretch: &&[f32]| (stretch[0] - 0.5).max(0.5 - stretch[1]).max(0.0);
    let best = shares.chunks_exact(2).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let ends = [best[0], best[1]].map(|share| from + along * share);
    (ends[0] != ends[1]).then_some(ends)
}
