//! One primitive to one part.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::mesh::Mode;
use serde::Deserialize;

use super::accessor::{indices, vectors};
use super::scene::Instance;
use crate::mesh::Part;
use crate::mesh::draft::{Draft, DraftPart, check_position, clean_name};
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
    let accessor =
        primitive.get(&gltf::Semantic::Positions).ok_or_else(|| Error::malformed("no positions"))?;
    let positions = vectors::<3>(&accessor, buffers).map_err(named("positions"))?;
    let count = positions.len();
    let normals = primitive.get(&gltf::Semantic::Normals);
    let normals = normals.map(|a| vectors::<3>(&a, buffers)).transpose().map_err(named("normals"))?;
    let uvs = primitive.get(&gltf::Semantic::TexCoords(0));
    let uvs = uvs.map(|a| vectors::<2>(&a, buffers)).transpose().map_err(named("UVs"))?;
    if normals.as_ref().is_some_and(|n| n.len() != count)
        || uvs.as_ref().is_some_and(|uvs| uvs.len() != count)
    {
        return Err(Error::malformed("normals or UVs in another number than positions"));
    }
    let corners = primitive.indices().map(|a| indices(&a, buffers)).transpose().map_err(named("indices"))?;
    if let Some(bad) = corners.iter().flatten().find(|&&corner| corner as usize >= count) {
        return Err(Error::malformed(format!("index {bad}, of {count} vertices")));
    }
    if let Some(at) = uvs.iter().flatten().position(|uv| !(uv[0].is_finite() && uv[1].is_finite())) {
        return Err(Error::invalid(format!("UV {at} is not a finite number")));
    }

    let (vertices, triangles) = (draft.positions.len(), draft.triangles.len());
    if vertices + count > u32::MAX as usize {
        return Err(Error::too_large("more vertices than 32 bits can number"));
    }
    append_positions(draft, positions, instance.to_world)?;
    let part = DraftPart {
        part: describe(primitive, instance),
        has_normals: normals.is_some(),
        has_uvs: uvs.is_some(),
        ..DraftPart::default()
    };
    append_normals(draft, normals, instance.to_world);
    // glTF's v runs down.
    draft.uvs.extend(uvs.into_iter().flatten().map(|[u, v]| Vec2::new(u, 1.0 - v)));
    draft.uvs.resize(draft.positions.len(), Vec2::ZERO);
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

fn append_positions(draft: &mut Draft, positions: Vec<[f32; 3]>, to_world: Mat4) -> Result<()> {
    let first = draft.positions.len();
    if to_world == Mat4::IDENTITY {
        draft.positions.extend(positions.into_iter().map(Vec3::from));
    } else {
        draft.positions.extend(positions.into_iter().map(|p| to_world.transform_point3(Vec3::from(p))));
    }
    for (at, &position) in draft.positions[first..].iter().enumerate() {
        check_position(position)
            .map_err(|error| Error::new(error.kind(), format!("vertex {at}: {error}")))?;
    }
    Ok(())
}

fn append_normals(draft: &mut Draft, normals: Option<Vec<[f32; 3]>>, to_world: Mat4) {
    let linear = Mat3::from_mat4(to_world);
    let normals = normals.into_iter().flatten().map(Vec3::from);
    if linear == Mat3::IDENTITY {
        draft.normals.extend(normals);
    } else {
        // The cofactors: the inverse transpose up to a factor, and defined for a flattening transform too.
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
        let turn = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        draft.normals.extend(normals.map(|normal| {
            let turned = turn * normal;
            turned.try_normalize().unwrap_or(turned)
        }));
    }
    draft.normals.resize(draft.positions.len(), Vec3::ZERO);
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
