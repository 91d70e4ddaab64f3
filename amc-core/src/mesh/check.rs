//! From what a file holds to a checked [`Mesh`].

use glam::Vec3;
use rayon::prelude::*;

use super::draft::{Draft, DraftPart};
use super::lanes::{Edges, LANES, Lanes};
use super::{Mesh, normals};
use crate::{Error, Result};

/// Triangles that one task looks at.
const CHUNK: usize = 16 * 1024;

/// Sine of the angle between two edges below which a triangle has no area: a few roundings.
const NO_ANGLE: f32 = 1e-7;

/// Twice the vector area of a triangle; none for one that has no area or uses a vertex twice.
pub(super) fn vector_area(positions: &[Vec3], [a, b, c]: [u32; 3]) -> Option<Vec3> {
    let [a, b, c] = [a, b, c].map(|i| positions[i as usize]);
    let (ab, ac) = (b - a, c - a);
    let cross = ab.cross(ac);
    let least = (NO_ANGLE * NO_ANGLE) * (ab.length_squared() * ac.length_squared());
    (cross.length_squared() > least).then_some(cross)
}

/// What a look at some triangles found.
#[derive(Default, Clone, Copy)]
struct Findings {
    without_area: usize,
    area: f32,
    /// Area whose normals look away from the side that the winding calls the front.
    turned_area: f32,
}

impl Findings {
    fn add(self, other: Self) -> Self {
        Self {
            without_area: self.without_area + other.without_area,
            area: self.area + other.area,
            turned_area: self.turned_area + other.turned_area,
        }
    }
}

/// Some triangles, one array per coordinate.
struct Batch {
    edges: Edges,
    /// Sums of the corners' normals: x, y, z.
    normals: [Lanes; 3],
}

impl Batch {
    fn new() -> Self {
        Self { edges: Edges::NONE, normals: [[0.0; LANES]; 3] }
    }

    /// Takes at most [`LANES`] triangles; the other lanes have no area.
    fn fill(&mut self, draft: &Draft, triangles: &[[u32; 3]]) {
        if triangles.len() < LANES {
            *self = Self::new();
        }
        for (i, &triangle) in triangles.iter().take(LANES).enumerate() {
            self.edges.set(i, triangle.map(|vertex| draft.positions[vertex as usize]));
            let [a, b, c] = triangle.map(|vertex| draft.normals[vertex as usize]);
            for (lanes, x) in self.normals.iter_mut().zip((a + b + c).to_array()) {
                lanes[i] = x;
            }
        }
    }

    /// Twice the areas, zero where [`vector_area`] finds none; and whether the normals look away from the front.
    fn areas(&self) -> (Lanes, [bool; LANES]) {
        let [nx, ny, nz] = &self.normals;
        let (mut areas, mut turned) = ([0.0; LANES], [false; LANES]);
        for i in 0..LANES {
            let [px, py, pz, qx, qy, qz] = self.edges.0.each_ref().map(|lanes| lanes[i]);
            let [x, y, z] = self.edges.cross(i);
            let square = x * x + y * y + z * z;
            let lengths = (px * px + py * py + pz * pz) * (qx * qx + qy * qy + qz * qz);
            areas[i] = if square > (NO_ANGLE * NO_ANGLE) * lengths { square.sqrt() } else { 0.0 };
            turned[i] = x * nx[i] + y * ny[i] + z * nz[i] < 0.0;
        }
        (areas, turned)
    }
}

