//! What the shaders read from uniform buffers. A test holds the layouts against the WGSL.

use glam::{Mat4, Vec4};

use crate::amc::Amc;
use crate::render::{LaidPrint, Shading, View};

/// `View` of `view.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct ViewUniforms {
    pub(super) object_to_view: Mat4,
    pub(super) view_to_clip: Mat4,
    pub(super) occlusion: f32,
    pub(super) padding: [f32; 3],
}

impl ViewUniforms {
    pub(super) fn new(view: &View, shading: &Shading) -> Self {
        Self {
            object_to_view: view.object_to_view,
            view_to_clip: view.view_to_clip(),
            occlusion: if shading.occlusion { 1.0 } else { 0.0 },
            padding: [0.0; 3],
        }
    }
}

/// `Fabric` of `table.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FabricUniforms {
    pub(super) symmetry: f32,
    pub(super) slices: f32,
    pub(super) padding: [f32; 2],
}

impl FabricUniforms {
    pub(super) fn new(amc: &Amc) -> Self {
        Self { symmetry: amc.symmetry.order() as f32, slices: amc.size().slices() as f32, padding: [0.0; 2] }
    }
}

/// `Print` of `print.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct PrintUniforms {
    pub(super) across: Vec4,
    pub(super) down: Vec4,
    pub(super) picture: Vec4,
}

impl PrintUniforms {
    pub(super) fn new(laid: &LaidPrint) -> Self {
        let [u, v, shift] = laid.uv_to_picture.to_cols_array_2d();
        let repeated = if laid.is_repeated { 1.0 } else { 0.0 };
        let last_level = (laid.print.levels().len() - 1) as f32;
        Self {
            across: Vec4::new(u[0], v[0], shift[0], 0.0),
            down: Vec4::new(u[1], v[1], shift[1], 0.0),
            picture: laid.print.size().extend(last_level).extend(repeated),
        }
    }
}

/// A uniform buffer with `content`.
pub(super) fn buffer<T: bytemuck::Pod>(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    content: &T,
) -> wgpu::Buffer {
    let bytes = bytemuck::bytes_of(content);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.len() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::{Sources, validate};
    use std::mem::{offset_of, size_of};

    fn layout(shader: &str, name: &str) -> (usize, Vec<(String, usize)>) {
        let checked = validate(&Sources::embedded(), shader).unwrap();
        let layout = checked.struct_layout(name).unwrap();
        let members =
            layout.members.into_iter().map(|member| (member.name, member.offset as usize)).collect();
        (layout.size as usize, members)
    }

    macro_rules! rust_layout {
        ($kind:ty, $($field:ident),*) => {
            (size_of::<$kind>(), vec![$((stringify!($field).to_owned(), offset_of!($kind, $field))),*])
        };
    }

    #[test]
    fn the_shaders_and_this_program_agree_on_every_byte() {
        let mut view = rust_layout!(ViewUniforms, object_to_view, view_to_clip, occlusion, padding);
        // WGSL pads the end by itself.
        view.1.pop();
        assert_eq!(layout("view", "View"), view);
        assert_eq!(layout("table", "Fabric"), rust_layout!(FabricUniforms, symmetry, slices, padding));
        assert_eq!(layout("print", "Print"), rust_layout!(PrintUniforms, across, down, picture));
    }
}
