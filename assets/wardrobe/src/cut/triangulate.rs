//! Pieces triangulated between their lines: constrained Delaunay, by crate `spade`.

use amc_core::{Error, Result};
use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::lattice;
use super::smooth::{doubled_area, smooth};
use crate::pattern::crossing::{Stroke, crossing};

type Triangles = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// How often the interior is smoothed and triangulated anew.
const PASSES: usize = 3;
/// Rounds of smoothing between two triangulations.
const ROUNDS: usize = 3;

/// What a piece is triangulated between.
pub(super) struct Boundary<'a> {
    /// The vertices that are given.
    pub(super) points: Vec<DVec2>,
    /// Those of the outline, counter-clockwise.
    pub(super) outline: Vec<u32>,
    /// Edges inside.
    pub(super) inner: &'a [[u32; 2]],
}

/// A triangulated piece.
pub(super) struct Mesh {
    /// The given vertices, then those inside.
    pub(super) points: Vec<DVec2>,
    /// Counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
}

pub(super) fn triangulate(boundary: &Boundary<'_>, edge_length: f64) -> Result<Mesh> {
    let edges = boundary.edges();
    check_edges(&boundary.points, &edges)?;
    let polygon: Vec<DVec2> = boundary.outline.iter().map(|&v| boundary.points[v as usize]).collect();
    let strokes: Vec<[DVec2; 2]> =
        edges.iter().map(|edge| edge.map(|v| boundary.points[v as usize])).collect();
    let mut points = boundary.points.clone();
    points.extend(lattice::fill(&polygon, &strokes, &boundary.points, edge_length));
    let first = boundary.points.len();
    let mut triangles = inner_triangles(&points, &edges, polygon.len())?;
    for _ in 0..PASSES {
        smooth(&mut points, &triangles, first, ROUNDS);
        triangles = inner_triangles(&points, &edges, polygon.len())?;
    }
    Ok(Mesh { points, triangles })
}

impl Boundary<'_> {
    fn edges(&self) -> Vec<[u32; 2]> {
        let next = self.outline.iter().cycle().skip(1);
        let ring = self.outline.iter().zip(next).map(|(&a, &b)| [a, b]);
        ring.chain(self.inner.iter().copied()).collect()
    }
}

/// Refuses edges that cross: curves too narrow for their chords.
fn check_edges(points: &[DVec2], edges: &[[u32; 2]]) -> Result<()> {
    let too_coarse =
        || Error::invalid("the edge length is too coarse for it: its lines cross when they are divided");
    if points.len() < 3 {
        return Err(too_coarse());
    }
    let stroke = |edge: &[u32; 2]| Stroke {
        // Ends are drawn in by a little, so that strokes which share a vertex do not touch.
        ends: [0, 1].map(|i| points[edge[i] as usize].lerp(points[edge[1 - i] as usize], 1e-6)),
        line: 0,
        joints: [usize::MAX - 1, usize::MAX],
    };
    let strokes: Vec<Stroke> = edges.iter().map(stroke).collect();
    if edges.iter().any(|[a, b]| a == b) || crossing(&strokes).is_some() {
        return Err(too_coarse());
    }
    Ok(())
}

/// Triangulates; the triangles within the outline, counter-clockwise.
fn inner_triangles(points: &[DVec2], edges: &[[u32; 2]], outline: usize) -> Result<Vec<[u32; 3]>> {
    let unusable = |what: &str| Error::invalid(format!("it cannot be triangulated: {what}"));
    // The library takes no number so small that its square is lost.
    let whole = |x: f64| if x.abs() < 1e-12 { 0.0 } else { x };
    let vertices: Vec<Point2<f64>> = points.iter().map(|p| Point2::new(whole(p.x), whole(p.y))).collect();
    let constraints: Vec<[usize; 2]> = edges.iter().map(|edge| edge.map(|v| v as usize)).collect();
    let mut conflicts = 0usize;
    let cdt = Triangles::try_bulk_load_cdt(vertices, constraints, |_| conflicts += 1);
    let cdt = cdt.map_err(|error| unusable(&error.to_string()))?;
    if conflicts > 0 || cdt.num_vertices() != points.len() {
        return Err(unusable("lines cross or vertices coincide"));
    }
    let within = faces_within(&cdt, &edges[..outline])
        .ok_or_else(|| unusable("a vertex lies on a line between two others"))?;
    let faces = cdt.inner_faces().filter(|face| within[face.fix().index()]);
    let triangles: Vec<[u32; 3]> = faces.map(|face| face.vertices().map(|v| v.index() as u32)).collect();
    if triangles.iter().any(|corners| doubled_area(corners.map(|v| points[v as usize])) <= 0.0) {
        return Err(unusable("a triangle has no area"));
    }
    Ok(triangles)
}

/// Which faces lie within the outline: those on the left of its edges, and what is reached from them without crossing it.
fn faces_within(cdt: &Triangles, outline: &[[u32; 2]]) -> Option<Vec<bool>> {
    let handle = |v: u32| FixedVertexHandle::from_index(v as usize);
    let mut walls = vec![false; cdt.num_undirected_edges()];
    let mut open = Vec::with_capacity(outline.len());
    for &[a, b] in outline {
        let edge = cdt.get_edge_from_neighbors(handle(a), handle(b))?;
        walls[edge.as_undirected().fix().index()] = true;
        open.push(edge.face().as_inner()?);
    }
    let mut within = vec![false; cdt.num_all_faces()];
    while let Some(face) = open.pop() {
        if std::mem::replace(&mut within[face.fix().index()], true) {
            continue;
        }
        for edge in face.adjacent_edges() {
            if !walls[edge.as_undirected().fix().index()] {
                open.push(edge.rev().face().as_inner()?);
            }
        }
    }
    Some(within)
}