/// Checks and completes a draft.
///
/// Triangles without area are dropped. Where a part's normals contradict its winding over more than half of its
/// area, the winding is turned. Normals are made unit; missing ones are computed. Each comes with a notice.
///
/// # Errors
/// No triangle, or none that has an area.
pub(super) fn check(mut draft: Draft) -> Result<Mesh> {
    if draft.triangles.is_empty() {
        return Err(Error::invalid(match draft.file_vertices {
            0 => "holds no vertices and no triangles".to_owned(),
            1 => "a mesh of one point: holds no triangles".to_owned(),
            count => format!("holds {count} vertices but no triangles"),
        }));
    }
    let findings = look(&draft);
    turn_winding(&mut draft, &findings);
    drop_without_area(&mut draft, &findings)?;
    complete_normals(&mut draft);
    note_missing_uvs(&mut draft);
    take_fabric_somewhere(&mut draft);

    let mut triangle_parts = Vec::with_capacity(draft.triangles.len());
    for (index, part) in draft.parts.iter().enumerate() {
        triangle_parts.resize(part.triangles.end, index as u32);
    }
    let has_uvs = draft.parts.iter().any(|part| part.has_uvs);
    Ok(Mesh {
        positions: draft.positions,
        normals: draft.normals,
        uvs: has_uvs.then_some(draft.uvs),
        triangles: draft.triangles,
        triangle_parts,
        parts: draft.parts.into_iter().map(|part| part.part).collect(),
        file_vertices: draft.file_vertices,
        notices: draft.notices,
    })
}

/// One finding per part.
fn look(draft: &Draft) -> Vec<Findings> {
    let look_at = |triangles: &[[u32; 3]]| {
        let mut batch = Batch::new();
        let (mut found, mut with_area) = (Findings::default(), [0u32; LANES]);
        let (mut area, mut turned_area) = ([0.0; LANES], [0.0; LANES]);
        for triangles in triangles.chunks(LANES) {
            batch.fill(draft, triangles);
            let (areas, turned) = batch.areas();
            for i in 0..LANES {
                with_area[i] += u32::from(areas[i] > 0.0);
                area[i] += areas[i];
                turned_area[i] += if turned[i] { areas[i] } else { 0.0 };
            }
        }
        found.without_area = triangles.len() - with_area.iter().sum::<u32>() as usize;
        (found.area, found.turned_area) = (area.iter().sum(), turned_area.iter().sum());
        found
    };
    let look_at_part = |part: &DraftPart| {
        let chunks = draft.triangles[part.triangles.clone()].par_chunks(CHUNK);
        chunks.map(look_at).reduce(Findings::default, Findings::add)
    };
    draft.parts.par_iter().map(look_at_part).collect()
}

fn turn_winding(draft: &mut Draft, findings: &[Findings]) {
    let mut turned = Vec::new();
    for (part, found) in draft.parts.iter().zip(findings) {
        if part.has_normals && found.turned_area > 0.5 * found.area {
            for triangle in &mut draft.triangles[part.triangles.clone()] {
                triangle.swap(1, 2);
            }
            turned.push(part.part.name.clone());
        }
    }
    if !turned.is_empty() {
        draft
            .notices
            .push(format!("the winding contradicted the normals and was turned in {}", list(&turned, ", ")));
    }
}

fn drop_without_area(draft: &mut Draft, findings: &[Findings]) -> Result<()> {
    let dropped: usize = findings.iter().map(|found| found.without_area).sum();
    if dropped == 0 {
        return Ok(());
    }
    if dropped == draft.triangles.len() {
        return Err(Error::invalid(format!("none of the {dropped} triangles has an area")));
    }
    let (triangles, positions) = (std::mem::take(&mut draft.triangles), &draft.positions);
    let mut kept = Vec::with_capacity(triangles.len() - dropped);
    for part in &mut draft.parts {
        let start = kept.len();
        let with_area = |triangle: &[u32; 3]| vector_area(positions, *triangle).is_some();
        kept.extend(triangles[part.triangles.clone()].iter().copied().filter(with_area));
        part.triangles = start..kept.len();
    }
    draft.triangles = kept;
    draft.notices.push(format!("{dropped} triangles without area were dropped"));
    Ok(())
}

