//! The mesh of one panel, made ready for combing.

use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec2, Vec3};

use super::edges::Edges;
use super::frame::Frame;
use super::nearest::Nearest;
use crate::mesh::forest::Forest;
use crate::mesh::weld::{bits, weld};
use crate::mesh::{Garment, Panel, uv_area};
use crate::{Error, Result};

/// The triangles of one panel. Vertices that a garment doubles (at creases, and where the UV map folds) are one here.
/// Any triangles will do: closed, in several pieces, with more than two at an edge, without area.
#[derive(Debug)]
pub struct PanelMesh {
    /// The garment's vertices that the panel uses, in ascending order.
    pub(super) vertices: Arc<[u32]>,
    /// The garment's normals at them.
    pub(super) garment_normals: Vec<Vec3>,
    /// Which of the vertices below each of them is.
    pub(super) places: Vec<u32>,
    pub(super) positions: Vec<Vec3>,
    /// Empty where the panel has none.
    pub(super) uvs: Vec<Vec2>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The garment's triangle that is the panel's first.
    pub(super) first_triangle: u32,
    pub(super) frames: Vec<Frame>,
    /// A third of the triangles around each vertex, square metres.
    pub(super) areas: Vec<f64>,
    pub(super) edges: Edges,
    /// The connected piece of each vertex.
    pub(super) pieces: Vec<u32>,
    pub(super) piece_count: usize,
    /// Of the edges' lengths, metres.
    pub(super) mean_edge: f64,
    /// The length on the surface of a step of 1 in the flat pattern: the root of the areas' ratio. None without UVs.
    pub(super) metres_per_uv: Option<f64>,
    in_space: OnceLock<Nearest>,
    in_pattern: OnceLock<Nearest>,
}

impl PanelMesh {
    /// The mesh of one of a garment's panels.
    ///
    /// # Errors
    /// A range or an index that reaches past the garment's arrays, or a number that is not finite.
    pub fn new(garment: &Garment, panel: &Panel) -> Result<Self> {
        let range = panel.triangles.start as usize..panel.triangles.end as usize;
        let of_garment = garment.triangles.get(range);
        let of_garment = of_garment.ok_or_else(|| invalid(panel, "has triangles that are not there"))?;
        let mut vertices = of_garment.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        check(garment, panel, &vertices)?;
        let has_uvs = garment.has_uvs && has_uv_area(garment, of_garment);
        let (places, firsts) = welded(garment, &vertices, has_uvs);
        let triangles = renumbered(of_garment, &vertices, &places);
        let of_first = |index: &u32| vertices[*index as usize] as usize;
        let positions: Vec<Vec3> = firsts.iter().map(|first| garment.positions[of_first(first)]).collect();
        let fallback: Vec<Vec3> = firsts.iter().map(|first| garment.normals[of_first(first)]).collect();
        let uvs = if has_uvs {
            firsts.iter().map(|first| garment.uvs[of_first(first)]).collect()
        } else {
            Vec::new()
        };
        let (frames, areas) = frames(&positions, &fallback, &triangles);
        let edges = Edges::new(&positions, &frames, &triangles);
        let (pieces, piece_count) = pieces(&edges, positions.len());
        Ok(Self {
            garment_normals: vertices.iter().map(|&vertex| garment.normals[vertex as usize]).collect(),
            vertices: vertices.into(),
            places,
            mean_edge: mean_length(&positions, &edges),
            metres_per_uv: metres_per_uv(&positions, &uvs, &triangles),
            positions,
            uvs,
            triangles,
            first_triangle: panel.triangles.start,
            frames,
            areas,
            edges,
            pieces,
            piece_count,
            in_space: OnceLock::new(),
            in_pattern: OnceLock::new(),
        })
    }

    /// The garment's vertices that the panel uses, in ascending order: [`super::CombedField::directions`] is one for each.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Whether strokes can be kept in the flat pattern: whether the panel has UVs with an area.
    pub fn has_uvs(&self) -> bool {
        !self.uvs.is_empty()
    }

    /// The point of the flat pattern, in UVs, of the surface's point nearest to `point` (object space, metres). None where
    /// the panel has no UVs. The first call makes a search tree.
    pub fn pattern_point(&self, point: Vec3) -> Option<Vec2> {
        if !self.has_uvs() || !point.is_finite() {
            return None;
        }
        let found = self.in_space().nearest(point)?;
        let corners = self.triangles[found.triangle as usize].map(|vertex| self.uvs[vertex as usize]);
        Some(corners.iter().zip(found.shares).map(|(&corner, share)| corner * share).sum())
    }

    /// Per vertex 1, or -1 where the flat pattern is drawn mirrored.
    pub(super) fn uv_signs(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.positions.len()];
        for &triangle in if self.has_uvs() { &self.triangles[..] } else { &[] } {
            let area = uv_area(triangle.map(|vertex| self.uvs[vertex as usize]));
            triangle.iter().for_each(|&vertex| areas[vertex as usize] += f64::from(area));
        }
        areas.into_iter().map(|area: f64| if area < 0.0 { -1.0 } else { 1.0 }).collect()
    }

    /// Finds the nearest point of the surface.
    pub(super) fn in_space(&self) -> &Nearest {
        self.in_space.get_or_init(|| Nearest::new(&self.positions, &self.triangles, |_| true))
    }

    /// Finds the nearest point of the flat pattern.
    pub(super) fn in_pattern(&self) -> &Nearest {
        self.in_pattern.get_or_init(|| {
            let flat: Vec<Vec3> = self.uvs.iter().map(|uv| uv.extend(0.0)).collect();
            let has_area =
                |triangle: [u32; 3]| uv_area(triangle.map(|vertex| self.uvs[vertex as usize])) != 0.0;
            Nearest::new(&flat, &self.triangles, has_area)
        })
    }
}

