//! From the UVs of triangles to a tangent per vertex.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::field::Procedural;
use super::{Direction, Source, fill};
use crate::mesh::{Garment, Panel, uv_area};
use crate::view_space::perpendicular;
use crate::{Error, Result};

/// A direction at every vertex of a garment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tangents {
    /// One per vertex, object space: unit, and perpendicular to the vertex's normal.
    pub vectors: Arc<Vec<Vec3>>,
    /// One per panel: how many of its vertices have a direction that its source does not give there (no UVs, UVs
    /// without area, the zero of a field), filled from neighbours or made up.
    pub filled: Vec<u32>,
    /// One per panel: whether there was a vertex without any neighbour to fill it from, as in a panel without UVs.
    /// Such vertices run along object Y projected into the tangent plane, turned by the panel's angle about the normal;
    /// where a part lies flat, along object X.
    pub made_up: Vec<bool>,
    /// One per panel: whether strokes comb it, so that its direction is not what UVs and angle say.
    pub combed: Vec<bool>,
}

/// The tangents of a garment, `directions` being one per panel.
///
/// Per triangle `cos a X + sin a Y`, made unit, where X and Y are the surface gradients of u and v (`gradient`, the
/// paper's section 6) or dP/du and dP/dv (`yarn`); both pairs as they are, not made unit. Per vertex the mean over its
/// triangles weighted by their angles there, projected into the tangent plane of its normal. A triangle whose UVs or
/// positions have no area adds nothing; a vertex without any direction takes the mean of its neighbours' in the same
/// panel, spreading outwards edge by edge. No vertex is shared by two panels or by two orientations of the UV map
/// (see [`Garment`]), so no mean crosses a seam or a fold. The result does not depend on the number of threads.
///
/// # Errors
/// Not one direction per panel, an angle or a field that is not finite, a field with a zero axis, or a garment whose
/// indices reach past its vertices.
pub fn tangents(garment: &Garment, directions: &[Direction]) -> Result<Tangents> {
    check(garment, directions)?;
    let mut vectors = vec![Vec3::ZERO; garment.positions.len()];
    let mut scratch = Vec::new();
    for (panel, direction) in garment.panels.iter().zip(directions) {
        add_panel(garment, panel, direction, &mut scratch, &mut vectors);
    }
    vectors.par_iter_mut().zip(&garment.normals).with_min_len(4096).for_each(|(vector, &normal)| {
        *vector = (*vector - normal * normal.dot(*vector)).normalize_or_zero();
    });
    let missing = fill::missing(garment, &vectors);
    let mut made_up = vec![false; garment.panels.len()];
    for (index, (panel, direction)) in garment.panels.iter().zip(directions).enumerate() {
        if missing[index] > 0 {
            made_up[index] = fill::fill(garment, triangles_of(garment, panel), direction.angle, &mut vectors);
        }
    }
    // Vertices of no triangle: any direction serves.
    for (vector, &normal) in vectors.iter_mut().zip(&garment.normals) {
        if *vector == Vec3::ZERO {
            *vector = perpendicular(Vec3::Y, normal);
        }
    }
    let combed = vec![false; garment.panels.len()];
    Ok(Tangents { vectors: Arc::new(vectors), filled: missing, made_up, combed })
}

/// One panel's directions anew, the others as they are: to the bit what [`tangents`] makes. `vertices` are the panel's.
///
/// # Errors
/// An angle or a field that makes no sense, as in [`tangents`]; nothing is changed then.
pub(super) fn renew(
    garment: &Garment,
    (index, vertices): (usize, &[u32]),
    direction: &Direction,
    scratch: &mut Vec<Share>,
    tangents: &mut Tangents,
) -> Result<()> {
    let panel = &garment.panels[index];
    check_direction(panel, direction)?;
    let vectors = Arc::make_mut(&mut tangents.vectors);
    for &vertex in vertices {
        vectors[vertex as usize] = Vec3::ZERO;
    }
    add_panel(garment, panel, direction, scratch, vectors);
    let mut missing = 0;
    for &vertex in vertices {
        let (vector, normal) = (&mut vectors[vertex as usize], garment.normals[vertex as usize]);
        *vector = (*vector - normal * normal.dot(*vector)).normalize_or_zero();
        missing += u32::from(*vector == Vec3::ZERO);
    }
    tangents.made_up[index] =
        missing > 0 && fill::fill(garment, triangles_of(garment, panel), direction.angle, vectors);
    for &vertex in vertices {
        let vector = &mut vectors[vertex as usize];
        if *vector == Vec3::ZERO {
            *vector = perpendicular(Vec3::Y, garment.normals[vertex as usize]);
        }
    }
    (tangents.filled[index], tangents.combed[index]) = (missing, false);
    Ok(())
}

/// The triangles of a panel; [`check`] has seen that they are there.
pub(super) fn triangles_of<'a>(garment: &'a Garment, panel: &Panel) -> &'a [[u32; 3]] {
    let range = panel.triangles.start as usize..panel.triangles.end as usize;
    garment.triangles.get(range).unwrap_or_default()
}

