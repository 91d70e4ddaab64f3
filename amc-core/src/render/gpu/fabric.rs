//! Fabrics as 3D textures.

use super::bindings::{Bindings, bind_group};
use super::device::checked;
use super::uniforms::{FabricUniforms, buffer};
use crate::amc::{Amc, TableSize, Texels};
use crate::view_space::Azimuth;
use crate::{Error, Result};

/// The table of one fabric on the GPU. It is uploaded slice by slice, so that one slice can be replaced while drawing.
#[derive(Debug, Clone)]
pub struct FabricTexture {
    texture: wgpu::Texture,
    size: TableSize,
    texel_bytes: usize,
    azimuth: Azimuth,
    bind_group: wgpu::BindGroup,
}

impl FabricTexture {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bindings: &Bindings,
        amc: &Amc,
    ) -> Result<Self> {
        let (size, limit) = (amc.size(), device.limits().max_texture_dimension_3d);
        if size.side().max(size.slices()) > limit {
            return Err(Error::too_large(format!(
                "a table of {0} x {0} x {1}; 3D textures of this graphics device hold {limit} along each axis",
                size.side(),
                size.slices()
            )));
        }
        let (texture, bind_group) =
            checked(device, "the fabric's texture", || create(device, queue, bindings, amc))?;
        let texel_bytes = amc.texels().texel_bytes();
        let made = Self { texture, size, texel_bytes, azimuth: amc.azimuth, bind_group };
        for s in 0..size.slices() {
            made.write_slice(queue, s, amc.slice_bytes(s))?;
        }
        Ok(made)
    }

    /// Replaces slice `s` by texels in the table's own format, rows upwards ([`Amc::slice_bytes`]). Draws submitted
    /// later see it; the other slices are left alone.
    ///
    /// # Errors
    /// There is no slice `s`, or the number of bytes is not that of a slice.
    pub fn write_slice(&self, queue: &wgpu::Queue, s: u32, bytes: &[u8]) -> Result<()> {
        let (side, slices) = (self.size.side(), self.size.slices());
        if s >= slices {
            return Err(Error::invalid(format!("slice {s} of a table with {slices} slices")));
        }
        let expected = self.size.slice_texels() * self.texel_bytes;
        if bytes.len() != expected {
            return Err(Error::malformed(format!(
                "{} bytes given for a slice of {expected} bytes",
                bytes.len()
            )));
        }
        let to = wgpu::TexelCopyTextureInfo {
            texture: &self.texture,
            mip_level: 0,
            origin: wgpu::Origin3d { x: 0, y: 0, z: s },
            aspect: wgpu::TextureAspect::All,
        };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(side * self.texel_bytes as u32),
            rows_per_image: Some(side),
        };
        let extent = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 };
        queue.write_texture(to, bytes, layout, extent);
        Ok(())
    }

    pub(super) fn bind_group(&self) -> &wgpu::BindGroup {
        &self.bind_group
    }

    pub(super) fn azimuth(&self) -> Azimuth {
        self.azimuth
    }
}

fn create(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    bindings: &Bindings,
    amc: &Amc,
) -> (wgpu::Texture, wgpu::BindGroup) {
    let size = amc.size();
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("fabric"),
        size: wgpu::Extent3d {
            width: size.side(),
            height: size.side(),
            depth_or_array_layers: size.slices(),
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format: match amc.texels() {
            Texels::Srgb8(_) => wgpu::TextureFormat::Rgba8UnormSrgb,
            Texels::Half(_) => wgpu::TextureFormat::Rgba16Float,
        },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let uniforms = buffer(device, queue, "fabric", &FabricUniforms::new(amc));
    let resources = [
        uniforms.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&bindings.table_sampler),
    ];
    let group = bind_group(device, "fabric", &bindings.table, &resources);
    (texture, group)
}
