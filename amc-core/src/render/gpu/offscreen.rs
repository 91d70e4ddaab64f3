//! Pictures without a window.

use std::time::Duration;

use half::f16;

use super::device::{Gpu, checked};
use super::pipeline::TargetFormat;
use super::scene::{Renderer, SceneDrawData};
use crate::image::Picture;
use crate::render::{Drawing, Shading, View};
use crate::{Error, Result};

/// How long a picture may take before the device counts as hung.
const PATIENCE: Duration = Duration::from_secs(120);

/// Attachments that pictures are drawn into and read back from; kept for pictures of the same size.
#[derive(Debug)]
pub struct Offscreen {
    width: u32,
    height: u32,
    target: TargetFormat,
    /// What is drawn into, where it has several samples.
    multisampled: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
    resolved: wgpu::Texture,
    resolved_view: wgpu::TextureView,
}

impl Offscreen {
    /// Half-float attachments of `width` x `height` pixels with 1 or 4 samples each.
    ///
    /// # Errors
    /// No pixel, more pixels than the device draws, or another number of samples.
    pub fn new(device: &wgpu::Device, width: u32, height: u32, samples: u32) -> Result<Self> {
        let color = wgpu::TextureFormat::Rgba16Float;
        let depth = wgpu::TextureFormat::Depth32Float;
        Self::of_format(device, width, height, TargetFormat { color, depth, samples })
    }

    /// As [`Offscreen::new`], with attachments of any format.
    ///
    /// # Errors
    /// As [`Offscreen::new`], or the device does not draw into such attachments.
    pub fn of_format(device: &wgpu::Device, width: u32, height: u32, target: TargetFormat) -> Result<Self> {
        let limit = device.limits().max_texture_dimension_2d;
        if width == 0 || height == 0 {
            return Err(Error::invalid(format!("a picture of {width} x {height} has no pixels")));
        }
        if width.max(height) > limit {
            return Err(Error::too_large(format!(
                "a picture of {width} x {height}; this graphics device draws at most {limit} along each side"
            )));
        }
        if !matches!(target.samples, 1 | 4) {
            return Err(Error::invalid(format!("{} samples per pixel; 1 or 4 are possible", target.samples)));
        }
        checked(device, "the picture", || Self::create(device, width, height, target))
    }

    fn create(device: &wgpu::Device, width: u32, height: u32, target: TargetFormat) -> Self {
        let texture = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let TargetFormat { color, depth, samples } = target;
        let none = wgpu::TextureUsages::empty();
        let resolved = texture(
            "picture",
            color,
            1,
            wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING,
        );
        Self {
            width,
            height,
            target,
            multisampled: (samples > 1).then(|| view(&texture("samples", color, samples, none))),
            depth: view(&texture("depth", depth, samples, none)),
            resolved_view: view(&resolved),
            resolved,
        }
    }

    /// The picture that was drawn last, one sample per pixel, for shaders to read.
    pub fn color(&self) -> &wgpu::TextureView {
        &self.resolved_view
    }

    /// The format of its attachments.
    pub fn target(&self) -> TargetFormat {
        self.target
    }

    /// Draws a frame over `background` (linear; none: transparent).
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &SceneDrawData,
        background: Option<[f32; 3]>,
    ) {
        let clear = background.map_or(wgpu::Color::TRANSPARENT, |[r, g, b]| wgpu::Color {
            r: r.into(),
            g: g.into(),
            b: b.into(),
            a: 1.0,
        });
        let (view, resolve_target, store) = match &self.multisampled {
            Some(samples) => (samples, Some(&self.resolved_view), wgpu::StoreOp::Discard),
            None => (&self.resolved_view, None, wgpu::StoreOp::Store),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        frame.draw(&mut pass);
    }

    /// Draws a frame into half-float attachments and reads it back.
    ///
    /// # Errors
    /// The attachments are not half floats ([`Offscreen::new`]), or the device fails.
    pub fn picture(&self, gpu: &Gpu, frame: &SceneDrawData, background: Option<[f32; 3]>) -> Result<Picture> {
        if self.target.color != wgpu::TextureFormat::Rgba16Float {
            return Err(Error::unsupported(format!("a picture out of {:?}", self.target.color)));
        }
        let bytes = self.bytes(gpu, frame, background)?;
        let pixels = bytes.chunks_exact(8).map(|texel| straight(bytemuck::pod_read_unaligned(texel)));
        Picture::new(self.width, self.height, pixels.collect())
    }

    /// Draws a frame and reads its texels back, row by row from the top.
    ///
    /// # Errors
    /// The device fails.
    pub fn bytes(&self, gpu: &Gpu, frame: &SceneDrawData, background: Option<[f32; 3]>) -> Result<Vec<u8>> {
        let texel_bytes = self.target.color.block_copy_size(None).unwrap_or(0);
        let row_bytes = self.width * texel_bytes;
        // Rows of a buffer are aligned to 256 bytes.
        let aligned_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = checked(&gpu.device, "the picture", || {
            let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("picture"),
                size: u64::from(aligned_row_bytes) * u64::from(self.height),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.draw(&mut encoder, frame, background);
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(aligned_row_bytes),
                rows_per_image: None,
            };
            let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
            encoder.copy_texture_to_buffer(self.resolved.as_image_copy(), to, self.resolved.size());
            gpu.queue.submit([encoder.finish()]);
            buffer
        })?;
        let aligned = read(gpu, &buffer)?;
        let mut bytes = Vec::with_capacity(row_bytes as usize * self.height as usize);
        for row in aligned.chunks_exact(aligned_row_bytes as usize) {
            bytes.extend_from_slice(&row[..row_bytes as usize]);
        }
        Ok(bytes)
    }
}

/// The content of a buffer, once the device is done with it.
fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<wgpu::BufferView> {
    let failed =
        |error: &dyn std::fmt::Display| Error::device(format!("the picture cannot be read: {error}"));
    let (send, receive) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
        // The receiver is gone only where the wait below has failed already.
        let _ = send.send(mapped);
    });
    gpu.device
        .poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) })
        .map_err(|error| failed(&error))?;
    // Where several threads wait for one device, another may be the one that calls back, a moment later.
    receive.recv_timeout(PATIENCE).map_err(|error| failed(&error))?.map_err(|error| failed(&error))?;
    buffer.get_mapped_range(..).map_err(|error| failed(&error))
}

/// Straight alpha from premultiplied.
fn straight(premultiplied: [f16; 4]) -> [f32; 4] {
    let [r, g, b, a] = premultiplied.map(f16::to_f32);
    if a > 0.0 { [r / a, g / a, b / a, a] } else { [0.0; 4] }
}

/// One picture of a drawing.
///
/// # Errors
/// A drawing whose indices point outside of it, a size or number of samples that is impossible, or the device fails.
pub fn render_picture(gpu: &Gpu, drawing: &Drawing, view: &View, shading: &Shading) -> Result<Picture> {
    view.check()?;
    let offscreen = Offscreen::new(&gpu.device, view.width, view.height, shading.samples)?;
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(drawing)?;
    let eye = renderer.eye();
    let frame = renderer.draw_data(&mut scene, &eye, view, shading, offscreen.target())?;
    offscreen.picture(gpu, &frame, shading.background)
}