fn invalid(panel: &Panel, what: &str) -> Error {
    Error::invalid(format!("the panel {} {what}", panel.id))
}

fn check(garment: &Garment, panel: &Panel, vertices: &[u32]) -> Result<()> {
    let count = garment.positions.len().min(garment.normals.len()).min(garment.uvs.len());
    if vertices.last().is_some_and(|&last| last as usize >= count) {
        return Err(invalid(panel, "has a vertex that is not there"));
    }
    let is_finite = |&vertex: &u32| {
        let vertex = vertex as usize;
        garment.positions[vertex].is_finite()
            && garment.normals[vertex].is_finite()
            && garment.uvs[vertex].is_finite()
    };
    if !vertices.iter().all(is_finite) {
        return Err(invalid(panel, "has a position, normal or UV that is not finite"));
    }
    Ok(())
}

fn has_uv_area(garment: &Garment, triangles: &[[u32; 3]]) -> bool {
    triangles.iter().any(|triangle| {
        let corners = triangle.map(|vertex| garment.uvs.get(vertex as usize).copied().unwrap_or_default());
        uv_area(corners) != 0.0
    })
}

/// For each vertex its number among those of different position and UV; and for each of these its first vertex.
fn welded(garment: &Garment, vertices: &[u32], has_uvs: bool) -> (Vec<u32>, Vec<u32>) {
    let first = weld(vertices.len(), |index| {
        let vertex = vertices[index] as usize;
        let [x, y, z] = garment.positions[vertex].to_array().map(bits);
        let [u, v] = if has_uvs { garment.uvs[vertex].to_array().map(bits) } else { [0; 2] };
        [x, y, z, u, v]
    });
    let mut firsts = Vec::new();
    let mut places: Vec<u32> = Vec::with_capacity(first.len());
    for (index, &first) in first.iter().enumerate() {
        if first as usize == index {
            places.push(firsts.len() as u32);
            firsts.push(first);
        } else {
            places.push(places[first as usize]);
        }
    }
    (places, firsts)
}

fn renumbered(triangles: &[[u32; 3]], vertices: &[u32], places: &[u32]) -> Vec<[u32; 3]> {
    let (Some(&low), Some(&high)) = (vertices.first(), vertices.last()) else { return Vec::new() };
    let mut place = vec![0; (high - low) as usize + 1];
    for (&vertex, &to) in vertices.iter().zip(places) {
        place[(vertex - low) as usize] = to;
    }
    triangles.iter().map(|triangle| triangle.map(|vertex| place[(vertex - low) as usize])).collect()
}

/// Per vertex a frame about the mean of the triangles' normals, weighted by their angles, and a third of their areas.
fn frames(positions: &[Vec3], fallback: &[Vec3], triangles: &[[u32; 3]]) -> (Vec<Frame>, Vec<f64>) {
    let mut normals = vec![DVec3::ZERO; positions.len()];
    let mut areas = vec![0.0; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|vertex| positions[vertex as usize].as_dvec3());
        let product = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let Some(normal) = product.try_normalize() else { continue };
        for k in 0..3 {
            let (a, b) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            normals[triangle[k] as usize] += normal * a.cross(b).length().atan2(a.dot(b));
            areas[triangle[k] as usize] += product.length() / 6.0;
        }
    }
    let frame = |(sum, fallback): (DVec3, &Vec3)| {
        let normal = sum.try_normalize().or_else(|| fallback.as_dvec3().try_normalize());
        Frame::new(normal.unwrap_or(DVec3::Y))
    };
    (normals.into_iter().zip(fallback).map(frame).collect(), areas)
}

/// The connected piece of each vertex, numbered from zero.
fn pieces(edges: &Edges, count: usize) -> (Vec<u32>, usize) {
    let mut forest = Forest::new(count);
    for (&low, &high) in edges.lower.iter().zip(&edges.higher) {
        forest.join(low, high);
    }
    let mut pieces = forest.into_roots();
    let mut number = 0;
    for vertex in 0..count {
        // A root is the least of its set, so it has its number before the others.
        if pieces[vertex] as usize == vertex {
            pieces[vertex] = number;
            number += 1;
        } else {
            pieces[vertex] = pieces[pieces[vertex] as usize];
        }
    }
    (pieces, number as usize)
}

fn mean_length(positions: &[Vec3], edges: &Edges) -> f64 {
    let length = |(&low, &high): (&u32, &u32)| {
        f64::from((positions[low as usize] - positions[high as usize]).length())
    };
    let sum: f64 = edges.lower.iter().zip(&edges.higher).map(length).sum();
    sum / edges.count().max(1) as f64
}

fn metres_per_uv(positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Option<f64> {
    let (mut surface, mut pattern) = (0.0, 0.0);
    for &triangle in if uvs.is_empty() { &[] } else { triangles } {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize].as_dvec3());
        let [flat_a, flat_b, flat_c] = triangle.map(|vertex| uvs[vertex as usize].as_dvec2());
        surface += (b - a).cross(c - a).length();
        pattern += (flat_b - flat_a).perp_dot(flat_c - flat_a).abs();
    }
    let metres = (surface / pattern).sqrt();
    (metres.is_finite() && metres > 0.0).then_some(metres)
}
