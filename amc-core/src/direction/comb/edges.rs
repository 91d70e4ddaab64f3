//! The edges of a panel's mesh: smoothness weights, and how tangents are carried along them.

use std::ops::Range;

use faer::c64;
use glam::{DVec3, Vec3};

use super::Complex;
use super::frame::Frame;

/// Bounds of an edge's weight: slivers neither tear the field apart nor hold it together.
const WEIGHTS: (f64, f64) = (1e-3, 20.0);

/// Edges between vertices, each once, sorted by the higher vertex, then the lower: the upper half of a symmetric matrix.
#[derive(Debug)]
pub(super) struct Edges {
    /// Where the edges of each higher vertex start; one more than vertices.
    pub(super) starts: Vec<u32>,
    pub(super) lower: Vec<u32>,
    pub(super) higher: Vec<u32>,
    /// Half the sum of the opposite angles' cotangents, held positive.
    pub(super) weights: Vec<f64>,
    /// From coordinates at the lower vertex to those at the higher.
    pub(super) turns: Vec<Complex>,
    /// Number of triangles on it.
    pub(super) triangles: Vec<u32>,
    around_starts: Vec<u32>,
    around: Vec<(u32, u32)>,
}

impl Edges {
    /// Of triangles between `frames.len()` vertices; corners that are the same vertex have no edge.
    pub(super) fn new(positions: &[Vec3], frames: &[Frame], triangles: &[[u32; 3]]) -> Self {
        let mut edges = Self::connect(frames.len(), triangles);
        edges.weigh(positions, triangles);
        edges.turns = (0..edges.lower.len())
            .map(|edge| {
                let [low, high] = [edges.lower[edge], edges.higher[edge]].map(|vertex| vertex as usize);
                let along = (positions[high] - positions[low]).as_dvec3();
                frames[low].turn_to(&frames[high], along)
            })
            .collect();
        edges
    }

    fn connect(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        // Sorted into the buckets of the higher vertex, where few are left to be sorted.
        let mut starts = vec![0u32; vertices + 1];
        for (low, high) in triangles.iter().flat_map(sides) {
            starts[high as usize + 1] += u32::from(low != high);
        }
        sum_up(&mut starts);
        let mut next = starts.clone();
        let mut bucketed = vec![0u32; starts[vertices] as usize];
        for (low, high) in triangles.iter().flat_map(sides).filter(|(low, high)| low != high) {
            bucketed[next[high as usize] as usize] = low;
            next[high as usize] += 1;
        }
        let (mut lower, mut higher, mut counts) = (Vec::new(), Vec::new(), Vec::new());
        let mut edge_starts = Vec::with_capacity(vertices + 1);
        for vertex in 0..vertices {
            edge_starts.push(lower.len() as u32);
            let bucket = &mut bucketed[starts[vertex] as usize..starts[vertex + 1] as usize];
            bucket.sort_unstable();
            for same in bucket.chunk_by(|a, b| a == b) {
                lower.push(same[0]);
                higher.push(vertex as u32);
                counts.push(same.len() as u32);
            }
        }
        edge_starts.push(lower.len() as u32);
        let (around_starts, around) = around(vertices, &lower, &higher);
        Self {
            starts: edge_starts,
            weights: vec![0.0; lower.len()],
            lower,
            higher,
            turns: Vec::new(),
            triangles: counts,
            around_starts,
            around,
        }
    }

    fn weigh(&mut self, positions: &[Vec3], triangles: &[[u32; 3]]) {
        for triangle in triangles {
            let corners = triangle.map(|vertex| positions[vertex as usize].as_dvec3());
            for k in 0..3 {
                let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                if let Some(edge) = self.between(triangle[next], triangle[last]) {
                    self.weights[edge] +=
                        0.5 * cotangent(corners[next] - corners[k], corners[last] - corners[k]);
                }
            }
        }
        for weight in &mut self.weights {
            *weight = weight.clamp(WEIGHTS.0, WEIGHTS.1);
        }
    }

    pub(super) fn count(&self) -> usize {
        self.lower.len()
    }

    /// The edge between two vertices.
    pub(super) fn between(&self, a: u32, b: u32) -> Option<usize> {
        let (low, high) = (a.min(b), a.max(b) as usize);
        let (start, end) = (self.starts[high] as usize, self.starts[high + 1] as usize);
        self.lower[start..end].iter().position(|&lower| lower == low).map(|place| start + place)
    }

    /// The vertices around one, each with the edge to it.
    pub(super) fn around(&self, vertex: u32) -> &[(u32, u32)] {
        &self.around[self.places_around(vertex as usize)]
    }

    /// Where what lies around a vertex stands when all vertices' is put in a row.
    pub(super) fn places_around(&self, vertex: usize) -> Range<usize> {
        self.around_starts[vertex] as usize..self.around_starts[vertex + 1] as usize
    }

    /// What takes coordinates at `from`, one end of `edge`, to those at its other end.
    pub(super) fn turn_from(&self, edge: u32, from: u32) -> Complex {
        let turn = self.turns[edge as usize];
        if self.lower[edge as usize] == from { turn } else { turn.conj() }
    }
}

/// The sides of a triangle, lower vertex first.
fn sides(triangle: &[u32; 3]) -> [(u32, u32); 3] {
    let [a, b, c] = *triangle;
    [(a.min(b), a.max(b)), (b.min(c), b.max(c)), (c.min(a), c.max(a))]
}

/// Replaces counts, each one place further on than what it counts, by where each starts.
fn sum_up(counts: &mut [u32]) {
    let mut sum = 0;
    for count in counts {
        sum += *count;
        *count = sum;
    }
}

fn around(vertices: usize, lower: &[u32], higher: &[u32]) -> (Vec<u32>, Vec<(u32, u32)>) {
    let mut starts = vec![0u32; vertices + 1];
    for &vertex in lower.iter().chain(higher) {
        starts[vertex as usize + 1] += 1;
    }
    sum_up(&mut starts);
    let mut next = starts.clone();
    let mut around = vec![(0, 0); 2 * lower.len()];
    for (edge, (&low, &high)) in lower.iter().zip(higher).enumerate() {
        for (from, to) in [(low, high), (high, low)] {
            around[next[from as usize] as usize] = (to, edge as u32);
            next[from as usize] += 1;
        }
    }
    (starts, around)
}

/// Of the angle between two vectors; zero where they have none.
fn cotangent(a: DVec3, b: DVec3) -> f64 {
    let cotangent = a.dot(b) / a.cross(b).length();
    if cotangent.is_nan() { 0.0 } else { cotangent.clamp(-WEIGHTS.1, WEIGHTS.1) }
}

/// A number to the power of the symmetry.
pub(super) fn power(z: Complex, symmetry: u32) -> Complex {
    (1..symmetry).fold(z, |product, _| product * z)
}

/// Zero.
pub(super) const ZERO: Complex = c64::new(0.0, 0.0);
