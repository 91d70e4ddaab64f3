//! One primitive to one part.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use bytemuck::Pod;
use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::mesh::Mode;
use rayon::prelude::*;

use super::accessor::{indices, vectors};
use super::container::Buffers;
use super::extras_reader::ExtrasReader;
use super::scene::Instance;
use crate::mesh::Part;
use crate::mesh::draft::{Draft, DraftPart, check_position, clean_name, is_within_limit};
use crate::mesh::extras::Extras;
use crate::mesh::fabric_words::names_no_fabric;
use crate::{Error, Result};

/// Triangles that one task numbers.
const CHUNK: usize = 8 * 1024;

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
    buffers: &Buffers<'_>,
    extras: &mut ExtrasReader,
) -> Result<bool> {
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(false);
    }
    let named = |what: &'static str| move |error: Error| Error::new(error.kind(), format!("{what}: {error}"));
    let (vertices, triangles) = (draft.positions.len(), draft.triangles.len());
    let accessor =
        primitive.get(&gltf::Semantic::Positions).ok_or_else(|| Error::malformed("no positions"))?;
    append_positions(draft, &accessor, buffers, instance.to_world).map_err(named("positions"))?;
    let count = draft.positions.len() - vertices;
    let normals = primitive.get(&gltf::Semantic::Normals);
    if let Some(accessor) = &normals {
        append_normals(draft, accessor, buffers, instance.to_world).map_err(named("normals"))?;
    }
    let uvs = primitive.get(&gltf::Semantic::TexCoords(0));
    if let Some(accessor) = &uvs {
        append_uvs(draft, accessor, buffers).map_err(named("UVs"))?;
    }
    for (what, given, length) in
        [("normals", normals.is_some(), draft.normals.len()), ("UVs", uvs.is_some(), draft.uvs.len())]
    {
        if given && length != vertices + count {
            let message = format!("{} {what} for {count} positions", length - vertices);
            return Err(Error::malformed(message));
        }
    }
    if draft.positions.len() > u32::MAX as usize {
        return Err(Error::too_large("more vertices than 32 bits can number"));
    }
    draft.normals.resize(draft.positions.len(), Vec3::ZERO);
    draft.uvs.resize(draft.positions.len(), Vec2::ZERO);
    let corners = primitive.indices().map(|a| indices(&a, buffers)).transpose().map_err(named("indices"))?;
    let corners = corners.unwrap_or_else(|| Cow::Owned((0..count as u32).collect()));
    let mirrored = instance.to_world.determinant() < 0.0;
    append_triangles(draft, primitive.mode(), &corners, vertices..vertices + count, mirrored)?;
    if draft.triangles.len() == triangles {
        draft.positions.truncate(vertices);
        draft.normals.truncate(vertices);
        draft.uvs.truncate(vertices);
        return Ok(false);
    }
    draft.file_vertices += count;
    draft.parts.push(DraftPart {
        part: describe(primitive, instance, extras),
        vertices: vertices..draft.positions.len(),
        triangles: triangles..draft.triangles.len(),
        has_normals: normals.is_some(),
        has_uvs: uvs.is_some(),
    });
    Ok(true)
}

fn append_positions(
    draft: &mut Draft,
    accessor: &gltf::Accessor<'_>,
    buffers: &Buffers<'_>,
    to_world: Mat4,
) -> Result<()> {
    let (first, moved) = (draft.positions.len(), to_world != Mat4::IDENTITY);
    let place = |position| if moved { to_world.transform_point3(position) } else { position };
    let unsound = append_checked::<3, Vec3>(accessor, buffers, &mut draft.positions, place, is_within_limit)?;
    match unsound {
        Some(at) => check_position(draft.positions[first + at])
            .map_err(|error| Error::new(error.kind(), format!("vertex {at}: {error}"))),
        None => Ok(()),
    }
}

fn append_normals(
    draft: &mut Draft,
    accessor: &gltf::Accessor<'_>,
    buffers: &Buffers<'_>,
    to_world: Mat4,
) -> Result<()> {
    if to_world == Mat4::IDENTITY {
        return vectors::<3, Vec3>(accessor, buffers, &mut draft.normals, |normal| normal);
    }
    // The cofactors: the inverse transpose up to a factor, and defined for a flattening transform too.
    let linear = Mat3::from_mat4(to_world);
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    let turn = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
    vectors::<3, Vec3>(accessor, buffers, &mut draft.normals, |normal| {
        let turned = turn * normal;
        turned.try_normalize().unwrap_or(turned)
    })
}

