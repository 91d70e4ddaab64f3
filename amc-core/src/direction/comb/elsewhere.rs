//! The direction away from the strokes.

use faer::c64;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::super::field::Procedural;
use super::Complex;
use super::demands::turns;
use super::edges::{ZERO, power};
use super::frame::{turn, unit};
use super::lift::along_uv;
use super::panel_mesh::PanelMesh;
use super::stroke::{Comb, Elsewhere};

/// The panel's own direction at each vertex of its mesh, a unit number in its frame: where the garment has several vertices,
/// one of the directions that are `symmetry`-fold the mean of theirs. `own` is one per vertex of the garment.
pub(super) fn own(mesh: &PanelMesh, own: &[Vec3], symmetry: u32) -> Vec<Complex> {
    let of_vertex = |((&vertex, &place), normal): ((&u32, &u32), &Vec3)| {
        let frame = &mesh.frames[place as usize];
        let vector = turn(own[vertex as usize].as_dvec3(), normal.as_dvec3(), frame.normal, DVec3::ZERO);
        frame.direction(vector).unwrap_or(ZERO)
    };
    let all = mesh.vertices.par_iter().zip(&mesh.places).zip(&mesh.garment_normals);
    let all: Vec<Complex> = all.with_min_len(4096).map(of_vertex).collect();
    let (mut firsts, mut sums) = (vec![ZERO; mesh.positions.len()], vec![ZERO; mesh.positions.len()]);
    for (&direction, &place) in all.iter().zip(&mesh.places) {
        let (first, sum) = (&mut firsts[place as usize], &mut sums[place as usize]);
        if *first == ZERO {
            *first = direction;
        } else if direction != ZERO {
            // Made only where there are several: almost nowhere.
            *sum = if *sum == ZERO { power(*first, symmetry) } else { *sum } + power(direction, symmetry);
        }
    }
    let mean = |(first, sum): (Complex, Complex)| {
        if first == ZERO {
            return c64::new(1.0, 0.0);
        }
        unit(sum).map_or(first, |sum| nearest_root(sum, symmetry, first))
    };
    firsts.into_iter().zip(sums).map(mean).collect()
}

/// What is asked for away from the strokes, a unit number in each vertex's frame, zero where there is nothing.
pub(super) fn away(mesh: &PanelMesh, comb: &Comb, own: &[Complex]) -> Vec<Complex> {
    if comb.elsewhere == Elsewhere::Own {
        return own.to_vec();
    }
    let away = before_turn(mesh, comb.elsewhere);
    if comb.turn == 0.0 {
        return away;
    }
    away.into_iter().zip(turns(mesh, comb.turn)).map(|(direction, turn)| direction * turn).collect()
}

/// The same before it is turned.
fn before_turn(mesh: &PanelMesh, elsewhere: Elsewhere) -> Vec<Complex> {
    match elsewhere {
        Elsewhere::Own | Elsewhere::Smooth | Elsewhere::Boundary => vec![ZERO; mesh.positions.len()],
        Elsewhere::Field(field) => {
            let field = Procedural::new(field, 0.0);
            let direction = |(frame, &position): (&super::frame::Frame, &Vec3)| {
                frame.direction(field.at(position, frame.normal.as_vec3()).as_dvec3()).unwrap_or(ZERO)
            };
            mesh.frames.iter().zip(&mesh.positions).map(direction).collect()
        }
        Elsewhere::Radial(centre) => of_pattern(mesh, |uv| uv - centre.as_dvec2()),
        Elsewhere::Circular(centre) => of_pattern(mesh, |uv| (uv - centre.as_dvec2()).perp()),
    }
}

/// A field of the flat pattern, taken to the surface by the mean of dP/du and dP/dv round each vertex.
fn of_pattern(mesh: &PanelMesh, at: impl Fn(DVec2) -> DVec2) -> Vec<Complex> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    if mesh.has_uvs() {
        for (triangle, number) in mesh.triangles.iter().zip(0..) {
            let Some([along_u, along_v]) = along_uv(mesh, number) else { continue };
            let corners = triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
            let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
            for &vertex in triangle {
                let uv: Vec2 = mesh.uvs[vertex as usize];
                let step = at(uv.as_dvec2());
                sums[vertex as usize] += (along_u * step.x + along_v * step.y) * area;
            }
        }
    }
    sums.iter().zip(&mesh.frames).map(|(&sum, frame)| frame.direction(sum).unwrap_or(ZERO)).collect()
}

/// Of the directions whose `symmetry`-th power has the angle of `z`, the one nearest to `to`.
pub(super) fn nearest_root(z: Complex, symmetry: u32, to: Complex) -> Complex {
    let sector = std::f64::consts::TAU / f64::from(symmetry);
    let angle = z.im.atan2(z.re) / f64::from(symmetry);
    let turns = ((to.im.atan2(to.re) - angle) / sector).round();
    let (sin, cos) = (angle + turns * sector).sin_cos();
    c64::new(cos, sin)
}
