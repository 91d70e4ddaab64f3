//! What strokes, boundary and elsewhere ask of each vertex.

use super::Complex;
use super::edges::{ZERO, power};
use super::frame::unit;
use super::lift::{Sample, lift};
use super::panel_mesh::PanelMesh;
use super::spread::{Reached, Spreader};
use super::stroke::{Comb, Elsewhere, Hold};
use crate::Result;
use crate::progress::Progress;

/// How hard a soft stroke of weight 1 pulls. Against elsewhere, which pulls with 2 / reach to the sides of a line,
/// a pull of 20 / radius is nine tenths where the two lengths are equal.
const PULL: f64 = 20.0;

/// What is asked of each vertex, as far as it lies in a piece that is asked anything by a stroke or the boundary.
#[derive(Debug)]
pub(super) struct Demands {
    /// Sums of weights.
    pub(super) weights: Vec<f64>,
    /// Sums of weights times directions to the power of the symmetry.
    pub(super) sums: Vec<Complex>,
    /// What must be, to the power of the symmetry; zero where nothing must.
    pub(super) fixed: Vec<Complex>,
    /// Per piece, whether a stroke or the boundary says anything there.
    pub(super) is_combed: Vec<bool>,
    /// Strokes that are on and say nothing: without length, off the panel, in the flat pattern of a panel without UVs.
    pub(super) unplaced: Vec<usize>,
}

impl Demands {
    /// `away` is what is asked for away from the strokes.
    pub(super) fn new(
        mesh: &PanelMesh,
        comb: &Comb,
        symmetry: u32,
        away: &[Complex],
        progress: Progress<'_>,
    ) -> Result<Self> {
        let count = mesh.positions.len();
        let mut gathered = Gathered {
            weights: vec![0.0; count],
            sums: vec![ZERO; count],
            fixed: vec![ZERO; count],
            covered: vec![0.0; count],
            turns: turns(mesh, comb.turn),
        };
        let on: Vec<usize> = (0..comb.strokes.len()).filter(|&index| comb.strokes[index].is_on).collect();
        let mut spreader = Spreader::new(mesh);
        let mut unplaced = Vec::new();
        for (done, &index) in on.iter().enumerate() {
            progress.step("placing strokes", done, on.len())?;
            let stroke = &comb.strokes[index];
            let samples: Vec<Sample> = lift(mesh, stroke, on.len());
            let reached = spreader.reach(&samples, f64::from(stroke.radius));
            if reached.is_empty() {
                unplaced.push(index);
            }
            gathered.add_stroke(mesh, &reached, stroke.hold, f64::from(stroke.radius), symmetry);
        }
        let reach = f64::from(comb.reach);
        if comb.elsewhere == Elsewhere::Boundary {
            gathered.add_boundary(mesh, reach, symmetry);
        }
        let mut is_combed = vec![false; mesh.piece_count];
        for (vertex, &piece) in mesh.pieces.iter().enumerate() {
            is_combed[piece as usize] |= gathered.weights[vertex] > 0.0 || gathered.fixed[vertex] != ZERO;
        }
        gathered.add_away(mesh, away, reach, symmetry);
        let fixed = gathered.fixed.into_iter().map(|sum| unit(sum).unwrap_or(ZERO)).collect();
        Ok(Self { weights: gathered.weights, sums: gathered.sums, fixed, is_combed, unplaced })
    }
}

struct Gathered {
    weights: Vec<f64>,
    sums: Vec<Complex>,
    fixed: Vec<Complex>,
    /// From 0 to 1: how far a vertex belongs to strokes, and so not to elsewhere.
    covered: Vec<f64>,
    /// The comb's turn at each vertex; empty: none.
    turns: Vec<Complex>,
}

/// The turn of a comb at each vertex: where the UVs are mirrored it is the other way round on the surface.
pub(super) fn turns(mesh: &PanelMesh, turn: f32) -> Vec<Complex> {
    if turn == 0.0 {
        return Vec::new();
    }
    let (sin, cos) = f64::from(turn).sin_cos();
    mesh.uv_signs().into_iter().map(|sign| Complex::new(cos, sign * sin)).collect()
}

impl Gathered {
    fn add(&mut self, vertex: u32, weight: f64, z: Complex) {
        self.weights[vertex as usize] += weight;
        self.sums[vertex as usize] += z * weight;
    }

    fn add_stroke(&mut self, mesh: &PanelMesh, reached: &[Reached], hold: Hold, radius: f64, symmetry: u32) {
        let weight = PULL * if let Hold::Soft(weight) = hold { f64::from(weight) } else { 1.0 };
        // Of several exact strokes in one triangle the nearest counts most, a twentieth of an edge being as good as none.
        let nothing = (0.05 * mesh.mean_edge).powi(2).max(1e-18);
        for found in reached {
            let vertex = found.vertex as usize;
            let z = power(self.turned(found.vertex, found.direction), symmetry);
            if found.on_line > 0.0 {
                match hold {
                    Hold::Exact => self.fixed[vertex] += z * (nothing / (found.distance.powi(2) + nothing)),
                    Hold::Soft(_) => self.add(found.vertex, weight * found.on_line / radius, z),
                }
            }
            let falloff = (1.0 - (found.distance / radius).powi(2)).max(0.0).powi(2);
            self.add(found.vertex, weight * falloff * mesh.areas[vertex] / (radius * radius), z);
            self.covered[vertex] = self.covered[vertex].max(falloff);
        }
    }

    /// The edges of one triangle, in the sense in which it goes round.
    fn add_boundary(&mut self, mesh: &PanelMesh, reach: f64, symmetry: u32) {
        for triangle in &mesh.triangles {
            for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (triangle[from], triangle[to])) {
                let Some(edge) = mesh.edges.between(from, to) else { continue };
                if mesh.edges.triangles[edge] != 1 {
                    continue;
                }
                let [start, end] = [from, to].map(|vertex| mesh.positions[vertex as usize].as_dvec3());
                let weight = PULL * 0.5 * (end - start).length() / reach;
                for vertex in [from, to] {
                    if let Some(direction) = mesh.frames[vertex as usize].direction(end - start) {
                        self.add(vertex, weight, power(self.turned(vertex, direction), symmetry));
                    }
                }
            }
        }
    }

    fn turned(&self, vertex: u32, direction: Complex) -> Complex {
        self.turns.get(vertex as usize).map_or(direction, |turn| direction * turn)
    }

    fn add_away(&mut self, mesh: &PanelMesh, away: &[Complex], reach: f64, symmetry: u32) {
        for (vertex, &direction) in (0..).zip(away) {
            if direction != ZERO {
                let left = 1.0 - self.covered[vertex as usize];
                let weight = left * mesh.areas[vertex as usize] / (reach * reach);
                self.add(vertex, weight, power(direction, symmetry));
            }
        }
    }
}
