//! Bind group layouts and samplers: what the shaders see at which number.

use super::mode::LooksUp;

/// The layouts of group 0 (the view) and group 1 (what a mode looks up), and the samplers.
#[derive(Debug, Clone)]
pub(super) struct Bindings {
    pub(super) view: wgpu::BindGroupLayout,
    pub(super) table: wgpu::BindGroupLayout,
    pub(super) ball: wgpu::BindGroupLayout,
    pub(super) table_sampler: wgpu::Sampler,
    pub(super) ball_sampler: wgpu::Sampler,
}

impl Bindings {
    pub(super) fn new(device: &wgpu::Device) -> Self {
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
            table_sampler: sampler(device, wgpu::AddressMode::Repeat),
            ball_sampler: sampler(device, wgpu::AddressMode::ClampToEdge),
        }
    }

    /// The layouts of a pipeline of a mode that looks up `what`.
    pub(super) fn pipeline_layout(&self, device: &wgpu::Device, what: LooksUp) -> wgpu::PipelineLayout {
        let layouts: &[_] = match what {
            LooksUp::Nothing => &[Some(&self.view)],
            LooksUp::Table => &[Some(&self.view), Some(&self.table)],
            LooksUp::Ball => &[Some(&self.view), Some(&self.ball)],
        };
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shading"),
            bind_group_layouts: layouts,
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

/// Linear, clamped in u and v.
fn sampler(device: &wgpu::Device, address_mode_w: wgpu::AddressMode) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("look-up"),
        address_mode_w,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    })
}
