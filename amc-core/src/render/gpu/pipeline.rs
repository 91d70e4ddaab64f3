//! Pipelines, made when they are first needed and kept.

use std::collections::HashMap;

use super::bindings::Bindings;
use super::device::checked;
use super::mesh::VERTEX_LAYOUTS;
use super::mode::ShadingMode;
use crate::render::{Cyclic, Perspective};
use crate::shader::{Sources, validate};
use crate::view_space::Azimuth;
use crate::{Error, Result};

/// The attachments of the passes that are drawn into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TargetFormat {
    /// Of the colour attachment. Float and sRGB formats get linear light; into 8- and 10-bit formats without sRGB,
    /// the shaders write sRGB-encoded values.
    pub color: wgpu::TextureFormat,
    /// Of the depth attachment: cleared to 1, nearer is less.
    pub depth: wgpu::TextureFormat,
    /// Samples per pixel, 1 or 4.
    pub samples: u32,
}

impl TargetFormat {
    fn is_encoded_by_shader(self) -> bool {
        use wgpu::TextureFormat::{Bgra8Unorm, Rgb10a2Unorm, Rgba8Unorm};
        matches!(self.color, Rgba8Unorm | Bgra8Unorm | Rgb10a2Unorm)
    }
}

/// What tells pipelines apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    pub(super) mode: ShadingMode,
    pub(super) cyclic: Cyclic,
    pub(super) perspective: Perspective,
    pub(super) azimuth: Azimuth,
    /// What mode `MARK` writes.
    pub(super) mark: u8,
    pub(super) target: TargetFormat,
}

impl PipelineKey {
    /// The `override` constants of the shaders. They are fixed here and no branch on them is left in the pipeline.
    fn constants(&self) -> [(&'static str, f64); 5] {
        let cyclic = match self.cyclic {
            Cyclic::Naive => 0.0,
            Cyclic::Cyclic => 1.0,
            Cyclic::Fragment => 2.0,
        };
        let perspective = match self.perspective {
            Perspective::Off => 0.0,
            Perspective::Paper => 1.0,
            Perspective::Full => 2.0,
            Perspective::Half => 3.0,
        };
        let azimuth = match self.azimuth {
            Azimuth::Transported => 0.0,
            Azimuth::Projected => 1.0,
        };
        [
            ("cyclic_mode", cyclic),
            ("perspective_mode", perspective),
            ("azimuth_definition", azimuth),
            ("mark", f64::from(self.mark)),
            ("encode_output", if self.target.is_encoded_by_shader() { 1.0 } else { 0.0 }),
        ]
    }
}

/// A compiled shader and the `override` constants it has.
#[derive(Debug)]
struct Module {
    module: wgpu::ShaderModule,
    overrides: Vec<String>,
}

/// The shaders and pipelines made so far.
#[derive(Debug)]
pub(super) struct Pipelines {
    sources: Sources,
    modules: HashMap<ShadingMode, Module>,
    pipelines: HashMap<PipelineKey, wgpu::RenderPipeline>,
}

impl Pipelines {
    pub(super) fn new(sources: Sources) -> Self {
        Self { sources, modules: HashMap::new(), pipelines: HashMap::new() }
    }

    /// The pipeline of `key`, made now if it is not there yet.
    ///
    /// # Errors
    /// The shader is faulty (with file and line), the target impossible, or the device refuses.
    pub(super) fn get(
        &mut self,
        device: &wgpu::Device,
        bindings: &Bindings,
        key: PipelineKey,
    ) -> Result<wgpu::RenderPipeline> {
        if let Some(pipeline) = self.pipelines.get(&key) {
            return Ok(pipeline.clone());
        }
        if !matches!(key.target.samples, 1 | 4) {
            return Err(Error::invalid(format!(
                "{} samples per pixel; 1 or 4 are possible",
                key.target.samples
            )));
        }
        let module = match self.modules.entry(key.mode) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(place) => {
                place.insert(compile(device, &self.sources, key.mode)?)
            }
        };
        let what = format!("the pipeline of {}", key.mode.shader);
        let pipeline = checked(device, &what, || create(device, bindings, module, &key))?;
        self.pipelines.insert(key, pipeline.clone());
        Ok(pipeline)
    }
}

fn compile(device: &wgpu::Device, sources: &Sources, mode: ShadingMode) -> Result<Module> {
    let name = mode.shader;
    let checked_shader = match mode.text {
        Some(text) => validate(&sources.with(name, text)?, name)?,
        None => validate(sources, name)?,
    };
    let text = checked_shader.composition().text().to_owned();
    let module = checked(device, &format!("the shader {name}"), || {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })
    })?;
    Ok(Module { module, overrides: checked_shader.overrides().map(str::to_owned).collect() })
}

fn create(
    device: &wgpu::Device,
    bindings: &Bindings,
    module: &Module,
    key: &PipelineKey,
) -> wgpu::RenderPipeline {
    let mut constants = key.constants().to_vec();
    constants.retain(|(name, _)| module.overrides.iter().any(|known| known == name));
    let compilation_options =
        wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let color =
        wgpu::ColorTargetState { format: key.target.color, blend: None, write_mask: wgpu::ColorWrites::ALL };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(key.mode.shader),
        layout: Some(&bindings.pipeline_layout(device, key.mode)),
        vertex: wgpu::VertexState {
            module: &module.module,
            entry_point: Some("vertex_main"),
            compilation_options: compilation_options.clone(),
            buffers: &VERTEX_LAYOUTS,
        },
        // Cloth is two-sided: nothing is culled.
        primitive: wgpu::PrimitiveState { front_face: wgpu::FrontFace::Ccw, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: key.target.depth,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: key.target.samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module.module,
            entry_point: Some("fragment_main"),
            compilation_options,
            targets: &[Some(color)],
        }),
        multiview_mask: None,
        cache: None,
    })
}
