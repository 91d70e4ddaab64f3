//! One primitive to one part.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::mesh::Mode;
use serde::Deserialize;

use super::accessor::{indices, vectors};
use super::scene::Instance;
use crate::mesh::Part;
use crate::mesh::draft::{COORDINATE_LIMIT, Draft, DraftPart, check_position, clean_name};
use crate::mesh::fabric_words::names_no_fabric;
use crate::{Error, Result};

/// What `extras` may say to us.
#[derive(Deserialize, Default)]
struct Extras {
    #[serde(default)]
    amc: AmcExtras,
}

#[derive(Deserialize, Default)]
struct AmcExtras {
    name: Option<String>,
    fabric: Option<bool>,
}

/// Makes room for all instances, as far as `budget` allows what they say of themselves.
pub(super) fn reserve(draft: &mut Draft, instances: &[Instance<'_>], budget: usize) {
    let (mut vertices, mut corners) = (0usize, 0usize);
    for primitive in instances.iter().flat_map(|instance| instance.mesh.primitives()) {
        let count = primitive.get(&gltf::Semantic::Positions).map_or(0, |accessor| accessor.count());
        vertices = vertices.saturating_add(count);
        corners = corners.saturating_add(primitive.indices().map_or(count, |accessor| accessor.count()));
    }
    // A vertex takes 12 bytes in the file, or 4 quantised, and a corner at least one.
    if vertices <= budget / 4 && corners / 3 <= budget / 3 {
        draft.positions.reserve_exact(vertices);
        draft.normals.reserve_exact(vertices);
        draft.uvs.reserve_exact(vertices);
        draft.triangles.reserve_exact(corners / 3);
    }
}

/// Appends a primitive as a part; false if it has no triangles to append.
pub(super) fn append(
    draft: &mut Draft,
    primitive: &gltf::Primitive<'_>,
    instance: &Instance<'_>,
    buffers: &[Cow<'_, [u8]>],
) -> Result<bool> {
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(false);
    }
    let named = |what: &'static str| move |error: Error| Error::new(error.kind(), format!("{what}: {error}"));
    let (vertices, triangles) = (draft.positions.len(), draft.triangles.len());
    let accessor =
        primitive.get(&gltf::Semantic::Positions).ok_or_else(|| Error::malformed("no positions"))?;
    vectors::<3, Vec3>(&accessor, buffers, &mut draft.positions).map_err(named("positions"))?;
    let count = draft.positions.len() - vertices;
    let normals = primitive.get(&gltf::Semantic::Normals);
    if let Some(accessor) = &normals {
        vectors::<3, Vec3>(accessor, buffers, &mut draft.normals).map_err(named("normals"))?;
    }
    let uvs = primitive.get(&gltf::Semantic::TexCoords(0));
    if let Some(accessor) = &uvs {
        vectors::<2, Vec2>(accessor, buffers, &mut draft.uvs).map_err(named("UVs"))?;
    }
    let fits = |given: bool, length: usize| !given || length == vertices + count;
    if !fits(normals.is_some(), draft.normals.len()) || !fits(uvs.is_some(), draft.uvs.len()) {
        return Err(Error::malformed("normals or UVs in another number than positions"));
    }
    if draft.positions.len() > u32::MAX as usize {
        return Err(Error::too_large("more vertices than 32 bits can number"));
    }
    draft.normals.resize(draft.positions.len(), Vec3::ZERO);
    draft.uvs.resize(draft.positions.len(), Vec2::ZERO);
    let corners = primitive.indices().map(|a| indices(&a, buffers)).transpose().map_err(named("indices"))?;
    let largest = corners.iter().flatten().copied().max();
    if let Some(largest) = largest.filter(|&largest| largest as usize >= count) {
        return Err(Error::malformed(format!("index {largest}, of {count} vertices")));
    }
    place(&mut draft.positions[vertices..], &mut draft.normals[vertices..], instance.to_world);
    check_positions(&draft.positions[vertices..])?;
    if uvs.is_some() {
        turn_up(&mut draft.uvs[vertices..])?;
    }
    let part = DraftPart {
        part: describe(primitive, instance),
        has_normals: normals.is_some(),
        has_uvs: uvs.is_some(),
        ..DraftPart::default()
    };
    append_triangles(draft, primitive.mode(), corners, vertices as u32, count as u32);
    if instance.to_world.determinant() < 0.0 {
        draft.triangles[triangles..].iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    if draft.triangles.len() == triangles {
        draft.positions.truncate(vertices);
        draft.normals.truncate(vertices);
        draft.uvs.truncate(vertices);
        return Ok(false);
    }
    draft.file_vertices += count;
    draft.parts.push(DraftPart {
        vertices: vertices..draft.positions.len(),
        triangles: triangles..draft.triangles.len(),
        ..part
    });
    Ok(true)
}

/// Takes positions and normals from the mesh's space to the world's.
fn place(positions: &mut [Vec3], normals: &mut [Vec3], to_world: Mat4) {
    if to_world == Mat4::IDENTITY {
        return;
    }
    for position in positions {
        *position = to_world.transform_point3(*position);
    }
    // The cofactors: the inverse transpose up to a factor, and defined for a flattening transform too.
    let linear = Mat3::from_mat4(to_world);
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    let turn = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
    for normal in normals {
        let turned = turn * *normal;
        *normal = turned.try_normalize().unwrap_or(turned);
    }
}

fn check_positions(positions: &[Vec3]) -> Result<()> {
    // One branch for all; a number that is none fails the comparison too.
    let fine =
        positions.iter().fold(true, |fine, p| fine & p.abs().cmple(Vec3::splat(COORDINATE_LIMIT)).all());
    let faults = positions.iter().enumerate().filter(|_| !fine);
    for (at, &position) in faults {
        check_position(position)
            .map_err(|error| Error::new(error.kind(), format!("vertex {at}: {error}")))?;
    }
    Ok(())
}

/// Turns v up: in glTF it runs down.
fn turn_up(uvs: &mut [Vec2]) -> Result<()> {
    let mut finite = true;
    for uv in &mut *uvs {
        finite &= uv.is_finite();
        uv.y = 1.0 - uv.y;
    }
    let fault = uvs.iter().position(|uv| !uv.is_finite()).filter(|_| !finite);
    fault.map_or(Ok(()), |at| Err(Error::invalid(format!("UV {at} is not a finite number"))))
}

fn append_triangles(draft: &mut Draft, mode: Mode, corners: Option<Vec<u32>>, base: u32, count: u32) {
    let corners = corners.unwrap_or_else(|| (0..count).collect());
    let shifted = |triangle: [u32; 3]| triangle.map(|corner| base + corner);
    match (mode, corners.split_first()) {
        (Mode::TriangleStrip, _) => {
            let strip = corners.array_windows::<3>().enumerate();
            draft
                .triangles
                .extend(strip.map(|(i, &[a, b, c])| shifted(if i % 2 == 0 { [a, b, c] } else { [b, a, c] })));
        }
        (Mode::TriangleFan, Some((&hub, rim))) => {
            draft.triangles.extend(rim.array_windows::<2>().map(|&[a, b]| shifted([hub, a, b])));
        }
        _ => draft.triangles.extend(corners.as_chunks::<3>().0.iter().map(|&triangle| shifted(triangle))),
    }
}

/// Name and kind: what `extras` say, else the mesh's or node's name (with the material's where a mesh has several
/// primitives).
fn describe(primitive: &gltf::Primitive<'_>, instance: &Instance<'_>) -> Part {
    let material = primitive.material();
    let node_extras = instance.node.as_ref().map(|node| node.extras());
    let said: Vec<AmcExtras> =
        [Some(primitive.extras()), Some(material.extras()), Some(instance.mesh.extras()), node_extras]
            .into_iter()
            .flatten()
            .map(|extras| extras.as_ref().and_then(|raw| serde_json::from_str::<Extras>(raw.get()).ok()))
            .map(|extras| extras.unwrap_or_default().amc)
            .collect();
    let node_name = instance.node.as_ref().and_then(|node| node.name()).map(clean_name).unwrap_or_default();
    let mesh_name = instance.mesh.name().map(clean_name).unwrap_or_default();
    let material_name = material.name().map(clean_name).unwrap_or_default();
    let own = [&node_name, &mesh_name].into_iter().find(|name| !name.is_empty()).cloned();
    let own = own.unwrap_or_else(|| format!("mesh {}", instance.mesh.index()));
    let name = match (instance.mesh.primitives().len() > 1, material_name.is_empty()) {
        (false, _) => own,
        (true, false) => format!("{own} {material_name}"),
        (true, true) => format!("{own} {}", primitive.index()),
    };
    let fabric = said.iter().find_map(|said| said.fabric);
    let named_no_fabric =
        [&node_name, &mesh_name, &material_name].into_iter().any(|name| names_no_fabric(name));
    Part {
        name: said.iter().find_map(|said| said.name.as_deref()).map(clean_name).unwrap_or(name),
        takes_fabric: fabric.unwrap_or(!named_no_fabric),
    }
}

/// Numbers parts of the same name, as instances of one mesh are.
pub(super) fn tell_apart(draft: &mut Draft) {
    let mut uses: HashMap<String, usize> = HashMap::new();
    for part in &mut draft.parts {
        let uses = uses.entry(part.part.name.clone()).or_default();
        *uses += 1;
        if *uses > 1 {
            part.part.name = format!("{} {}", part.part.name, *uses);
        }
    }
}
