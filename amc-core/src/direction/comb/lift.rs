//! Strokes laid on the surface.

use glam::{DVec2, DVec3, Vec3};

use super::nearest::Found;
use super::panel_mesh::PanelMesh;
use super::stroke::{Path, Stroke};

/// Points of a stroke to a mean edge: their distance is the error of its nearest point, from which a vertex takes its
/// direction.
const DENSITY: f64 = 8.0;
/// Points that all strokes of a panel may have together.
const MOST_SAMPLES: usize = 1 << 16;
/// A stroke's own share of these is never less.
const LEAST_SAMPLES: usize = 512;

/// A point of a stroke on the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) triangle: u32,
    /// Barycentric coordinates in it.
    pub(super) shares: [f32; 3],
    pub(super) position: DVec3,
    /// The stroke's direction, unit, in the triangle's plane.
    pub(super) direction: DVec3,
    /// Metres of the stroke that it stands for.
    pub(super) length: f64,
}

/// The points of a stroke, in its order; what runs off the panel by more than its radius is left out. `strokes` share the
/// number of points.
pub(super) fn lift(mesh: &PanelMesh, stroke: &Stroke, strokes: usize) -> Vec<Sample> {
    let (points, in_pattern): (Vec<DVec3>, bool) = match &stroke.path {
        Path::Pattern(points) => (points.iter().map(|point| point.as_dvec2().extend(0.0)).collect(), true),
        Path::Space(points) => (points.iter().map(|point| point.as_dvec3()).collect(), false),
    };
    let metres = if in_pattern { mesh.metres_per_uv } else { Some(1.0) };
    let (Some(metres), Some(line)) = (metres, Line::new(points)) else { return Vec::new() };
    let step = mesh.mean_edge / DENSITY;
    let most = (MOST_SAMPLES / strokes.max(1)).max(LEAST_SAMPLES);
    let count = ((line.length() * metres / step).ceil() as usize).clamp(1, most);
    let reach = f64::from(stroke.radius) / metres;
    let search = if in_pattern { mesh.in_pattern() } else { mesh.in_space() };
    let sample = |(at, direction): (DVec3, DVec3)| {
        let found = search.nearest(at.as_vec3()).filter(|found| f64::from(found.distance) <= reach)?;
        let length = line.length() / count as f64;
        if in_pattern {
            of_pattern(mesh, found, direction, length)
        } else {
            of_space(mesh, found, direction, length)
        }
    };
    line.points(count).filter_map(sample).collect()
}

/// A line through points that differ.
struct Line {
    points: Vec<DVec3>,
    /// Unit directions at the points.
    directions: Vec<DVec3>,
    /// Lengths from the start to each point.
    lengths: Vec<f64>,
}

impl Line {
    /// None without length.
    fn new(mut points: Vec<DVec3>) -> Option<Self> {
        points.dedup();
        if points.len() < 2 {
            return None;
        }
        let directions = (0..points.len()).map(|k| {
            let (before, after) = (points[k.saturating_sub(1)], points[(k + 1).min(points.len() - 1)]);
            // A line that turns back on itself keeps the way it came.
            (after - before).try_normalize().unwrap_or_else(|| (points[k] - before).normalize_or_zero())
        });
        let mut length = 0.0;
        let further = points.windows(2).map(|pair| {
            length += (pair[1] - pair[0]).length();
            length
        });
        let lengths: Vec<f64> = std::iter::once(0.0).chain(further).collect();
        Some(Self { directions: directions.collect(), lengths, points })
    }

    fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or_default()
    }

    /// The middles of `count` equal parts, with the directions there.
    fn points(&self, count: usize) -> impl Iterator<Item = (DVec3, DVec3)> {
        let step = self.length() / count as f64;
        let mut segment = 0;
        (0..count).map(move |k| {
            let at = (k as f64 + 0.5) * step;
            while segment + 2 < self.points.len() && self.lengths[segment + 1] < at {
                segment += 1;
            }
            let (start, end) = (self.lengths[segment], self.lengths[segment + 1]);
            let share = ((at - start) / (end - start)).clamp(0.0, 1.0);
            let between = |values: &[DVec3]| values[segment].lerp(values[segment + 1], share);
            (between(&self.points), between(&self.directions))
        })
    }
}

fn of_pattern(mesh: &PanelMesh, found: Found, direction: DVec3, length: f64) -> Option<Sample> {
    let [along_u, along_v] = along_uv(mesh, found.triangle)?;
    let step = along_u * direction.x + along_v * direction.y;
    let unit = step.try_normalize()?;
    Some(Sample {
        triangle: found.triangle,
        shares: found.shares,
        position: at(mesh, found),
        direction: unit,
        length: length * step.length() / direction.length(),
    })
}

fn of_space(mesh: &PanelMesh, found: Found, direction: DVec3, length: f64) -> Option<Sample> {
    let [a, b, c] =
        mesh.triangles[found.triangle as usize].map(|vertex| mesh.positions[vertex as usize].as_dvec3());
    let normal = (b - a).cross(c - a).try_normalize()?;
    let flat = direction - normal * normal.dot(direction);
    // A stroke into the cloth has no direction on it.
    let unit = flat.try_normalize().filter(|_| flat.length() > 1e-3 * direction.length())?;
    Some(Sample {
        triangle: found.triangle,
        shares: found.shares,
        position: at(mesh, found),
        direction: unit,
        length,
    })
}

fn at(mesh: &PanelMesh, found: Found) -> DVec3 {
    let corners: [Vec3; 3] =
        mesh.triangles[found.triangle as usize].map(|vertex| mesh.positions[vertex as usize]);
    corners.iter().zip(found.shares).map(|(corner, share)| corner.as_dvec3() * f64::from(share)).sum()
}

/// dP/du and dP/dv of a triangle; none where its UVs have no area.
pub(super) fn along_uv(mesh: &PanelMesh, triangle: u32) -> Option<[DVec3; 2]> {
    let corners = mesh.triangles[triangle as usize];
    let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
    let [flat_a, flat_b, flat_c] = corners.map(|vertex| mesh.uvs[vertex as usize].as_dvec2());
    let (p, q): (DVec2, DVec2) = (flat_b - flat_a, flat_c - flat_a);
    let inverse = 1.0 / p.perp_dot(q);
    let along_u = ((b - a) * q.y - (c - a) * p.y) * inverse;
    let along_v = ((c - a) * p.x - (b - a) * q.x) * inverse;
    (along_u.is_finite() && along_v.is_finite()).then_some([along_u, along_v])
}
