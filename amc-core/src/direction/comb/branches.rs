//! From powers back to directions.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::Complex;
use super::edges::ZERO;
use super::elsewhere::nearest_root;
use super::panel_mesh::PanelMesh;

/// Of the `symmetry` equal directions of each vertex one, such that neighbours agree: in each piece from the vertex
/// whose direction is nearest to the panel's `own` outwards, smooth places first (Prim's tree), so that where the field has
/// singular points the jump between unequal choices runs through rough places. Where `powers` is zero, `own` is taken.
pub(super) fn choose(mesh: &PanelMesh, powers: &[Complex], symmetry: u32, own: &[Complex]) -> Vec<Complex> {
    let mut chosen = nearest_to_own(powers, symmetry, own);
    if symmetry == 1 {
        return chosen;
    }
    let mut is_done: Vec<bool> = powers.iter().map(|&z| z == ZERO).collect();
    let mut open: BinaryHeap<(Reverse<u64>, u32, u32)> = BinaryHeap::new();
    for start in starts(mesh, &is_done, &chosen, own) {
        is_done[start as usize] = true;
        push_around(mesh, powers, symmetry, &chosen, start, &is_done, &mut open);
        while let Some((_, vertex, edge)) = open.pop() {
            if std::mem::replace(&mut is_done[vertex as usize], true) {
                continue;
            }
            let carried = carried(mesh, &chosen, edge, vertex);
            chosen[vertex as usize] = nearest_root(powers[vertex as usize], symmetry, carried);
            push_around(mesh, powers, symmetry, &chosen, vertex, &is_done, &mut open);
        }
    }
    chosen
}

/// Of the `symmetry` equal directions of each vertex the one nearest to the panel's `own`, whatever its neighbours have.
pub(super) fn nearest_to_own(powers: &[Complex], symmetry: u32, own: &[Complex]) -> Vec<Complex> {
    let nearest = |(&z, &own): (&Complex, &Complex)| {
        // A power of 1 is the direction itself.
        if z == ZERO {
            own
        } else if symmetry == 1 {
            z
        } else {
            nearest_root(z, symmetry, own)
        }
    };
    powers.par_iter().zip(own).with_min_len(4096).map(nearest).collect()
}

/// Of each piece that is not done, the vertex whose choice is nearest to its own direction.
fn starts(mesh: &PanelMesh, is_done: &[bool], chosen: &[Complex], own: &[Complex]) -> Vec<u32> {
    let mut best: Vec<Option<(f64, u32)>> = vec![None; mesh.piece_count];
    for vertex in (0..chosen.len()).filter(|&vertex| !is_done[vertex]) {
        let agreement = cosine(chosen[vertex], own[vertex]);
        let best = &mut best[mesh.pieces[vertex] as usize];
        if best.is_none_or(|(most, _)| agreement > most) {
            *best = Some((agreement, vertex as u32));
        }
    }
    best.into_iter().flatten().map(|(_, vertex)| vertex).collect()
}

/// Lets the neighbours of a vertex wait for their turn, those first whose direction differs least.
fn push_around(
    mesh: &PanelMesh,
    powers: &[Complex],
    symmetry: u32,
    chosen: &[Complex],
    vertex: u32,
    is_done: &[bool],
    open: &mut BinaryHeap<(Reverse<u64>, u32, u32)>,
) {
    for &(next, edge) in mesh.edges.around(vertex).iter().filter(|(next, _)| !is_done[*next as usize]) {
        let carried = carried(mesh, chosen, edge, next);
        let root = nearest_root(powers[next as usize], symmetry, carried);
        // The bits of positive numbers are in the order of the numbers.
        let difference = (1.0 - cosine(root, carried)).max(0.0);
        open.push((Reverse(difference.to_bits()), next, edge));
    }
}

/// The choice at the other end of an edge, carried to `vertex`.
fn carried(mesh: &PanelMesh, chosen: &[Complex], edge: u32, vertex: u32) -> Complex {
    let [low, high] = [mesh.edges.lower[edge as usize], mesh.edges.higher[edge as usize]];
    let from = if low == vertex { high } else { low };
    chosen[from as usize] * mesh.edges.turn_from(edge, from)
}

/// Of the angle between two unit numbers.
fn cosine(a: Complex, b: Complex) -> f64 {
    a.re * b.re + a.im * b.im
}
