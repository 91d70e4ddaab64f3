//! A cut garment as particles and constraints.

use std::collections::BTreeMap;

use glam::DVec3;

use super::colour::Coloured;
use super::hinge::Hinge;
use super::membrane::Membrane;
use crate::cut::{At, CutGarment, CutPiece};
use crate::pattern::Cloth;

/// Particles that stand for the vertices of a garment; sewn vertices share one.
#[derive(Debug)]
pub(super) struct Model {
    /// `[piece][vertex]`: the particle.
    pub(super) particle_of: Vec<Vec<u32>>,
    /// Kilograms.
    pub(super) mass: Vec<f64>,
    /// 1/kilograms; 0 for one that nothing moves.
    pub(super) inverse_mass: Vec<f64>,
    /// All pieces' triangles with area, as particles.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) membranes: Coloured<Membrane>,
    pub(super) hinges: Coloured<Hinge>,
    /// Mean length of the triangles' edges on the flat cloth, metres.
    pub(super) edge_length: f64,
    /// Coulomb friction, the garment's.
    pub(super) friction: f64,
}

/// A hinge's first side as met on the way: its edge counter-clockwise, its far corner.
struct Side {
    edge: [u32; 2],
    far: u32,
    length: f64,
    area: f64,
    bending: f64,
    rest: f64,
    piece: usize,
}

impl Model {
    /// The model in which the vertices of `welded` pairs are one particle each.
    pub(super) fn new(garment: &CutGarment, welded: &[(At, At)]) -> Self {
        let particle_of = number(garment, welded);
        let count = particle_of.iter().flatten().max().map_or(0, |most| *most as usize + 1);
        let mut mass = vec![0.0; count];
        let mut triangles = Vec::new();
        let mut membranes = Vec::new();
        let mut edges = 0.0;
        for (piece, particles) in garment.pieces.iter().zip(&particle_of) {
            let cloth = piece.cloth.as_ref().unwrap_or(&garment.cloth);
            for corners in &piece.triangles {
                let flat = corners.map(|corner| piece.flat[corner as usize]);
                let corners = corners.map(|corner| particles[corner as usize]);
                let area = 0.5 * (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]).abs();
                corners.iter().for_each(|corner| mass[*corner as usize] += cloth.density * area / 3.0);
                if let Some(membrane) = Membrane::new(corners, flat, piece.grain, cloth) {
                    triangles.push(corners);
                    membranes.push(membrane);
                    edges += (0..3).map(|i| flat[i].distance(flat[(i + 1) % 3])).sum::<f64>() / 3.0;
                }
            }
        }
        mass.iter_mut().filter(|mass| **mass <= 0.0).for_each(|mass| *mass = 1e-9);
        let hinges = hinges(garment, &particle_of);
        Self {
            inverse_mass: mass.iter().map(|mass| 1.0 / mass).collect(),
            mass,
            membranes: Coloured::new(membranes, count),
            hinges: Coloured::new(hinges, count),
            edge_length: if triangles.is_empty() { 0.01 } else { edges / triangles.len() as f64 },
            triangles,
            particle_of,
            friction: garment.cloth.friction,
        }
    }

    pub(super) fn particle(&self, at: At) -> u32 {
        self.particle_of[at.piece as usize][at.vertex as usize]
    }

    /// Places of particles: the mean of their vertices'.
    pub(super) fn gather(&self, places: &[Vec<DVec3>]) -> Vec<DVec3> {
        let mut sums = vec![(DVec3::ZERO, 0.0); self.mass.len()];
        for (particle, place) in self.particle_of.iter().flatten().zip(places.iter().flatten()) {
            let sum = &mut sums[*particle as usize];
            *sum = (sum.0 + *place, sum.1 + 1.0);
        }
        sums.into_iter().map(|(sum, count)| sum / f64::max(count, 1.0)).collect()
    }

    /// Places of vertices from those of particles.
    pub(super) fn scatter(&self, places: &[DVec3]) -> Vec<Vec<DVec3>> {
        let of_piece =
            |particles: &Vec<u32>| particles.iter().map(|particle| places[*particle as usize]).collect();
        self.particle_of.iter().map(of_piece).collect()
    }
}