/// UVs with v turned up: in glTF it runs down.
pub(super) fn append_uvs(
    draft: &mut Draft,
    accessor: &gltf::Accessor<'_>,
    buffers: &Buffers<'_>,
) -> Result<()> {
    let turn_up = |uv: Vec2| Vec2::new(uv.x, 1.0 - uv.y);
    match append_checked::<2, Vec2>(accessor, buffers, &mut draft.uvs, turn_up, |uv| uv.is_finite())? {
        Some(at) => Err(Error::invalid(format!("vertex {at}: not a finite number"))),
        None => Ok(()),
    }
}

/// Appends vectors, each after `convert`; gives the first of them that is not sound, counted from where they begin.
fn append_checked<const N: usize, V>(
    accessor: &gltf::Accessor<'_>,
    buffers: &Buffers<'_>,
    out: &mut Vec<V>,
    convert: impl Fn(V) -> V + Sync,
    is_sound: impl Fn(V) -> bool + Sync,
) -> Result<Option<usize>>
where
    V: Pod + From<[f32; N]> + Send + Sync,
{
    let first = out.len();
    // Threads append in no order: they tell only that something is wrong, and where is looked for once they are done.
    let fault = AtomicBool::new(false);
    vectors::<N, V>(accessor, buffers, out, |vector| {
        let vector = convert(vector);
        if !is_sound(vector) {
            fault.store(true, Ordering::Relaxed);
        }
        vector
    })?;
    let unsound = || out[first..].iter().position(|&vector| !is_sound(vector));
    Ok(fault.into_inner().then(unsound).flatten())
}

/// Appends triangles over the given vertices, turned where they are mirrored.
fn append_triangles(
    draft: &mut Draft,
    mode: Mode,
    corners: &[u32],
    vertices: Range<usize>,
    mirrored: bool,
) -> Result<()> {
    let (base, count) = (vertices.start as u32, vertices.len() as u32);
    let fault = AtomicBool::new(false);
    let placed = |[a, b, c]: [u32; 3]| {
        if a.max(b).max(c) >= count {
            fault.store(true, Ordering::Relaxed);
        }
        let [b, c] = if mirrored { [c, b] } else { [b, c] };
        [a, b, c].map(|corner| base.wrapping_add(corner))
    };
    match (mode, corners.split_first()) {
        (Mode::TriangleStrip, _) => {
            let strip = corners.array_windows::<3>().enumerate();
            let triangle =
                |(i, &[a, b, c]): (usize, &[u32; 3])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
            draft.triangles.extend(strip.map(triangle).map(placed));
        }
        (Mode::TriangleFan, Some((&hub, rim))) => {
            draft.triangles.extend(rim.array_windows::<2>().map(|&[a, b]| placed([hub, a, b])));
        }
        _ => {
            let triangles = corners.as_chunks::<3>().0.par_iter().with_min_len(CHUNK);
            draft.triangles.par_extend(triangles.map(|&triangle| placed(triangle)));
        }
    }
    match corners.iter().max().filter(|_| fault.load(Ordering::Relaxed)) {
        Some(largest) => Err(Error::malformed(format!("index {largest}, of {count} vertices"))),
        None => Ok(()),
    }
}

/// Name, kind and pattern: what `extras` say, else the mesh's or node's name (with the material's where a mesh has
/// several primitives).
fn describe(primitive: &gltf::Primitive<'_>, instance: &Instance<'_>, extras: &mut ExtrasReader) -> Part {
    let material = primitive.material();
    let node_extras = instance.node.as_ref().map(|node| node.extras());
    let all = [Some(primitive.extras()), Some(material.extras()), Some(instance.mesh.extras()), node_extras];
    let element = || format!("mesh {}, primitive {}", instance.mesh.index(), primitive.index());
    let said =
        all.into_iter().flatten().map(|raw| extras.read(raw, element)).fold(Extras::default(), Extras::or);
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
    let named_no_fabric =
        [&node_name, &mesh_name, &material_name].into_iter().any(|name| names_no_fabric(name));
    Part {
        name: said.name.as_deref().map(clean_name).unwrap_or(name),
        takes_fabric: said.fabric.unwrap_or(!named_no_fabric),
        pattern: said.into_pattern(),
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
