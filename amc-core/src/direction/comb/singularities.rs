//! Where a field has no direction.

use std::f64::consts::TAU;

use super::Complex;
use super::edges::{ZERO, power};
use super::panel_mesh::PanelMesh;

/// A triangle around which the field turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Singularity {
    /// Its number in the garment.
    pub triangle: u32,
    /// Turns of the field on the way round it, counter-clockwise: a multiple of 1 / symmetry. Over a closed surface they sum to
    /// its Euler characteristic, 2 for a sphere.
    pub index: f32,
}

/// The singular triangles of a field of unit powers, in order; zero where a piece has no field to look at.
pub(super) fn singularities(mesh: &PanelMesh, powers: &[Complex], symmetry: u32) -> Vec<Singularity> {
    let edges = &mesh.edges;
    // Each edge is asked once, so that its two triangles see opposite turns and the sum is what it must be.
    let turns: Vec<f64> = (0..edges.count())
        .map(|edge| {
            let [low, high] = [edges.lower[edge], edges.higher[edge]].map(|vertex| powers[vertex as usize]);
            angle(high * (power(edges.turns[edge], symmetry) * low).conj())
        })
        .collect();
    let mut found = Vec::new();
    for (&triangle, number) in mesh.triangles.iter().zip(mesh.first_triangle..) {
        if powers[triangle[0] as usize] == ZERO {
            continue;
        }
        let (mut sum, mut carried) = (0.0, faer::c64::new(1.0, 0.0));
        for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (triangle[from], triangle[to])) {
            let Some(edge) = edges.between(from, to) else { continue };
            sum += if from < to { turns[edge] } else { -turns[edge] };
            carried *= edges.turn_from(edge as u32, from);
        }
        let index = ((sum + angle(carried) * f64::from(symmetry)) / TAU).round();
        if index != 0.0 {
            found.push(Singularity { triangle: number, index: (index / f64::from(symmetry)) as f32 });
        }
    }
    found
}

fn angle(z: Complex) -> f64 {
    z.im.atan2(z.re)
}
