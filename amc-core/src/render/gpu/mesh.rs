//! Vertices, tangents and triangles as buffers.

use std::mem::{offset_of, size_of};
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::device::checked;
use crate::render::{Drawing, Vertex};
use crate::{Error, Result};

/// The vertices, tangents and corners of a drawing on the GPU. Tangents have a buffer of their own: they change while
/// the rest stays.
#[derive(Debug, Clone)]
pub(super) struct MeshBuffers {
    pub(super) vertices: wgpu::Buffer,
    pub(super) tangents: wgpu::Buffer,
    pub(super) corners: wgpu::Buffer,
    /// What they hold.
    held: Held,
}

#[derive(Debug, Clone)]
struct Held {
    vertices: Arc<Vec<Vertex>>,
    tangents: Arc<Vec<Vec3>>,
    triangles: Arc<Vec<[u32; 3]>>,
}

impl MeshBuffers {
    /// Uploads a drawing whose indices are known to be in range.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, drawing: &Drawing) -> Result<Self> {
        let vertices: &[u8] = bytemuck::cast_slice(&drawing.vertices);
        let tangents: &[u8] = bytemuck::cast_slice(&drawing.tangents);
        let corners: &[u8] = bytemuck::cast_slice(&drawing.triangles);
        let limit = device.limits().max_buffer_size;
        if vertices.len().max(corners.len()) as u64 > limit {
            return Err(Error::too_large(format!(
                "{} vertices and {} triangles; buffers of this graphics device hold {limit} bytes",
                drawing.vertices.len(),
                drawing.triangles.len()
            )));
        }
        checked(device, "the mesh", || Self {
            vertices: upload(device, queue, wgpu::BufferUsages::VERTEX, vertices),
            tangents: upload(device, queue, wgpu::BufferUsages::VERTEX, tangents),
            corners: upload(device, queue, wgpu::BufferUsages::INDEX, corners),
            held: Held {
                vertices: Arc::clone(&drawing.vertices),
                tangents: Arc::clone(&drawing.tangents),
                triangles: Arc::clone(&drawing.triangles),
            },
        })
    }

    /// How much they hold.
    pub(super) fn bytes(&self) -> u64 {
        self.vertices.size() + self.tangents.size() + self.corners.size()
    }

    /// The same, with a buffer of their own for the tangents.
    pub(super) fn with_own_tangents(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self> {
        let bytes = bytemuck::cast_slice(&self.held.tangents);
        let tangents =
            checked(device, "the mesh", || upload(device, queue, wgpu::BufferUsages::VERTEX, bytes))?;
        Ok(Self { tangents, ..self.clone() })
    }

    /// Whether `drawing` differs in its tangents only.
    pub(super) fn has_shape_of(&self, drawing: &Drawing) -> bool {
        Arc::ptr_eq(&self.held.vertices, &drawing.vertices)
            && Arc::ptr_eq(&self.held.triangles, &drawing.triangles)
    }

    /// Uploads those tangents that differ, of a drawing with as many; gives the number of bytes.
    pub(super) fn set_tangents(&mut self, queue: &wgpu::Queue, tangents: &Arc<Vec<Vec3>>) -> u64 {
        let differing = differing(&self.held.tangents, tangents);
        let start = (differing.start * size_of::<Vec3>()) as u64;
        let bytes: &[u8] = bytemuck::cast_slice(&tangents[differing]);
        if !bytes.is_empty() {
            queue.write_buffer(&self.tangents, start, bytes);
        }
        self.held.tangents = Arc::clone(tangents);
        bytes.len() as u64
    }
}

/// From the first to the last place where two lists of one length differ in any bit.
fn differing(old: &Arc<Vec<Vec3>>, new: &Arc<Vec<Vec3>>) -> Range<usize> {
    if Arc::ptr_eq(old, new) {
        return 0..0;
    }
    let (old, new): (&[[u32; 3]], &[[u32; 3]]) = (bytemuck::cast_slice(old), bytemuck::cast_slice(new));
    let mut pairs = old.iter().zip(new);
    let Some(first) = pairs.position(|(a, b)| a != b) else { return 0..0 };
    let last = pairs.rposition(|(a, b)| a != b).map_or(first, |after| first + 1 + after);
    first..last + 1
}

fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    usage: wgpu::BufferUsages,
    bytes: &[u8],
) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("mesh"),
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

const fn at(shader_location: u32, offset: usize, format: wgpu::VertexFormat) -> wgpu::VertexAttribute {
    wgpu::VertexAttribute { format, offset: offset as u64, shader_location }
}

const VERTEX: [wgpu::VertexAttribute; 4] = {
    use wgpu::VertexFormat::{Float32x2, Float32x3};
    [
        at(0, offset_of!(Vertex, position), Float32x3),
        at(1, offset_of!(Vertex, normal), Float32x3),
        at(3, offset_of!(Vertex, uv), Float32x2),
        at(4, offset_of!(Vertex, occlusion), Float32x2),
    ]
};

const TANGENT: [wgpu::VertexAttribute; 1] = [at(2, 0, wgpu::VertexFormat::Float32x3)];

/// How `vertex.wgsl` reads [`MeshBuffers`]: vertices at slot 0, tangents at slot 1.
pub(super) const VERTEX_LAYOUTS: [Option<wgpu::VertexBufferLayout<'static>>; 2] =
    [Some(layout(size_of::<Vertex>(), &VERTEX)), Some(layout(size_of::<Vec3>(), &TANGENT))];

const fn layout(
    stride: usize,
    attributes: &'static [wgpu::VertexAttribute],
) -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: stride as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_found_from_the_first_to_the_last() {
        let list = |x: [f32; 5]| Arc::new(x.map(Vec3::splat).to_vec());
        let old = list([0.0, 1.0, 2.0, 3.0, f32::NAN]);
        assert_eq!(differing(&old, &old), 0..0);
        assert_eq!(differing(&old, &list([0.0, 1.0, 2.0, 3.0, f32::NAN])), 0..0);
        assert_eq!(differing(&old, &list([0.0, 1.0, 7.0, 3.0, f32::NAN])), 2..3);
        assert_eq!(differing(&old, &list([0.0, 7.0, 2.0, 7.0, f32::NAN])), 1..4);
        assert_eq!(differing(&old, &list([-0.0, 1.0, 2.0, 3.0, 4.0])), 0..5);
    }
}
