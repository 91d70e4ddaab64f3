//! A drawn picture into egui's pass.

use amc_core::Result;
use amc_core::render::gpu::{Gpu, checked};
use amc_core::shader::{Sources, compose};
use eframe::egui_wgpu::{CallbackResources, CallbackTrait};
use eframe::{egui, wgpu};

/// `Outline` of `viewport.wgsl`: linear colours and, fourth, widths in pixels; 0: none.
pub(super) type OutlineUniforms = [[f32; 4]; 2];

/// What all canvases of a device share: the pipeline that shows a picture.
#[derive(Debug)]
pub(super) struct Blitter {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    /// What is read where nothing is marked.
    no_marks: wgpu::TextureView,
}

/// The picture of one canvas, ready to be shown.
#[derive(Debug, Clone)]
pub(super) struct Blit {
    pipeline: wgpu::RenderPipeline,
    bind_group: wgpu::BindGroup,
    outline: wgpu::Buffer,
}

/// A [`Blit`] at a place of the window.
struct PlacedBlit {
    blit: Blit,
    /// Left, top, width, height, in pixels; it may reach out of the window.
    place: [f32; 4],
}

impl Blitter {
    /// For passes of one sample per pixel without depth, as egui's are by default, of the format `target`: encoded by the
    /// shader unless the format encodes.
    ///
    /// # Errors
    /// The device refuses.
    pub(super) fn new(gpu: &Gpu, target: wgpu::TextureFormat) -> Result<Self> {
        let text = compose(&Sources::embedded(), "viewport")?.text().to_owned();
        checked(&gpu.device, "the viewport's pipeline", || {
            let layout = layout(&gpu.device);
            let pipeline = pipeline(&gpu.device, &layout, text, target);
            Self { pipeline, layout, no_marks: blank(&gpu.device) }
        })
    }

    /// Shows `picture`, and `marks` as outlines.
    pub(super) fn blit(
        &self,
        gpu: &Gpu,
        picture: &wgpu::TextureView,
        marks: Option<&wgpu::TextureView>,
    ) -> Blit {
        let outline = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("outline"),
            size: size_of::<OutlineUniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let marks = marks.unwrap_or(&self.no_marks);
        let entries = [
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(picture) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(marks) },
            wgpu::BindGroupEntry { binding: 2, resource: outline.as_entire_binding() },
        ];
        let label = Some("viewport");
        let descriptor = wgpu::BindGroupDescriptor { label, layout: &self.layout, entries: &entries };
        let bind_group = gpu.device.create_bind_group(&descriptor);
        Blit { pipeline: self.pipeline.clone(), bind_group, outline }
    }
}

impl Blit {
    pub(super) fn set_outline(&self, gpu: &Gpu, outline: OutlineUniforms) {
        let bytes: Vec<u8> = outline.iter().flatten().flat_map(|value| value.to_ne_bytes()).collect();
        gpu.queue.write_buffer(&self.outline, 0, &bytes);
    }

    /// As a shape that covers `rect` (points); in pixels it covers `place`.
    pub(super) fn shape(&self, rect: egui::Rect, place: [f32; 4]) -> egui::epaint::PaintCallback {
        eframe::egui_wgpu::Callback::new_paint_callback(rect, PlacedBlit { blit: self.clone(), place })
    }
}

impl CallbackTrait for PlacedBlit {
    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &CallbackResources,
    ) {
        // egui's own viewport is clamped to the window, which would squeeze a picture that reaches out of it.
        let [left, top, width, height] = self.place;
        pass.set_viewport(left, top, width, height, 0.0, 1.0);
        pass.set_pipeline(&self.blit.pipeline);
        pass.set_bind_group(0, &self.blit.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let entry = |(binding, ty)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let entries: Vec<_> = (0..).zip([texture, texture, uniform]).map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("viewport"),
        entries: &entries,
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    text: String,
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("viewport"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("viewport"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let constants = [("encode_output", if target.is_srgb() { 0.0 } else { 1.0 })];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("viewport"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment_main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            targets: &[Some(target.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// One texel of zeros.
fn blank(device: &wgpu::Device) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("no marks"),
        size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
