//! What a stroke says to the vertices round it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Complex;
use super::lift::Sample;
use super::panel_mesh::PanelMesh;

/// Shares of a triangle's corner below this count as none.
const LEAST_SHARE: f32 = 1e-4;

/// A vertex that a stroke reaches.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    pub(super) vertex: u32,
    /// Metres to the nearest point of the stroke.
    pub(super) distance: f64,
    /// The stroke's direction there, carried to the vertex, in its frame; a unit number.
    pub(super) direction: Complex,
    /// Metres of the stroke that lie on the triangles round the vertex, by their barycentric shares.
    pub(super) on_line: f64,
    sample: u32,
}

/// Finds the vertices within a radius of strokes, one stroke after the other.
pub(super) struct Spreader<'a> {
    mesh: &'a PanelMesh,
    /// Where in the result each vertex is.
    slots: Vec<u32>,
}

/// Not reached.
const NONE: u32 = u32::MAX;

impl<'a> Spreader<'a> {
    pub(super) fn new(mesh: &'a PanelMesh) -> Self {
        Self { mesh, slots: vec![NONE; mesh.positions.len()] }
    }

    /// The corners of the triangles that a stroke crosses, and the vertices within `radius` of it, as far as they hang
    /// together: from vertex to vertex the nearest point of the stroke is handed on, and its direction carried.
    pub(super) fn reach(&mut self, samples: &[Sample], radius: f64) -> Vec<Reached> {
        let mut reached: Vec<Reached> = Vec::new();
        for (sample, number) in samples.iter().zip(0..) {
            for (&vertex, share) in self.mesh.triangles[sample.triangle as usize].iter().zip(sample.shares) {
                self.start(&mut reached, vertex, sample, number);
                let slot = self.slots[vertex as usize];
                if slot != NONE && share > LEAST_SHARE {
                    reached[slot as usize].on_line += f64::from(share) * sample.length;
                }
            }
        }
        self.grow(&mut reached, samples, radius);
        for reached in &reached {
            self.slots[reached.vertex as usize] = NONE;
        }
        reached
    }

    /// Lets a corner of a sample's triangle know of it.
    fn start(&mut self, reached: &mut Vec<Reached>, vertex: u32, sample: &Sample, number: u32) {
        let distance = (self.mesh.positions[vertex as usize].as_dvec3() - sample.position).length();
        let slot = self.slots[vertex as usize];
        if slot != NONE && reached[slot as usize].distance <= distance {
            return;
        }
        let Some(direction) = self.mesh.frames[vertex as usize].direction(sample.direction) else { return };
        if slot == NONE {
            self.slots[vertex as usize] = reached.len() as u32;
            reached.push(Reached { vertex, distance, direction, on_line: 0.0, sample: number });
        } else {
            let reached = &mut reached[slot as usize];
            *reached = Reached { distance, direction, sample: number, ..*reached };
        }
    }

    fn grow(&mut self, reached: &mut Vec<Reached>, samples: &[Sample], radius: f64) {
        // The bits of positive numbers are in the order of the numbers.
        let entry = |distance: f64, slot: u32| Reverse((distance.to_bits(), slot));
        let starts = reached.iter().zip(0..).map(|(reached, slot)| entry(reached.distance, slot));
        let mut open: BinaryHeap<_> = starts.collect();
        while let Some(Reverse((bits, slot))) = open.pop() {
            let from = reached[slot as usize];
            if from.distance.to_bits() != bits {
                continue;
            }
            for &(vertex, edge) in self.mesh.edges.around(from.vertex) {
                let at = self.mesh.positions[vertex as usize].as_dvec3();
                let distance = (at - samples[from.sample as usize].position).length();
                let slot = self.slots[vertex as usize];
                if distance > radius || (slot != NONE && reached[slot as usize].distance <= distance) {
                    continue;
                }
                let direction = from.direction * self.mesh.edges.turn_from(edge, from.vertex);
                let on_line = if slot == NONE { 0.0 } else { reached[slot as usize].on_line };
                let found = Reached { vertex, distance, direction, on_line, sample: from.sample };
                if slot == NONE {
                    self.slots[vertex as usize] = reached.len() as u32;
                    open.push(entry(distance, reached.len() as u32));
                    reached.push(found);
                } else {
                    reached[slot as usize] = found;
                    open.push(entry(distance, slot));
                }
            }
        }
    }
}
