//! Bind group layouts and samplers: what the shaders see at which number.

use super::mode::{LooksUp, ShadingMode};

/// The layouts of group 0 (the view), group 1 (what a mode looks up) and group 2 (a print), and the samplers.
#[derive(Debug, Clone)]
pub(super) struct Bindings {
    pub(super) view: wgpu::BindGroupLayout,
    pub(super) table: wgpu::BindGroupLayout,
    pub(super) ball: wgpu::BindGroupLayout,
    pub(super) print: wgpu::BindGroupLayout,
    pub(super) table_sampler: wgpu::Sampler,
    pub(super) ball_sampler: wgpu::Sampler,
    pub(super) print_sampler: wgpu::Sampler,
}

impl Bindings {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        use wgpu::AddressMode::{ClampToEdge, Repeat};
        use wgpu::TextureViewDimension::{D2, D3};
        let sampled = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let layout = |label, kinds: &[wgpu::BindingType]| {
            let entries: Vec<_> = (0..)
                .zip(kinds)
                .map(|(binding, &ty)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                    ty,
                    count: None,
                })
                .collect();
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries };
            device.create_bind_group_layout(&descriptor)
        };
        Self {
            view: layout("view", &[uniform()]),
            table: layout("table", &[uniform(), texture(D3), sampled]),
            ball: layout("ball", &[texture(D2), sampled]),
            print: layout("print", &[uniform(), texture(D2), sampled]),
            table_sampler: sampler(device, ClampToEdge, Repeat),
            ball_sampler: sampler(device, ClampToEdge, ClampToEdge),
            print_sampler: sampler(device, Repeat, ClampToEdge),
        }
    }

    /// The layouts of a pipeline of a mode.
    pub(super) fn pipeline_layout(&self, device: &wgpu::Device, mode: ShadingMode) -> wgpu::PipelineLayout {
        let looked_up = match mode.looks_up {
            LooksUp::Nothing => None,
            LooksUp::Table => Some(&self.table),
            LooksUp::Ball => Some(&self.ball),
        };
        let layouts = [Some(&self.view), looked_up, mode.is_printed.then_some(&self.print)];
        let used = layouts.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shading"),
            bind_group_layouts: &layouts[..used],
            immediate_size: 0,
        })
    }
}

/// A bind group of `layout` with these resources at the bindings 0, 1, ...
pub(super) fn bind_group(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

fn uniform() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn texture(view_dimension: wgpu::TextureViewDimension) -> wgpu::BindingType {
    let sample_type = wgpu::TextureSampleType::Float { filterable: true };
    wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false }
}

/// Linear within a level; what is beyond the texture in u and v, and in w.
fn sampler(
    device: &wgpu::Device,
    beyond: wgpu::AddressMode,
    address_mode_w: wgpu::AddressMode,
) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("look-up"),
        address_mode_u: beyond,
        address_mode_v: beyond,
        address_mode_w,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    })
}
