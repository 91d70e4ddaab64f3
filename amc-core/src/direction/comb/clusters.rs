//! A large panel's field, roughly and soon.

use std::collections::VecDeque;

use faer::{c32, c64};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Complex;
use super::couplings::Couplings;
use super::demands::Demands;
use super::edges::{ZERO, power};
use super::frame::unit;
use super::nearest::{Bounds, morton};
use super::panel_mesh::PanelMesh;
use super::system::System;
use crate::Result;

/// About how many clusters a piece of cloth is taken for.
const CLUSTERS: usize = 2_500;
/// Sweeps over the vertices after the clusters are solved.
const SWEEPS: usize = 6;
/// How much more a fixed vertex weighs than an edge.
const FIXED: f64 = 100.0;
/// Not reached.
const NONE: u32 = u32::MAX;

/// Connected clusters of vertices, alike in size, each with one direction that is carried from its first vertex to the others.
#[derive(Debug)]
pub(super) struct Clusters {
    of_vertex: Vec<u32>,
    /// From the cluster's coordinates to the vertex's.
    carries: Vec<Complex>,
    /// The edges between clusters, by the pair's place in the system, with their part in the conductance between the two:
    /// the weight, by how far the edge goes along the way from middle to middle.
    across: Vec<(u32, u32, f64)>,
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// Edges from one side of a cluster to the other.
    width: f64,
    system: System,
    /// Of the symmetry asked for last.
    couplings: Option<Couplings>,
}

impl Clusters {
    /// # Errors
    /// Too little memory.
    pub(super) fn new(mesh: &PanelMesh) -> Result<Self> {
        let (of_vertex, carries, count) = grow(mesh);
        let mut between: Vec<(u64, u32)> = Vec::new();
        for edge in 0..mesh.edges.count() {
            let [a, b] =
                [mesh.edges.lower[edge], mesh.edges.higher[edge]].map(|vertex| of_vertex[vertex as usize]);
            if a != b {
                between.push((u64::from(a.max(b)) << 32 | u64::from(a.min(b)), edge as u32));
            }
        }
        between.par_sort_unstable();
        let middles = middles(mesh, &of_vertex, count);
        let (mut starts, mut rows) = (vec![0u32; count + 1], Vec::new());
        let mut across = Vec::with_capacity(between.len());
        for pair in between.chunk_by(|a, b| a.0 == b.0) {
            let place = rows.len() as u32;
            across.extend(
                pair.iter().map(|&(_, edge)| (edge, place, conductance(mesh, &of_vertex, &middles, edge))),
            );
            rows.push(pair[0].0 as u32);
            starts[(pair[0].0 >> 32) as usize + 1] = rows.len() as u32;
        }
        for column in 1..=count {
            starts[column] = starts[column].max(starts[column - 1]);
        }
        let system = System::new(&starts, &rows)?;
        let width = (of_vertex.len() as f64 / count.max(1) as f64).sqrt();
        Ok(Self { of_vertex, carries, across, starts, rows, width, system, couplings: None })
    }

    /// The field to the power of the symmetry, unit numbers; zero in pieces that are not combed.
    ///
    /// # Errors
    /// Those of [`System`].
    pub(super) fn powers(
        &mut self,
        mesh: &PanelMesh,
        demands: &Demands,
        symmetry: u32,
    ) -> Result<Vec<Complex>> {
        let carries: Vec<Complex> = self.carries.par_iter().map(|&carry| power(carry, symmetry)).collect();
        let (values, mut right) = self.assemble(mesh, demands, symmetry, &carries);
        self.system.factor(values)?;
        self.system.solve(&mut right)?;
        let is_combed = |vertex: usize| demands.is_combed[mesh.pieces[vertex] as usize];
        let of_cluster = |vertex: usize| {
            let mut z = demands.fixed[vertex];
            if z == ZERO && is_combed(vertex) {
                let of_cluster = unit(right[self.of_vertex[vertex] as usize]).unwrap_or(c64::new(1.0, 0.0));
                z = carries[vertex] * of_cluster;
            }
            c32::new(z.re as f32, z.im as f32)
        };
        let field: Vec<c32> = (0..carries.len()).into_par_iter().map(of_cluster).collect();
        // What is shorter than a cluster's width.
        let least = 2.0 / self.width.powi(2).max(4.0) as f32;
        let couplings = match self.couplings.take().filter(|kept| kept.symmetry == symmetry) {
            Some(kept) => self.couplings.insert(kept),
            None => self.couplings.insert(Couplings::new(mesh, symmetry)),
        };
        Ok(couplings.smooth(mesh, demands, field, least, SWEEPS))
    }

