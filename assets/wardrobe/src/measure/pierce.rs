//! Where a garment cuts through itself.

use std::collections::HashMap;
use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::Sheet;
use crate::drape::grid::CellGrid;

/// Directions in which a spot may be seen.
const DIRECTIONS: u32 = 32;
/// What is nearer to a spot than this does not hide it, metres.
const NEAR: f64 = 5e-4;

/// How often a garment cuts through itself.
pub(super) struct Pierced {
    pub(super) spots: usize,
    pub(super) in_view: usize,
}

/// All sheets' triangles; vertices at the same place are one.
struct Soup {
    places: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

pub(super) fn pierced(sheets: &[Sheet<'_>]) -> Pierced {
    let soup = soup(sheets);
    let bounds = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| soup.places[corner as usize]);
        (a.min(b).min(c), a.max(b).max(c))
    };
    let boxes: Vec<(DVec3, DVec3)> = soup.triangles.iter().map(bounds).collect();
    let size: f64 = boxes.iter().map(|(low, high)| (*high - *low).max_element()).sum();
    let grid = CellGrid::new(&boxes, (1.5 * size / boxes.len().max(1) as f64).max(1e-4));
    let of_triangle = |index: usize| {
        let mut spots = Vec::new();
        grid.overlapping(index as u32, &boxes, |other| {
            soup.spots(&soup.triangles[index], &soup.triangles[other as usize], &mut spots);
        });
        spots
    };
    let spots: Vec<DVec3> =
        (0..soup.triangles.len()).into_par_iter().with_min_len(256).flat_map_iter(of_triangle).collect();
    let in_view = spots.par_iter().filter(|spot| soup.sees_out(**spot)).count();
    Pierced { spots: spots.len(), in_view }
}

fn soup(sheets: &[Sheet<'_>]) -> Soup {
    let mut known: HashMap<[u64; 3], u32> = HashMap::new();
    let mut soup = Soup { places: Vec::new(), triangles: Vec::new() };
    for sheet in sheets {
        let mut index_of = |place: &DVec3| {
            *known.entry(place.to_array().map(f64::to_bits)).or_insert_with(|| {
                soup.places.push(*place);
                soup.places.len() as u32 - 1
            })
        };
        let indices: Vec<u32> = sheet.places.iter().map(&mut index_of).collect();
        soup.triangles
            .extend(sheet.triangles.iter().map(|corners| corners.map(|corner| indices[corner as usize])));
    }
    soup
}

impl Soup {
    /// Where edges of one of the triangles pass through the other; an edge shared by two triangles counts twice.
    fn spots(&self, one: &[u32; 3], other: &[u32; 3], spots: &mut Vec<DVec3>) {
        if one.iter().any(|corner| other.contains(corner)) {
            return;
        }
        for (edges, face) in [(one, other), (other, one)] {
            let face = face.map(|corner| self.places[corner as usize]);
            for i in 0..3 {
                let (from, to) = (self.places[edges[i] as usize], self.places[edges[(i + 1) % 3] as usize]);
                if let Some(share) = crossing(from, to - from, face)
                    && (0.0..=1.0).contains(&share)
                {
                    spots.push(from.lerp(to, share));
                }
            }
        }
    }

    /// Whether a straight way out of the garment starts here.
    fn sees_out(&self, spot: DVec3) -> bool {
        let free = |direction: DVec3| {
            let hit = |corners: &[u32; 3]| {
                let face = corners.map(|corner| self.places[corner as usize]);
                crossing(spot, direction, face).is_some_and(|distance| distance > NEAR)
            };
            !self.triangles.iter().any(hit)
        };
        (0..DIRECTIONS).any(|index| free(direction(index)))
    }
}

/// Directions spread evenly (a Fibonacci sphere).
fn direction(index: u32) -> DVec3 {
    let height = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(DIRECTIONS);
    let turn = f64::from(index) * PI * (3.0 - 5f64.sqrt());
    let radius = (1.0 - height * height).sqrt();
    DVec3::new(radius * turn.cos(), height, radius * turn.sin())
}

/// How many `ways` from `from` the face is met (Moeller and Trumbore 1997); `None` if it is not, before or behind.
fn crossing(from: DVec3, way: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac, offset) = (b - a, c - a, from - a);
    let across = way.cross(ac);
    let determinant = ab.dot(across);
    if determinant == 0.0 {
        return None;
    }
    let at_b = offset.dot(across) / determinant;
    let turned = offset.cross(ab);
    let at_c = way.dot(turned) / determinant;
    (at_b >= 0.0 && at_c >= 0.0 && at_b + at_c <= 1.0).then_some(ac.dot(turned) / determinant)
}
