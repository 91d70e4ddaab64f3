//! The directions that a glTF file gives its cloth by KHR_materials_anisotropy.
//!
//! The extension's direction is that of the drawn-out highlight; the warp lies across it (see [`crate::export::tangents`]).

use std::collections::HashMap;
use std::f32::consts::FRAC_PI_2;

use glam::{DVec2, Mat3, Vec2, Vec3, Vec4};
use serde::Deserialize;

use super::accessor::vectors;
use super::anisotropic_material::{Way, ways};
use super::container::{self, Buffers};
use super::extras_reader::ExtrasReader;
use super::scene::Instance;
use super::{parse, primitive, scene};
use crate::direction::Record;
use crate::mesh::draft::Draft;
use crate::mesh::{Garment, Resolve, uv_area};
use crate::{Error, Result};

/// Where the mean of a panel's directions is shorter than this, they differ by more than some degrees.
const LEAST_AGREEMENT: f64 = 0.99;

/// What a glTF file says of one panel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Anisotropy {
    /// Where its warp runs: (a, b) stands for `a dP/du + b dP/dv`. None where it has no anisotropy or no UVs.
    pub warp: Option<Vec2>,
    /// Whether the direction is not one: `warp` is the mean.
    pub varies: bool,
    /// What our own export says of it; none: another program's.
    pub record: Option<Record>,
    /// The least and the largest u and v of `TEXCOORD_1`, v up: of the pattern as it was drawn, in our own exports.
    pub drawn: Option<[Vec2; 2]>,
}

/// What a primitive says.
#[derive(Default)]
struct Said {
    record: Option<Record>,
    drawn: Option<[Vec2; 2]>,
    varies: bool,
}

/// A triangle's primitive, and where its warp runs in space.
type Triangles = HashMap<[u32; 15], (usize, Vec3)>;

/// Reads a glTF or GLB file as [`parse`] does and cuts it into panels; what is said of each stands in their order.
///
/// # Errors
/// As [`parse`] and [`Garment::new`]; besides a texture of an anisotropy that cannot be read, or tangents that are not four
/// numbers for each vertex.
pub fn anisotropy(bytes: &[u8], resolve: Resolve<'_>) -> Result<(Garment, Vec<Anisotropy>)> {
    // This one bounds how often meshes may be placed.
    let garment = Garment::new(parse(bytes, resolve)?)?;
    let (json, chunk) = container::split(bytes)?;
    let document = container::document(json)?;
    let buffers = Buffers::read(&document, chunk, resolve)?;
    let ways = ways(json, &document, &buffers, resolve)?;
    let mut extras = ExtrasReader::new(bytes.len() + buffers.bytes());
    let (mut triangles, mut said) = (Triangles::new(), Vec::new());
    for instance in &scene::instances(&document)? {
        for primitive in instance.mesh.primitives() {
            let here = |error: Error| {
                let place = format!("mesh {}, primitive {}", instance.mesh.index(), primitive.index());
                error.at_element(place)
            };
            let mut draft = Draft::default();
            if primitive::append(&mut draft, &primitive, instance, &buffers, &mut extras).map_err(here)? {
                let way = primitive.material().index().and_then(|index| ways.get(&index));
                let source = Primitive { primitive: &primitive, instance, buffers: &buffers };
                let number = said.len();
                source.add_triangles(&draft, way, number, &mut triangles).map_err(here)?;
                said.push(source.said(way).map_err(here)?);
            }
        }
    }
    let panels =
        (0..garment.panels.len()).map(|panel| of_panel(&garment, panel, &triangles, &said)).collect();
    Ok((garment, panels))
}

/// One primitive in its place.
struct Primitive<'a> {
    primitive: &'a gltf::Primitive<'a>,
    instance: &'a Instance<'a>,
    buffers: &'a Buffers<'a>,
}