fn check(garment: &Garment, directions: &[Direction]) -> Result<()> {
    if directions.len() != garment.panels.len() {
        return Err(Error::invalid(format!(
            "{} directions for {} panels",
            directions.len(),
            garment.panels.len()
        )));
    }
    let count = garment.positions.len();
    if garment.normals.len() != count || garment.uvs.len() != count {
        return Err(Error::invalid("not one normal and one UV per vertex"));
    }
    if garment.triangles.par_iter().any(|corners| corners.iter().any(|&corner| corner as usize >= count)) {
        return Err(Error::invalid("a triangle refers to a vertex that is not there"));
    }
    for (panel, direction) in garment.panels.iter().zip(directions) {
        if panel.triangles.start > panel.triangles.end
            || panel.triangles.end as usize > garment.triangles.len()
        {
            return Err(of_panel(panel, Error::invalid("refers to triangles that are not there")));
        }
        check_direction(panel, direction)?;
    }
    Ok(())
}

fn check_direction(panel: &Panel, direction: &Direction) -> Result<()> {
    if !direction.angle.is_finite() {
        return Err(of_panel(panel, Error::invalid("the angle is not a finite number")));
    }
    match direction.source {
        Source::Field(field) => field.check().map_err(|error| of_panel(panel, error)),
        Source::Gradient | Source::Yarn => Ok(()),
    }
}

fn of_panel(panel: &Panel, error: Error) -> Error {
    error.at_element(format!("panel {}", panel.id))
}

/// What a triangle adds to its corners: a unit direction (zero: none) and the angles at corners 0 and 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Share {
    direction: Vec3,
    angles: [f32; 2],
}

/// Triangles done in parallel before they are summed: their shares stay in the cache.
const BLOCK: usize = 32 * 1024;

/// Adds a panel's directions up at its vertices, neither in their tangent planes yet nor unit.
fn add_panel(
    garment: &Garment,
    panel: &Panel,
    direction: &Direction,
    scratch: &mut Vec<Share>,
    vectors: &mut [Vec3],
) {
    match direction.source {
        Source::Gradient | Source::Yarn if garment.has_uvs => {
            add_triangles(garment, panel, direction, scratch, vectors);
        }
        Source::Gradient | Source::Yarn => {}
        Source::Field(field) => {
            let field = Procedural::new(field, direction.angle);
            for &vertex in triangles_of(garment, panel).as_flattened() {
                let vertex = vertex as usize;
                vectors[vertex] = field.at(garment.positions[vertex], garment.normals[vertex]);
            }
        }
    }
}

fn add_triangles(
    garment: &Garment,
    panel: &Panel,
    direction: &Direction,
    shares: &mut Vec<Share>,
    sums: &mut [Vec3],
) {
    let (sin, cos) = direction.angle.sin_cos();
    let yarn = direction.source == Source::Yarn;
    for block in triangles_of(garment, panel).chunks(BLOCK) {
        shares.clear();
        shares.resize(block.len(), Share::default());
        shares.par_iter_mut().zip(block).with_min_len(2048).for_each(|(share, corners)| {
            let [a, b, c] = corners.map(|corner| corner as usize);
            let p = [garment.positions[a], garment.positions[b], garment.positions[c]];
            let uv = [garment.uvs[a], garment.uvs[b], garment.uvs[c]];
            *share = Share { direction: of_triangle(p, uv, sin, cos, yarn), angles: angles(p) };
        });
        // One thread sums, in order: the same result on any machine.
        for (share, corners) in shares.iter().zip(block) {
            let [a, b] = share.angles;
            let weights = [a, b, std::f32::consts::PI - a - b];
            for (&corner, weight) in corners.iter().zip(weights) {
                sums[corner as usize] += share.direction * weight;
            }
        }
    }
}

/// The angles at the first two corners of a triangle, radians.
fn angles([p, q, r]: [Vec3; 3]) -> [f32; 2] {
    let (pq, pr, qr) = (q - p, r - p, r - q);
    let twice_area = pq.cross(pr).length();
    [twice_area.atan2(pq.dot(pr)), twice_area.atan2(-pq.dot(qr))]
}

/// The unit direction of a triangle, zero where it has none.
///
/// With edges e, f from the first corner, their UV differences (a, b), (c, d), D = a d - b c and N = e x f:
/// dP/du = (d e - b f) / D, dP/dv = (a f - c e) / D, grad u = (a f - c e) x N / |N|^2, grad v = (b f - d e) x N / |N|^2.
/// Positive factors are left out, for the sum is made unit.
fn of_triangle(p: [Vec3; 3], uv: [Vec2; 3], sin: f32, cos: f32, yarn: bool) -> Vec3 {
    let (e, f) = (p[1] - p[0], p[2] - p[0]);
    let (eu, fu) = (uv[1] - uv[0], uv[2] - uv[0]);
    let Some(normal) = e.cross(f).try_normalize() else { return Vec3::ZERO };
    let area = uv_area(uv);
    if area == 0.0 {
        return Vec3::ZERO;
    }
    let vector = if yarn {
        (e * (cos * fu.y - sin * fu.x) + f * (sin * eu.x - cos * eu.y)) * area.signum()
    } else {
        (f * (cos * eu.x + sin * eu.y) - e * (cos * fu.x + sin * fu.y)).cross(normal)
    };
    vector.normalize_or_zero()
}