    fn assemble(
        &self,
        mesh: &PanelMesh,
        demands: &Demands,
        symmetry: u32,
        carries: &[Complex],
    ) -> (Vec<Complex>, Vec<Complex>) {
        let count = self.starts.len() - 1;
        let (mut diagonal, mut right) = (vec![0.0; count], vec![ZERO; count]);
        for (vertex, &cluster) in self.of_vertex.iter().enumerate() {
            let fixed = demands.fixed[vertex];
            let weight = if fixed == ZERO { 0.0 } else { FIXED };
            diagonal[cluster as usize] += demands.weights[vertex] + weight;
            right[cluster as usize] += carries[vertex].conj() * (demands.sums[vertex] + fixed * weight);
            if !demands.is_combed[mesh.pieces[vertex] as usize] {
                diagonal[cluster as usize] += 1.0;
            }
        }
        let mut pairs = vec![ZERO; self.rows.len()];
        for &(edge, pair, weight) in &self.across {
            let [low, high] =
                [mesh.edges.lower[edge as usize], mesh.edges.higher[edge as usize]].map(|v| v as usize);
            let turn = power(mesh.edges.turns[edge as usize], symmetry);
            let carried = carries[high].conj() * turn * carries[low] * weight;
            let [of_low, of_high] = [low, high].map(|vertex| self.of_vertex[vertex] as usize);
            diagonal[of_low] += weight;
            diagonal[of_high] += weight;
            pairs[pair as usize] -= if of_low < of_high { carried.conj() } else { carried };
        }
        let mut values = Vec::with_capacity(pairs.len() + count);
        for column in 0..count {
            values.extend_from_slice(&pairs[self.starts[column] as usize..self.starts[column + 1] as usize]);
            values.push(c64::new(diagonal[column], 0.0));
        }
        (values, right)
    }
}

/// The cluster of each vertex, how it is carried there, and how many clusters there are: grown edge by edge from
/// vertices spread evenly along a curve that fills space.
fn grow(mesh: &PanelMesh) -> (Vec<u32>, Vec<Complex>, usize) {
    let count = mesh.positions.len();
    let (mut of_vertex, mut carries) = (vec![NONE; count], vec![ZERO; count]);
    let mut clusters = 0;
    let mut open = VecDeque::new();
    let step = (count / CLUSTERS).max(1);
    let seeds: Vec<u32> = along_curve(&mesh.positions).into_iter().skip(step / 2).step_by(step).collect();
    // Whatever the seeds do not reach is a piece of its own.
    for seeds in std::iter::once(seeds).chain((0..count as u32).map(|vertex| vec![vertex])) {
        for seed in seeds {
            if of_vertex[seed as usize] == NONE {
                of_vertex[seed as usize] = clusters;
                carries[seed as usize] = c64::new(1.0, 0.0);
                clusters += 1;
                open.push_back(seed);
            }
        }
        while let Some(vertex) = open.pop_front() {
            for &(next, edge) in mesh.edges.around(vertex) {
                if of_vertex[next as usize] == NONE {
                    of_vertex[next as usize] = of_vertex[vertex as usize];
                    carries[next as usize] = mesh.edges.turn_from(edge, vertex) * carries[vertex as usize];
                    open.push_back(next);
                }
            }
        }
    }
    (of_vertex, carries, clusters as usize)
}

fn middles(mesh: &PanelMesh, of_vertex: &[u32], count: usize) -> Vec<DVec3> {
    let (mut sums, mut sizes) = (vec![DVec3::ZERO; count], vec![0.0f64; count]);
    for (position, &cluster) in mesh.positions.iter().zip(of_vertex) {
        sums[cluster as usize] += position.as_dvec3();
        sizes[cluster as usize] += 1.0;
    }
    sums.into_iter().zip(sizes).map(|(sum, size)| sum / size.max(1.0)).collect()
}

/// A difference of a cluster's direction from the next stands for a slope over the way between their middles, of which
/// an edge across the border sees its own part.
fn conductance(mesh: &PanelMesh, of_vertex: &[u32], middles: &[DVec3], edge: u32) -> f64 {
    let [low, high] = [mesh.edges.lower[edge as usize], mesh.edges.higher[edge as usize]].map(|v| v as usize);
    let along = (mesh.positions[high] - mesh.positions[low]).as_dvec3();
    let way = middles[of_vertex[high] as usize] - middles[of_vertex[low] as usize];
    let part = along.dot(way) / way.length_squared();
    let part = if part.is_nan() { 1.0 } else { part.clamp(1e-3, 1.0) };
    mesh.edges.weights[edge as usize] * part
}

fn along_curve(positions: &[Vec3]) -> Vec<u32> {
    let bounds = Bounds::of(positions);
    let mut order: Vec<(u64, u32)> = positions
        .iter()
        .zip(0..)
        .map(|(&position, vertex)| (morton(bounds.scaled(position)), vertex))
        .collect();
    order.par_sort_unstable();
    order.into_iter().map(|(_, vertex)| vertex).collect()
}