/// Particles for vertices, numbered in the order of the pieces.
fn number(garment: &CutGarment, welded: &[(At, At)]) -> Vec<Vec<u32>> {
    let starts: Vec<usize> = garment
        .pieces
        .iter()
        .scan(0, |next, piece| {
            let start = *next;
            *next += piece.flat.len();
            Some(start)
        })
        .collect();
    let vertices = garment.pieces.iter().map(|piece| piece.flat.len()).sum();
    let mut parent: Vec<usize> = (0..vertices).collect();
    let index = |at: &At| starts[at.piece as usize] + at.vertex as usize;
    for (one, other) in welded {
        let (one, other) = (root(&mut parent, index(one)), root(&mut parent, index(other)));
        parent[one.max(other)] = one.min(other);
    }
    let mut particles = vec![u32::MAX; vertices];
    let mut next = 0;
    for vertex in 0..vertices {
        let root = root(&mut parent, vertex);
        if particles[root] == u32::MAX {
            particles[root] = next;
            next += 1;
        }
        particles[vertex] = particles[root];
    }
    let mut rest = particles.into_iter();
    garment.pieces.iter().map(|piece| rest.by_ref().take(piece.flat.len()).collect()).collect()
}

fn root(parent: &mut [usize], mut vertex: usize) -> usize {
    while parent[vertex] != vertex {
        parent[vertex] = parent[parent[vertex]];
        vertex = parent[vertex];
    }
    vertex
}

/// A hinge wherever exactly two triangles of a piece, or one each of two pieces, share an edge.
fn hinges(garment: &CutGarment, particle_of: &[Vec<u32>]) -> Vec<Hinge> {
    let mut open: BTreeMap<[u32; 2], Vec<Side>> = BTreeMap::new();
    for (index, (piece, particles)) in garment.pieces.iter().zip(particle_of).enumerate() {
        let cloth = piece.cloth.as_ref().unwrap_or(&garment.cloth);
        let folds = fold_angles(piece);
        for corners in &piece.triangles {
            for i in 0..3 {
                let side = side(
                    piece,
                    cloth,
                    &folds,
                    index,
                    [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]],
                    particles,
                );
                let key = [side.edge[0].min(side.edge[1]), side.edge[0].max(side.edge[1])];
                open.entry(key).or_default().push(side);
            }
        }
    }
    let mut hinges = Vec::new();
    for sides in open.into_values() {
        for (i, first) in sides.iter().enumerate() {
            let within = sides[i + 1..]
                .iter()
                .filter(|second| second.piece == first.piece && second.far != first.far)
                .map(|second| join(first, second));
            hinges.extend(within);
        }
        if let [first, second] = sides.as_slice()
            && first.piece != second.piece
            && first.far != second.far
        {
            hinges.push(join(first, second));
        }
    }
    hinges
}

fn side(
    piece: &CutPiece,
    cloth: &Cloth,
    folds: &BTreeMap<[u32; 2], f64>,
    index: usize,
    [a, b, c]: [u32; 3],
    particles: &[u32],
) -> Side {
    let flat = |vertex: u32| piece.flat[vertex as usize];
    let bending = cloth.bending.max(LEAST_BENDING * cloth.density * flat(a).distance(flat(b)).powi(3));
    let rest = folds.get(&[a.min(b), a.max(b)]).copied();
    Side {
        edge: [particles[a as usize], particles[b as usize]],
        far: particles[c as usize],
        length: flat(a).distance(flat(b)),
        area: 0.5 * (flat(b) - flat(a)).perp_dot(flat(c) - flat(a)).abs(),
        bending: if rest.is_some() { bending * FOLD_STIFFNESS } else { bending },
        rest: rest.unwrap_or(0.0),
        piece: index,
    }
}

/// How much stiffer a pressed fold keeps its angle than the cloth keeps flat.
const FOLD_STIFFNESS: f64 = 50.0;

/// Cloth folds by its own weight over a length of `(bending / (density gravity))^(1/3)`. Cloth too soft to fold no closer than about
/// its triangles' edges is made so stiff, or it would crumple into shapes that the triangles cannot show. Metres per second squared.
const LEAST_BENDING: f64 = 8.0;

fn fold_angles(piece: &CutPiece) -> BTreeMap<[u32; 2], f64> {
    let pairs = piece.folds.iter().flat_map(|fold| fold.vertices.windows(2).map(|pair| (pair, fold.angle)));
    pairs.map(|(pair, angle)| ([pair[0].min(pair[1]), pair[0].max(pair[1])], angle)).collect()
}

fn join(first: &Side, second: &Side) -> Hinge {
    let corners = [first.edge[0], first.edge[1], first.far, second.far];
    let area = (first.area + second.area).max(1e-12);
    let (length, bending) = (0.5 * (first.length + second.length), 0.5 * (first.bending + second.bending));
    Hinge::new(corners, length, area, bending, first.rest)
}
