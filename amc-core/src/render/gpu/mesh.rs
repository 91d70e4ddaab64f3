//! Vertices and triangles as buffers.

use std::mem::{offset_of, size_of};

use super::device::checked;
use crate::render::{Drawing, Vertex};
use crate::{Error, Result};

/// The vertices and corners of a drawing on the GPU.
#[derive(Debug, Clone)]
pub(super) struct MeshBuffers {
    pub(super) vertices: wgpu::Buffer,
    pub(super) corners: wgpu::Buffer,
}

impl MeshBuffers {
    /// Uploads a drawing whose indices are known to be in range.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, drawing: &Drawing) -> Result<Self> {
        let vertices: &[u8] = bytemuck::cast_slice(&drawing.vertices);
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
            corners: upload(device, queue, wgpu::BufferUsages::INDEX, corners),
        })
    }
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

const ATTRIBUTES: [wgpu::VertexAttribute; 5] = {
    use wgpu::VertexFormat::{Float32x2, Float32x3};
    const fn at(shader_location: u32, offset: usize, format: wgpu::VertexFormat) -> wgpu::VertexAttribute {
        wgpu::VertexAttribute { format, offset: offset as u64, shader_location }
    }
    [
        at(0, offset_of!(Vertex, position), Float32x3),
        at(1, offset_of!(Vertex, normal), Float32x3),
        at(2, offset_of!(Vertex, tangent), Float32x3),
        at(3, offset_of!(Vertex, uv), Float32x2),
        at(4, offset_of!(Vertex, occlusion), Float32x2),
    ]
};

/// How `vertex.wgsl` reads a [`Vertex`].
pub(super) const VERTEX_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &ATTRIBUTES,
};