impl Primitive<'_> {
    /// Keeps where the warp runs in each triangle of `draft`, which is this primitive; zero where there is no `way`.
    fn add_triangles(
        &self,
        draft: &Draft,
        way: Option<&Way>,
        number: usize,
        triangles: &mut Triangles,
    ) -> Result<()> {
        let tangents = self.tangents(draft.positions.len())?;
        let other_uvs = match way {
            Some(way) if way.tex_coord != 0 && tangents.is_none() => self.uvs(way.tex_coord)?,
            _ => None,
        };
        let uvs = other_uvs.as_ref().filter(|uvs| uvs.len() == draft.uvs.len()).unwrap_or(&draft.uvs);
        for corners in &draft.triangles {
            let corners = corners.map(|corner| corner as usize);
            let at = corners.map(|corner| draft.positions[corner]);
            let face = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero();
            let of_uvs = of_uvs(at, corners.map(|corner| uvs[corner]));
            let along = |corner: usize, way: &Way| {
                let normal = draft.normals[corner].try_normalize().unwrap_or(face);
                let tangent = tangents.as_ref().map_or(of_uvs, |tangents| tangents[corner]);
                // A quarter turn back from the highlight.
                let (sin, cos) = (way.angle - FRAC_PI_2).sin_cos();
                let t = tangent.truncate();
                t * cos + normal.cross(t) * (tangent.w * sin)
            };
            let warp = way.map(|way| corners.iter().map(|&corner| along(corner, way)).sum::<Vec3>());
            let key = key(at, corners.map(|corner| draft.uvs[corner]));
            triangles.insert(key, (number, warp.unwrap_or_default()));
        }
        Ok(())
    }

    /// Tangents in space, unit, with their signs; none where the file has none.
    fn tangents(&self, count: usize) -> Result<Option<Vec<Vec4>>> {
        let Some(accessor) = self.primitive.get(&gltf::Semantic::Tangents) else { return Ok(None) };
        let linear = Mat3::from_mat4(self.instance.to_world);
        let sense = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
        let place = |tangent: Vec4| {
            (linear * tangent.truncate()).normalize_or_zero().extend(tangent.w.signum() * sense)
        };
        let mut tangents = Vec::new();
        vectors::<4, Vec4>(&accessor, self.buffers, &mut tangents, place)?;
        match tangents.len() == count {
            true => Ok(Some(tangents)),
            false => Err(Error::malformed(format!("{} tangents for {count} positions", tangents.len()))),
        }
    }

    /// A set of UVs, v up; none where the file has none.
    fn uvs(&self, set: u32) -> Result<Option<Vec<Vec2>>> {
        let Some(accessor) = self.primitive.get(&gltf::Semantic::TexCoords(set)) else { return Ok(None) };
        let mut draft = Draft::default();
        primitive::append_uvs(&mut draft, &accessor, self.buffers)?;
        Ok(Some(draft.uvs))
    }

    fn said(&self, way: Option<&Way>) -> Result<Said> {
        #[derive(Deserialize)]
        struct Ours {
            #[serde(flatten)]
            record: Record,
            // Only our exports say it.
            #[serde(rename = "follows_pattern")]
            _follows_pattern: bool,
        }
        let text = self.primitive.extras().as_ref().map(|raw| raw.get());
        let record = text.and_then(|text| serde_json::from_str::<Ours>(text).ok()).map(|ours| ours.record);
        let drawn = if record.is_some() { self.uvs(1)? } else { None };
        let bounds = |uvs: Vec<Vec2>| {
            let low = uvs.iter().copied().reduce(Vec2::min)?;
            Some([low, uvs.into_iter().reduce(Vec2::max)?])
        };
        Ok(Said { record, drawn: drawn.and_then(bounds), varies: way.is_some_and(|way| way.varies) })
    }
}

/// T of a triangle by its UVs (v up), with the sign of B.
fn of_uvs(at: [Vec3; 3], uv: [Vec2; 3]) -> Vec4 {
    let (e, f) = (at[1] - at[0], at[2] - at[0]);
    let (s, t) = (uv[1] - uv[0], uv[2] - uv[0]);
    let sign = s.perp_dot(t).signum();
    ((e * t.y - f * s.y) * sign).normalize_or_zero().extend(sign)
}

/// By which a triangle is known again, whatever the order of its corners.
fn key(at: [Vec3; 3], uv: [Vec2; 3]) -> [u32; 15] {
    let mut corners: [[u32; 5]; 3] = std::array::from_fn(|k| {
        // Adding zero makes the two zeros one.
        let (p, uv) = (at[k] + 0.0, uv[k] + 0.0);
        [p.x, p.y, p.z, uv.x, uv.y].map(f32::to_bits)
    });
    corners.sort_unstable();
    std::array::from_fn(|k| corners[k / 5][k % 5])
}

/// The mean over a panel's triangles, by area.
fn of_panel(garment: &Garment, panel: usize, known: &Triangles, said: &[Said]) -> Anisotropy {
    let range = &garment.panels[panel].triangles;
    let triangles = garment.triangles.get(range.start as usize..range.end as usize).unwrap_or_default();
    let (mut sum, mut total, mut whole, mut source) = (DVec2::ZERO, 0.0, 0.0, None);
    for corners in triangles {
        let at = corners.map(|corner| garment.positions[corner as usize]);
        let uv = corners.map(|corner| garment.uvs[corner as usize]);
        let Some(&(number, warp)) = known.get(&key(at, uv)) else { continue };
        source.get_or_insert(number);
        if let Some(warp) = in_uvs(at, uv, warp) {
            let area = f64::from((at[1] - at[0]).cross(at[2] - at[0]).length());
            sum += warp * area;
            total += warp.length() * area;
            whole += area;
        }
    }
    let said = source.and_then(|number| said.get(number));
    let warp = (sum / whole).as_vec2();
    Anisotropy {
        warp: (warp.is_finite() && sum.length() > 0.05 * total && garment.has_uvs).then_some(warp),
        varies: said.is_some_and(|said| said.varies) || sum.length() < LEAST_AGREEMENT * total,
        record: said.and_then(|said| said.record.clone()),
        drawn: said.and_then(|said| said.drawn),
    }
}

/// A vector in the plane of a triangle as `a dP/du + b dP/dv`: (a, b), made for a vector of length one. None where it has no
/// such direction.
fn in_uvs(at: [Vec3; 3], uv: [Vec2; 3], vector: Vec3) -> Option<DVec2> {
    let (e, f) = (at[1] - at[0], at[2] - at[0]);
    let normal = e.cross(f);
    let flat = (vector - vector.project_onto_normalized(normal.try_normalize()?)).try_normalize()?;
    if uv_area(uv) == 0.0 {
        return None;
    }
    // flat = x e + y f.
    let over = f64::from(normal.length_squared());
    let x = f64::from(flat.cross(f).dot(normal)) / over;
    let y = f64::from(e.cross(flat).dot(normal)) / over;
    let found = (uv[1] - uv[0]).as_dvec2() * x + (uv[2] - uv[0]).as_dvec2() * y;
    found.is_finite().then_some(found)
}

#[cfg(test)]
mod tests;