fn complete_normals(draft: &mut Draft) {
    let given: Vec<bool> = draft.parts.iter().map(|part| part.has_normals).collect();
    let unfit = normals::make_unit(&mut draft.normals);
    let lacking: usize =
        draft.parts.iter().filter(|part| !part.has_normals).map(|part| part.vertices.len()).sum();
    if unfit > lacking {
        let filled = normals::fill_zeros(draft);
        if filled > 0 {
            draft.notices.push(format!("{filled} normals without a direction were computed"));
        }
    }
    if given.contains(&false) {
        let names: Vec<String> =
            draft.parts.iter().filter(|part| !part.has_normals).map(|part| part.part.name.clone()).collect();
        normals::compute_missing(draft);
        let where_ =
            if given.contains(&true) { format!(" in {}", list(&names, ", ")) } else { String::new() };
        draft.notices.push(format!(
            "no normals{where_}: computed, with creases where faces meet at more than {} degrees",
            normals::CREASE_DEGREES
        ));
    }
}

fn note_missing_uvs(draft: &mut Draft) {
    let without: Vec<String> =
        draft.parts.iter().filter(|part| !part.has_uvs).map(|part| part.part.name.clone()).collect();
    if without.len() == draft.parts.len() {
        draft.notices.push("no UVs: each part is one panel, its direction must be procedural".to_owned());
    } else if !without.is_empty() {
        draft
            .notices
            .push(format!("no UVs in {}: one panel each, direction filled in", list(&without, ", ")));
    }
}

/// A file whose every part is named like a body has the garment under such a name.
fn take_fabric_somewhere(draft: &mut Draft) {
    if draft.parts.iter().all(|part| !part.part.takes_fabric) {
        for part in &mut draft.parts {
            part.part.takes_fabric = true;
        }
        draft.notices.push("no part is named like cloth: all of them take a fabric".to_owned());
    }
}

/// At most three items, then how many more.
pub(super) fn list(items: &[String], between: &str) -> String {
    let shown = items.iter().take(3).cloned().collect::<Vec<_>>().join(between);
    if items.len() > 3 { format!("{shown} and {} more", items.len() - 3) } else { shown }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Part;

    fn draft(normals: Vec3, triangles: &[[u32; 3]]) -> Draft {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y, Vec3::new(0.5, 0.0, 0.0)];
        Draft {
            normals: vec![normals; 5],
            uvs: positions.iter().map(|p| p.truncate()).collect(),
            parts: vec![DraftPart {
                part: Part { name: "cloth".into(), takes_fabric: true, ..Part::default() },
                vertices: 0..5,
                triangles: 0..triangles.len(),
                has_normals: normals != Vec3::ZERO,
                has_uvs: true,
            }],
            triangles: triangles.to_vec(),
            file_vertices: 5,
            positions,
            notices: Vec::new(),
        }
    }

    #[test]
    fn triangles_without_area_are_dropped_and_told() {
        let mesh = check(draft(Vec3::Z, &[[0, 1, 3], [0, 4, 1], [1, 1, 3], [1, 2, 3]])).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 3], [1, 2, 3]]);
        assert_eq!(mesh.notices, ["2 triangles without area were dropped"]);
        let error = check(draft(Vec3::Z, &[[0, 4, 1], [1, 1, 3]])).unwrap_err();
        assert_eq!(error.to_string(), "none of the 2 triangles has an area");
    }

    #[test]
    fn a_winding_against_the_normals_is_turned() {
        let mesh = check(draft(-Vec3::Z, &[[0, 1, 3], [1, 2, 3]])).unwrap();
        assert_eq!(mesh.triangles, [[0, 3, 1], [1, 3, 2]]);
        assert!(mesh.notices[0].contains("turned in cloth"), "{:?}", mesh.notices);
    }

    #[test]
    fn no_triangles_is_an_error_that_says_so() {
        let mut point = draft(Vec3::Z, &[]);
        point.file_vertices = 1;
        assert_eq!(check(point).unwrap_err().to_string(), "a mesh of one point: holds no triangles");
    }

    #[test]
    fn a_file_of_bodies_only_is_dressed() {
        let mut body = draft(Vec3::Z, &[[0, 1, 3]]);
        body.parts[0].part.takes_fabric = false;
        assert!(check(body).unwrap().parts[0].takes_fabric);
    }
}
