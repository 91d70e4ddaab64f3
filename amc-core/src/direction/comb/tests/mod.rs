#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod fields;
mod hostile;
mod kept;
mod places;

use glam::{Quat, Vec2, Vec3};

use super::*;
use crate::direction::tests::{degrees_between, garment_of};
use crate::mesh::{Garment, Mesh, cloth_normals};
use crate::progress::Progress;

/// A grid of `cells` x `cells` over the unit square of the flat pattern, taken to space by `to_space`; the inner vertices are
/// shaken a little, so that nothing is even.
fn grid(cells: u32, to_space: impl Fn(Vec2) -> Vec3) -> Mesh {
    let mut uvs = Vec::new();
    let mut triangles = Vec::new();
    for row in 0..=cells {
        for column in 0..=cells {
            let shake =
                Vec2::new(((column * 7 + row * 13) % 5) as f32, ((column * 11 + row * 3) % 7) as f32) * 0.05;
            let inner = |k: u32| if k.is_multiple_of(cells) { 0.0 } else { 1.0 };
            let p = Vec2::new(column as f32, row as f32) + shake * Vec2::new(inner(column), inner(row));
            uvs.push(p / cells as f32);
            if row < cells && column < cells {
                let k = row * (cells + 1) + column;
                let above = k + cells + 1;
                triangles.extend([[k, k + 1, above + 1], [k, above + 1, above]]);
            }
        }
    }
    mesh(uvs.iter().map(|&uv| to_space(uv)).collect(), Some(uvs), triangles)
}

fn mesh(positions: Vec<Vec3>, uvs: Option<Vec<Vec2>>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { normals: cloth_normals(&positions, &triangles), positions, uvs, triangles, ..Mesh::default() }
}

fn flat(cells: u32) -> Mesh {
    grid(cells, |p| p.extend(0.0))
}

/// Every triangle cut in four, `times` times over; flat in each.
fn subdivided(mut mesh: Mesh, times: usize) -> Mesh {
    for _ in 0..times {
        let mut middles = std::collections::HashMap::new();
        let mut triangles = Vec::new();
        for triangle in std::mem::take(&mut mesh.triangles) {
            let [a, b, c] = triangle;
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to)| {
                *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                    let [from, to] = [from, to].map(|vertex| vertex as usize);
                    mesh.positions.push((mesh.positions[from] + mesh.positions[to]) / 2.0);
                    if let Some(uvs) = &mut mesh.uvs {
                        uvs.push((uvs[from] + uvs[to]) / 2.0);
                    }
                    mesh.positions.len() as u32 - 1
                })
            });
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        mesh.triangles = triangles;
    }
    mesh.normals = cloth_normals(&mesh.positions, &mesh.triangles);
    mesh
}

/// A sphere of radius 1 without UVs, 20 x 4^`times` triangles.
fn icosphere(times: usize) -> Mesh {
    let g = (1.0 + 5f32.sqrt()) / 2.0;
    let corners = [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)];
    let positions = [
        corners.map(|(a, b)| Vec3::new(a, b, 0.0)),
        corners.map(|(a, b)| Vec3::new(0.0, a, b)),
        corners.map(|(a, b)| Vec3::new(b, 0.0, a)),
    ]
    .concat();
    let triangles = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let mut sphere = subdivided(mesh(positions, None, triangles), times);
    sphere.positions.iter_mut().for_each(|p| *p /= p.length());
    sphere.normals = sphere.positions.clone();
    sphere
}

fn solver(garment: &Garment) -> CombSolver {
    CombSolver::new(PanelMesh::new(garment, &garment.panels[0]).unwrap())
}

fn comb(elsewhere: Elsewhere, strokes: Vec<Stroke>) -> Comb {
    Comb { strokes, elsewhere, reach: 0.1, turn: 0.0 }
}

/// An exact stroke through points of the flat pattern, narrower than any triangle.
fn stroke(points: &[[f32; 2]]) -> Stroke {
    let points = points.iter().map(|&point| point.into()).collect();
    Stroke { path: Path::Pattern(points), hold: Hold::Exact, radius: 1e-3, is_on: true }
}

fn in_space(points: &[Vec3]) -> Stroke {
    Stroke { path: Path::Space(points.to_vec()), ..stroke(&[]) }
}

/// The field of a garment's first panel, whose own direction is `own` everywhere.
fn combed(garment: &Garment, comb: &Comb, symmetry: u32, own: Vec3) -> CombedField {
    let own = vec![own; garment.positions.len()];
    solver(garment).solve(comb, symmetry, &own, Progress::none()).unwrap()
}

fn angle(degrees: f32) -> Vec3 {
    Vec2::from_angle(degrees.to_radians()).extend(0.0)
}

/// Degrees between two directions that are the same every 360 / `symmetry` about a common normal.
fn apart(a: Vec3, b: Vec3, symmetry: u32) -> f32 {
    let sector = 360.0 / symmetry as f32;
    let off = degrees_between(a, b) % sector;
    off.min(sector - off)
}

fn tilt() -> Quat {
    Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 1.1)
}

/// Unit, and perpendicular to the garment's normals.
fn assert_sound(garment: &Garment, field: &CombedField) {
    assert_eq!(field.vertices.len(), field.directions.len());
    for (&vertex, direction) in field.vertices.iter().zip(&field.directions) {
        let off = direction.dot(garment.normals[vertex as usize]).abs();
        assert!((direction.length() - 1.0).abs() < 1e-4 && off < 1e-4, "{vertex}: {direction} {off}");
    }
}
