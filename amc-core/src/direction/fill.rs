//! Directions where the source gives none, from the neighbours.

use std::collections::HashMap;

use glam::Vec3;
use rayon::prelude::*;

use super::Field;
use super::field::Procedural;
use super::tangents::triangles_of;
use crate::mesh::Garment;

/// Per panel, how many of its vertices have no direction yet.
pub(super) fn missing(garment: &Garment, vectors: &[Vec3]) -> Vec<u32> {
    // Almost always there is none: one look at the vertices, none at the triangles.
    if vectors.par_iter().with_min_len(4096).all(|&vector| vector != Vec3::ZERO) {
        return vec![0; garment.panels.len()];
    }
    let mut counted = vec![false; vectors.len()];
    let count = |panel| {
        let mut count = 0;
        for &vertex in triangles_of(garment, panel).as_flattened() {
            let counted = &mut counted[vertex as usize];
            if vectors[vertex as usize] == Vec3::ZERO && !*counted {
                *counted = true;
                count += 1;
            }
        }
        count
    };
    garment.panels.iter().map(count).collect()
}

/// Gives every vertex of `triangles` (one panel's) a direction. Returns whether some had to be made up.
pub(super) fn fill(garment: &Garment, triangles: &[[u32; 3]], angle: f32, vectors: &mut [Vec3]) -> bool {
    let neighbours = Neighbours::new(&garment.positions, triangles, vectors);
    spread(garment, &neighbours, vectors);
    let mut made_up = false;
    for axis in [Vec3::Y, Vec3::X, Vec3::Z] {
        let left: Vec<u32> = neighbours.left(vectors).collect();
        if left.is_empty() {
            break;
        }
        made_up = true;
        let field = Procedural::new(Field::Along { direction: axis }, angle);
        for vertex in left {
            vectors[vertex as usize] =
                field.at(garment.positions[vertex as usize], garment.normals[vertex as usize]);
        }
        spread(garment, &neighbours, vectors);
    }
    made_up
}

/// The vertices of a panel that have no direction, and who stands around them: the other ends of their edges, and
/// vertices at the same place.
struct Neighbours {
    /// Sorted.
    vertices: Vec<u32>,
    /// Where in `around` each vertex's neighbours start; one more than vertices.
    starts: Vec<u32>,
    /// Sorted for each vertex.
    around: Vec<u32>,
    places: HashMap<u32, u32>,
}

impl Neighbours {
    fn new(positions: &[Vec3], triangles: &[[u32; 3]], vectors: &[Vec3]) -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for &[a, b, c] in triangles {
            for [from, to] in [[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]] {
                if vectors[from as usize] == Vec3::ZERO {
                    edges.push([from, to]);
                }
            }
        }
        // Across creases and folds, where a place has several vertices.
        let bits = |vertex: &u32| positions[*vertex as usize].to_array().map(f32::to_bits);
        let mut places: Vec<u32> = triangles.as_flattened().to_vec();
        places.sort_unstable_by_key(|vertex| (bits(vertex), *vertex));
        places.dedup();
        for pair in places.windows(2).filter(|pair| bits(&pair[0]) == bits(&pair[1])) {
            for [from, to] in [[pair[0], pair[1]], [pair[1], pair[0]]] {
                if vectors[from as usize] == Vec3::ZERO {
                    edges.push([from, to]);
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        let (mut vertices, mut starts) = (Vec::new(), Vec::new());
        for (place, &[from, _]) in edges.iter().enumerate() {
            if vertices.last() != Some(&from) {
                vertices.push(from);
                starts.push(place as u32);
            }
        }
        starts.push(edges.len() as u32);
        let around = edges.into_iter().map(|[_, to]| to).collect();
        let places = vertices.iter().zip(0..).map(|(&vertex, place)| (vertex, place)).collect();
        Self { vertices, starts, around, places }
    }

    fn around(&self, place: u32) -> &[u32] {
        let place = place as usize;
        &self.around[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    fn left<'a>(&'a self, vectors: &'a [Vec3]) -> impl Iterator<Item = u32> + 'a {
        self.vertices.iter().copied().filter(|&vertex| vectors[vertex as usize] == Vec3::ZERO)
    }
}

/// Spreads directions over edges, breadth first: a ring of vertices takes the mean of the rings before it.
fn spread(garment: &Garment, neighbours: &Neighbours, vectors: &mut [Vec3]) {
    let known = |vectors: &[Vec3], vertex: u32| vectors[vertex as usize] != Vec3::ZERO;
    let mut ring: Vec<u32> = (0..neighbours.vertices.len() as u32)
        .filter(|&place| neighbours.around(place).iter().any(|&vertex| known(vectors, vertex)))
        .collect();
    while !ring.is_empty() {
        ring.retain(|&place| !known(vectors, neighbours.vertices[place as usize]));
        // All of a ring is computed before any of it is stored: the order of vertices does not matter.
        let mean = |&place: &u32| {
            let sum: Vec3 = neighbours.around(place).iter().map(|&vertex| vectors[vertex as usize]).sum();
            let normal = garment.normals[neighbours.vertices[place as usize] as usize];
            (sum - normal * normal.dot(sum)).normalize_or_zero()
        };
        let means: Vec<Vec3> = ring.iter().map(mean).collect();
        let mut next = Vec::new();
        for (&place, mean) in ring.iter().zip(means) {
            // Neighbours that cancel give nothing; a later ring, or a made-up direction, does.
            if mean != Vec3::ZERO {
                vectors[neighbours.vertices[place as usize] as usize] = mean;
                next.extend(
                    neighbours.around(place).iter().filter_map(|vertex| neighbours.places.get(vertex)),
                );
            }
        }
        next.sort_unstable();
        next.dedup();
        next.retain(|&place| !known(vectors, neighbours.vertices[place as usize]));
        ring = next;
    }
}
