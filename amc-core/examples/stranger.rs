//! A wgpu program with a render pass of its own draws a mesh in an Anisotropic MatCap.

use amc_core::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use amc_core::render::gpu::{Backend, Gpu, Renderer, TargetFormat};
use amc_core::render::{Cloth, Draw, Drawing, Projection, Shading, Vertex, View};
use amc_core::view_space::Azimuth;
use glam::{Mat4, Vec2, Vec3};

fn main() -> amc_core::Result<()> {
    // Any wgpu device and queue will do; this one needs no window.
    let Gpu { device, queue } = Gpu::headless(Backend::Auto)?;

    // A table, here of eight slices from red to green, and a mesh with tangents, here one triangle.
    let slice = |s: u8| vec![[255 - 32 * s, 32 * s, 64, 255]; 16 * 16];
    let (size, texels) = (TableSize::new(16, 8)?, Texels::Srgb8((0..8).flat_map(slice).collect()));
    let amc = Amc::new(size, texels, Symmetry::Two, Azimuth::Transported, Frame::Half)?;
    let corner = |x, y| Vertex { position: Vec3::new(x, y, 0.0), normal: Vec3::Z, ..Vertex::default() };
    let drawing = Drawing {
        vertices: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)].into(),
        tangents: vec![Vec3::X; 3].into(),
        triangles: vec![[0, 1, 2]].into(),
        draws: vec![Draw { triangles: 0..1, cloth: Cloth::Fabric(0) }],
        fabrics: vec![amc.into()],
    };
    let (projection, shift) = (Projection::Perspective { fov_y: 1.0 }, Vec2::ZERO);
    let object_to_view = Mat4::from_translation(Vec3::new(0.0, 0.0, -3.0));
    let view = View { object_to_view, projection, width: 256, height: 256, near: 0.1, far: 10.0, shift };
    let shading = Shading { occlusion: false, ..Shading::default() };

    // Once per device, once per mesh, once per frame; for the attachments that the pass has.
    let (color, depth) = (wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureFormat::Depth32Float);
    let mut renderer = Renderer::new(&device, &queue);
    let mut scene = renderer.prepare(&drawing)?;
    let (eye, target) = (renderer.eye(), TargetFormat { color, depth, samples: 1 });
    let frame = renderer.draw_data(&mut scene, &eye, &view, &shading, target)?;

    let size = wgpu::Extent3d { width: 256, height: 256, depth_or_array_layers: 1 };
    let (dimension, usage) = (wgpu::TextureDimension::D2, wgpu::TextureUsages::RENDER_ATTACHMENT);
    let (label, mip_level_count, sample_count, view_formats) = (None, 1, 1, &[][..]);
    let [color, depth] = [color, depth].map(|format| {
        #[rustfmt::skip]
        let texture = wgpu::TextureDescriptor {
            label, size, mip_level_count, sample_count, dimension, format, usage, view_formats,
        };
        device.create_texture(&texture).create_view(&wgpu::TextureViewDescriptor::default())
    });
    let ops = wgpu::Operations::default();
    let color =
        wgpu::RenderPassColorAttachment { view: &color, depth_slice: None, resolve_target: None, ops };
    let depth_ops = Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store });
    let depth = wgpu::RenderPassDepthStencilAttachment { view: &depth, depth_ops, stencil_ops: None };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let (color_attachments, depth_stencil_attachment) = (&[Some(color)][..], Some(depth));
    let pass =
        wgpu::RenderPassDescriptor { color_attachments, depth_stencil_attachment, ..Default::default() };
    frame.draw(&mut encoder.begin_render_pass(&pass));
    queue.submit([encoder.finish()]);
    Ok(())
}
