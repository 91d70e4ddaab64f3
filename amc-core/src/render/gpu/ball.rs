//! Ordinary MatCaps as 2D textures: a picture of a ball, or the mean over an AMC's slices.

use half::f16;

use super::bindings::{Bindings, bind_group};
use super::device::checked;
use crate::color::{LINEAR_FROM_SRGB8, srgb8_from_linear};
use crate::image::Picture;
use crate::{Error, Result};

/// A picture of a ball on the GPU.
#[derive(Debug, Clone)]
pub(super) struct BallTexture {
    pub(super) bind_group: wgpu::BindGroup,
}

impl BallTexture {
    /// In 8 bits where that loses nothing, else in half floats.
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bindings: &Bindings,
        ball: &Picture,
    ) -> Result<Self> {
        let limit = device.limits().max_texture_dimension_2d;
        if ball.width().max(ball.height()) > limit || ball.pixels().is_empty() {
            return Err(Error::too_large(format!(
                "a MatCap picture of {} x {}; this graphics device holds 1 to {limit} along each axis",
                ball.width(),
                ball.height()
            )));
        }
        let bind_group = checked(device, "the MatCap's texture", || match eight_bits(ball) {
            Some(texels) => {
                let format = wgpu::TextureFormat::Rgba8UnormSrgb;
                create(device, queue, bindings, ball, format, bytemuck::cast_slice(&texels))
            }
            None => {
                let texels: Vec<[f16; 4]> =
                    ball.pixels().iter().map(|pixel| pixel.map(f16::from_f32)).collect();
                let format = wgpu::TextureFormat::Rgba16Float;
                create(device, queue, bindings, ball, format, bytemuck::cast_slice(&texels))
            }
        })?;
        Ok(Self { bind_group })
    }
}

/// The pixels as sRGB-encoded bytes, where every one of them comes from such bytes. Shading ignores alpha.
fn eight_bits(ball: &Picture) -> Option<Vec<[u8; 4]>> {
    let encode = |value: f32| {
        let byte = srgb8_from_linear(value);
        ((LINEAR_FROM_SRGB8[usize::from(byte)] - value).abs() < 1e-6).then_some(byte)
    };
    ball.pixels().iter().map(|&[r, g, b, _]| Some([encode(r)?, encode(g)?, encode(b)?, 255])).collect()
}

fn create(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    bindings: &Bindings,
    ball: &Picture,
    format: wgpu::TextureFormat,
    bytes: &[u8],
) -> wgpu::BindGroup {
    let size = wgpu::Extent3d { width: ball.width(), height: ball.height(), depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("ball"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some((bytes.len() / ball.height() as usize) as u32),
        rows_per_image: None,
    };
    queue.write_texture(texture.as_image_copy(), bytes, layout, size);
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let resources =
        [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&bindings.ball_sampler)];
    bind_group(device, "ball", &bindings.ball, &resources)
}
