//! The smoothness between neighbours, packed for many quick sweeps.

use faer::{c32, c64};
use rayon::prelude::*;

use super::Complex;
use super::demands::Demands;
use super::edges::{ZERO, power};
use super::frame::unit;
use super::panel_mesh::PanelMesh;

/// Vertices that one task takes at least.
const CHUNK: usize = 4096;

/// For each vertex its neighbours, and what takes their powers to it, times the edge's weight.
#[derive(Debug)]
pub(super) struct Couplings {
    pub(super) symmetry: u32,
    /// Vertex by vertex, as [`super::edges::Edges::around`].
    around: Vec<(u32, c32)>,
    /// Sums of the edges' weights.
    weights: Vec<f32>,
}

impl Couplings {
    pub(super) fn new(mesh: &PanelMesh, symmetry: u32) -> Self {
        let edges = &mesh.edges;
        let vertices = 0..mesh.positions.len() as u32;
        let around = |vertex: u32| {
            edges.around(vertex).iter().map(move |&(next, edge)| {
                let carried = power(edges.turn_from(edge, next), symmetry) * edges.weights[edge as usize];
                (next, c32::new(carried.re as f32, carried.im as f32))
            })
        };
        let weight = |vertex: u32| -> f64 {
            edges.around(vertex).iter().map(|&(_, edge)| edges.weights[edge as usize]).sum()
        };
        Self {
            symmetry,
            weights: vertices.clone().into_par_iter().map(|vertex| weight(vertex) as f32).collect(),
            around: vertices.flat_map(around).collect(),
        }
    }

    /// Smooths a field, zero where a vertex is not combed: Chebyshev's iteration (Y. Saad, "Iterative Methods for Sparse
    /// Linear Systems", 12.3) on the part of the spectrum above `least`, from 0 to 2. Gives unit numbers.
    pub(super) fn smooth(
        &self,
        mesh: &PanelMesh,
        demands: &Demands,
        mut field: Vec<c32>,
        least: f32,
        sweeps: usize,
    ) -> Vec<Complex> {
        // The eigenvalues of a matrix with a dominant diagonal, divided by it, are at most 2.
        let (middle, half) = ((2.0 + least) / 2.0, (2.0 - least) / 2.0);
        let sigma = middle / half;
        let mut rho = 1.0 / sigma;
        let mut steps = vec![c32::new(0.0, 0.0); field.len()];
        let mut factors = (0.0, 1.0 / middle);
        for _ in 0..sweeps {
            let before = &field;
            steps.par_iter_mut().enumerate().with_min_len(CHUNK).for_each(|(vertex, step)| {
                *step = *step * factors.0 + self.correction(mesh, demands, before, vertex) * factors.1;
            });
            field.par_iter_mut().zip(&steps).with_min_len(CHUNK).for_each(|(z, step)| *z += step);
            let next = 1.0 / (2.0 * sigma - rho);
            factors = (next * rho, 2.0 * next / half);
            rho = next;
        }
        let whole = |z: c32| match c64::new(f64::from(z.re), f64::from(z.im)) {
            ZERO => ZERO,
            z => unit(z).unwrap_or(c64::new(1.0, 0.0)),
        };
        field.into_par_iter().with_min_len(CHUNK).map(whole).collect()
    }

    /// What is missing at a vertex from what its neighbours and the demands ask for; nothing where it is fixed or not combed.
    fn correction(&self, mesh: &PanelMesh, demands: &Demands, field: &[c32], vertex: usize) -> c32 {
        let here = field[vertex];
        if demands.fixed[vertex] != ZERO || (here.re == 0.0 && here.im == 0.0) {
            return c32::new(0.0, 0.0);
        }
        let asked = demands.sums[vertex];
        let mut sum = c32::new(asked.re as f32, asked.im as f32);
        for &(next, coupling) in &self.around[mesh.edges.places_around(vertex)] {
            sum += coupling * field[next as usize];
        }
        let weight = demands.weights[vertex] as f32 + self.weights[vertex];
        if weight > 0.0 { sum / weight - here } else { c32::new(0.0, 0.0) }
    }
}
