//! Prints as 2D textures with their smaller copies, and where they are laid.

use std::sync::Arc;

use super::bindings::{Bindings, bind_group};
use super::device::checked;
use super::uniforms::{PrintUniforms, buffer};
use crate::render::{Draw, LaidPrint, Print};
use crate::{Error, Result};

/// The laid prints of a scene, each once.
#[derive(Debug, Clone, Default)]
pub(super) struct Prints(Vec<ScenePrint>);

#[derive(Debug, Clone)]
struct ScenePrint {
    laid: LaidPrint,
    /// Shared by all that are of the same picture.
    view: wgpu::TextureView,
    bind_group: wgpu::BindGroup,
}

impl Prints {
    /// Those of `draws`. Pictures that are in `known` are not uploaded again.
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bindings: &Bindings,
        draws: &[Draw],
        known: &Self,
    ) -> Result<Self> {
        let mut prints = Self::default();
        for laid in draws.iter().filter_map(|draw| draw.cloth.print()) {
            if prints.find(laid).is_some() {
                continue;
            }
            let made = match known.find(laid) {
                Some(same) => same.clone(),
                None => {
                    let same_picture = |it: &&ScenePrint| Arc::ptr_eq(&it.laid.print, &laid.print);
                    let known = prints.0.iter().chain(&known.0).find(same_picture);
                    let view =
                        known.map_or_else(|| upload(device, queue, &laid.print), |it| Ok(it.view.clone()));
                    ScenePrint::new(device, queue, bindings, laid, view?)
                }
            };
            prints.0.push(made);
        }
        Ok(prints)
    }

    /// What the shaders see of `laid` at group 2.
    pub(super) fn bind_group(&self, laid: &LaidPrint) -> Option<wgpu::BindGroup> {
        self.find(laid).map(|print| print.bind_group.clone())
    }

    fn find(&self, laid: &LaidPrint) -> Option<&ScenePrint> {
        self.0.iter().find(|print| print.laid == *laid)
    }
}

impl ScenePrint {
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bindings: &Bindings,
        laid: &LaidPrint,
        view: wgpu::TextureView,
    ) -> Self {
        let uniforms = buffer(device, queue, "print", &PrintUniforms::new(laid));
        let resources = [
            uniforms.as_entire_binding(),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&bindings.print_sampler),
        ];
        let bind_group = bind_group(device, "print", &bindings.print, &resources);
        Self { laid: laid.clone(), view, bind_group }
    }
}

/// A print's picture as a texture.
fn upload(device: &wgpu::Device, queue: &wgpu::Queue, print: &Print) -> Result<wgpu::TextureView> {
    let Some(largest) = print.levels().first() else {
        return Err(Error::invalid("the print's picture has no pixels"));
    };
    let size = wgpu::Extent3d { width: largest.width, height: largest.height, depth_or_array_layers: 1 };
    let texture = checked(device, "the print's texture", || {
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some("print"),
            size,
            mip_level_count: print.levels().len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8UnormSrgb,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    })?;
    for (number, level) in (0..).zip(print.levels()) {
        let to = wgpu::TexelCopyTextureInfo { mip_level: number, ..texture.as_image_copy() };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * level.width),
            rows_per_image: None,
        };
        let size = wgpu::Extent3d { width: level.width, height: level.height, depth_or_array_layers: 1 };
        queue.write_texture(to, level.texels.as_flattened(), layout, size);
    }
    Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
}
