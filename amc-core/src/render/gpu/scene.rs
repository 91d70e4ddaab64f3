//! The renderer, a drawing on the GPU, and one frame of it.

use std::ops::Range;
use std::sync::Arc;

use super::ball::BallTexture;
use super::bindings::{Bindings, bind_group};
use super::fabric::FabricTexture;
use super::mesh::MeshBuffers;
use super::mode::{LooksUp, MARK, ShadingMode};
use super::pipeline::{PipelineKey, Pipelines, TargetFormat};
use super::print::Prints;
use super::uniforms::{ViewUniforms, buffer};
use crate::amc::Amc;
use crate::image::Picture;
use crate::render::{Cyclic, Draw, Drawing, Mode, Perspective, Projection, Shading, View};
use crate::shader::Sources;
use crate::view_space::Azimuth;
use crate::{Error, Result};

/// What lives as long as the device: shaders, pipelines, layouts.
#[derive(Debug)]
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    bindings: Bindings,
    pipelines: Pipelines,
    /// The MatCap picture used last.
    matcap: Option<(Arc<Picture>, BallTexture)>,
}

/// From where one frame is seen: its uniform buffer. Pictures of different views that are drawn in one submission
/// need one each.
#[derive(Debug, Clone)]
pub struct Eye {
    uniforms: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
}

/// A drawing on the GPU, kept between frames.
#[derive(Debug)]
pub struct Scene {
    mesh: MeshBuffers,
    /// As the drawing has them.
    panels: Vec<Draw>,
    /// Those of the panels that are shown, merged.
    draws: Vec<Draw>,
    fabrics: Vec<SceneFabric>,
    prints: Prints,
}

/// A fabric of a scene.
#[derive(Debug, Clone)]
struct SceneFabric {
    amc: Arc<Amc>,
    texture: FabricTexture,
    /// The mean over its slices, made when it is first asked for.
    mean: Option<BallTexture>,
}

/// One frame: a scene from one view in one shading, ready for passes of one target format. It holds handles only.
#[derive(Debug, Clone)]
pub struct SceneDrawData {
    mesh: MeshBuffers,
    eye: wgpu::BindGroup,
    draws: Vec<ReadyDraw>,
}

#[derive(Debug, Clone)]
struct ReadyDraw {
    pipeline: wgpu::RenderPipeline,
    looked_up: Option<wgpu::BindGroup>,
    print: Option<wgpu::BindGroup>,
    corners: Range<u32>,
}

impl Renderer {
    /// A renderer with the embedded shaders. Pipelines are made when they are first needed.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        Self::with_shaders(device, queue, Sources::embedded())
    }

    /// A renderer with the shaders of `sources`.
    pub fn with_shaders(device: &wgpu::Device, queue: &wgpu::Queue, sources: Sources) -> Self {
        Self {
            device: device.clone(),
            queue: queue.clone(),
            bindings: Bindings::new(device),
            pipelines: Pipelines::new(sources),
            matcap: None,
        }
    }

    /// Uploads a drawing.
    ///
    /// # Errors
    /// Indices that point outside of it, or more than the device holds.
    pub fn prepare(&self, drawing: &Drawing) -> Result<Scene> {
        check(drawing)?;
        let fabrics = drawing.fabrics.iter().map(|amc| self.fabric(amc)).collect::<Result<_>>()?;
        Ok(Scene {
            mesh: MeshBuffers::new(&self.device, &self.queue, drawing)?,
            panels: drawing.draws.clone(),
            draws: merged(drawing.draws.iter()),
            fabrics,
            prints: self.prints(drawing, &Prints::default())?,
        })
    }

    /// Uploads a drawing beside `scene`, which stays: what both hold is shared.
    ///
    /// # Errors
    /// As [`Renderer::prepare`].
    pub fn prepare_beside(&self, scene: &Scene, drawing: &Drawing) -> Result<Scene> {
        if !scene.mesh.has_shape_of(drawing) {
            return self.prepare(drawing);
        }
        let mesh = scene.mesh.with_own_tangents(&self.device, &self.queue)?;
        let (fabrics, prints) = (scene.fabrics.clone(), scene.prints.clone());
        let mut beside = Scene { mesh, panels: Vec::new(), draws: Vec::new(), fabrics, prints };
        self.update(&mut beside, drawing)?;
        Ok(beside)
    }

    /// Makes `scene` one of `drawing`; of what it shares with the drawing before nothing is uploaded again, and of
    /// changed tangents only those that differ. All panels are shown. Gives the number of bytes uploaded for the mesh.
    ///
    /// # Errors
    /// As [`Renderer::prepare`]; the scene is then as it was.
    pub fn update(&self, scene: &mut Scene, drawing: &Drawing) -> Result<u64> {
        let has_its_shape = scene.mesh.has_shape_of(drawing);
        if has_its_shape {
            drawing.check_tangents()?;
            drawing.check_draws()?;
        } else {
            check(drawing)?;
        }
        let known = |amc: &Arc<Amc>| scene.fabrics.iter().find(|it| Arc::ptr_eq(&it.amc, amc)).cloned();
        let fabric = |amc| known(amc).map_or_else(|| self.fabric(amc), Ok);
        let fabrics = drawing.fabrics.iter().map(fabric).collect::<Result<_>>()?;
        let prints = self.prints(drawing, &scene.prints)?;
        let bytes = if has_its_shape {
            scene.mesh.set_tangents(&self.queue, &drawing.tangents)
        } else {
            scene.mesh = MeshBuffers::new(&self.device, &self.queue, drawing)?;
            scene.mesh.bytes()
        };
        (scene.fabrics, scene.prints) = (fabrics, prints);
        scene.panels.clone_from(&drawing.draws);
        scene.draws = merged(drawing.draws.iter());
        Ok(bytes)
    }

    /// A place for one view.
    pub fn eye(&self) -> Eye {
        let uniforms =
            buffer(&self.device, &self.queue, "view", &<ViewUniforms as bytemuck::Zeroable>::zeroed());
        let resources = [uniforms.as_entire_binding()];
        let bind_group = bind_group(&self.device, "view", &self.bindings.view, &resources);
        Eye { uniforms, bind_group }
    }

    /// One frame of `scene`, for passes of the format `target`. `shading.samples` and `shading.background` are the
    /// pass's business and not looked at. What it needs and is not there yet (pipelines, MatCap textures) is made.
    ///
    /// # Errors
    /// An impossible view, a faulty shader, a MatCap that is too large, or the device refuses.
    pub fn draw_data(
        &mut self,
        scene: &mut Scene,
        eye: &Eye,
        view: &View,
        shading: &Shading,
        target: TargetFormat,
    ) -> Result<SceneDrawData> {
        view.check()?;
        let uniforms = ViewUniforms::new(view, shading);
        self.queue.write_buffer(&eye.uniforms, 0, bytemuck::bytes_of(&uniforms));
        let mut draws = Vec::with_capacity(scene.draws.len());
        for draw in &scene.draws {
            let mode = ShadingMode::of(&shading.mode, &draw.cloth);
            let fabric = draw.cloth.fabric().and_then(|index| scene.fabrics.get_mut(index));
            let print = draw.cloth.print().filter(|_| mode.is_printed);
            let azimuth = fabric.as_ref().map_or(Azimuth::default(), |fabric| fabric.texture.azimuth());
            let key = key(mode, azimuth, view, shading, target);
            draws.push(ReadyDraw {
                pipeline: self.pipelines.get(&self.device, &self.bindings, key)?,
                looked_up: self.looked_up(mode, shading, fabric)?,
                print: print.and_then(|laid| scene.prints.bind_group(laid)),
                corners: corners(draw),
            });
        }
        Ok(SceneDrawData { mesh: scene.mesh.clone(), eye: eye.bind_group.clone(), draws })
    }

    /// The panels (draws of the drawing) that `mark_of` gives a mark or a 0, as seen from where `eye` was set by the last
    /// [`Renderer::draw_data`]: into the red of an `Rgba8Unorm` target go mark/255, for an overlay or to tell panels apart.
    /// Those it gives none are left out.
    ///
    /// # Errors
    /// A faulty shader, or the device refuses.
    pub fn mark_data(
        &mut self,
        scene: &Scene,
        eye: &Eye,
        mark_of: impl Fn(usize) -> Option<u8>,
        target: TargetFormat,
    ) -> Result<SceneDrawData> {
        let mut draws = Vec::new();
        for (panel, draw) in scene.panels.iter().enumerate().filter(|(_, draw)| !draw.triangles.is_empty()) {
            let Some(mark) = mark_of(panel) else { continue };
            let key = PipelineKey {
                mode: MARK,
                cyclic: Cyclic::default(),
                perspective: Perspective::Off,
                azimuth: Azimuth::default(),
                mark,
                target,
            };
            let pipeline = self.pipelines.get(&self.device, &self.bindings, key)?;
            draws.push(ReadyDraw { pipeline, looked_up: None, print: None, corners: corners(draw) });
        }
        Ok(SceneDrawData { mesh: scene.mesh.clone(), eye: eye.bind_group.clone(), draws })
    }

    fn fabric(&self, amc: &Arc<Amc>) -> Result<SceneFabric> {
        let texture = FabricTexture::new(&self.device, &self.queue, &self.bindings, amc)?;
        Ok(SceneFabric { amc: Arc::clone(amc), texture, mean: None })
    }

    fn prints(&self, drawing: &Drawing, known: &Prints) -> Result<Prints> {
        Prints::new(&self.device, &self.queue, &self.bindings, &drawing.draws, known)
    }

    fn looked_up(
        &mut self,
        mode: ShadingMode,
        shading: &Shading,
        fabric: Option<&mut SceneFabric>,
    ) -> Result<Option<wgpu::BindGroup>> {
        Ok(match (mode.looks_up, fabric, &shading.mode) {
            (LooksUp::Table, Some(fabric), _) => Some(fabric.texture.bind_group().clone()),
            (LooksUp::Ball, _, Mode::MatCap(ball)) => Some(self.matcap(ball)?),
            (LooksUp::Ball, Some(fabric), _) => Some(self.mean(fabric)?),
            _ => None,
        })
    }

    fn matcap(&mut self, ball: &Arc<Picture>) -> Result<wgpu::BindGroup> {
        if let Some((known, texture)) = &self.matcap
            && Arc::ptr_eq(known, ball)
        {
            return Ok(texture.bind_group.clone());
        }
        let texture = BallTexture::new(&self.device, &self.queue, &self.bindings, ball)?;
        let bind_group = texture.bind_group.clone();
        self.matcap = Some((Arc::clone(ball), texture));
        Ok(bind_group)
    }

    fn mean(&self, fabric: &mut SceneFabric) -> Result<wgpu::BindGroup> {
        if let Some(mean) = &fabric.mean {
            return Ok(mean.bind_group.clone());
        }
        let ball = fabric.amc.isotropic();
        let texture = BallTexture::new(&self.device, &self.queue, &self.bindings, &ball)?;
        Ok(fabric.mean.insert(texture).bind_group.clone())
    }
}

impl Scene {
    /// From now on only the panels (draws of the drawing) are drawn that `is_shown` says yes to.
    pub fn show_only(&mut self, is_shown: impl Fn(usize) -> bool) {
        self.draws = merged(
            self.panels.iter().enumerate().filter(|(panel, _)| is_shown(*panel)).map(|(_, draw)| draw),
        );
    }

    /// The texture of fabric `index` of the drawing, to replace slices of it. The isotropic mean, once shown, stays
    /// that of the AMC the scene was prepared with.
    pub fn fabric(&self, index: usize) -> Option<&FabricTexture> {
        self.fabrics.get(index).map(|fabric| &fabric.texture)
    }
}

impl SceneDrawData {
    /// Draws into a pass whose attachments have the format this was made for.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if self.draws.is_empty() {
            return;
        }
        pass.set_bind_group(0, &self.eye, &[]);
        pass.set_vertex_buffer(0, self.mesh.vertices.slice(..));
        pass.set_vertex_buffer(1, self.mesh.tangents.slice(..));
        pass.set_index_buffer(self.mesh.corners.slice(..), wgpu::IndexFormat::Uint32);
        for draw in &self.draws {
            pass.set_pipeline(&draw.pipeline);
            if let Some(looked_up) = &draw.looked_up {
                pass.set_bind_group(1, looked_up, &[]);
            }
            if let Some(print) = &draw.print {
                pass.set_bind_group(2, print, &[]);
            }
            pass.draw_indexed(draw.corners.clone(), 0, 0..1);
        }
    }
}

/// Whether a drawing can be drawn here.
fn check(drawing: &Drawing) -> Result<()> {
    drawing.check()?;
    // Corners are counted in 32 bits.
    if drawing.triangles.len() > (u32::MAX / 3) as usize {
        return Err(Error::too_large(format!("{} triangles", drawing.triangles.len())));
    }
    Ok(())
}

/// The key of the pipeline that draws `mode`. Settings that the mode or the view does not look at are left at their
/// defaults, so that they make no pipelines of their own. Orthographic views have no perspective turn.
fn key(
    mode: ShadingMode,
    azimuth: Azimuth,
    view: &View,
    shading: &Shading,
    target: TargetFormat,
) -> PipelineKey {
    let looks_up = mode.looks_up;
    let turned = looks_up != LooksUp::Nothing && matches!(view.projection, Projection::Perspective { .. });
    let table = looks_up == LooksUp::Table;
    PipelineKey {
        mode,
        cyclic: if table { shading.cyclic } else { Cyclic::default() },
        perspective: if turned { shading.perspective } else { Perspective::Off },
        azimuth: if table { azimuth } else { Azimuth::default() },
        mark: 0,
        target,
    }
}

/// The indices of a draw's corners.
fn corners(draw: &Draw) -> Range<u32> {
    draw.triangles.start * 3..draw.triangles.end * 3
}

/// Draws without the empty ones, neighbours of the same cloth as one.
fn merged<'a>(draws: impl Iterator<Item = &'a Draw>) -> Vec<Draw> {
    let mut merged: Vec<Draw> = Vec::new();
    for draw in draws.filter(|draw| !draw.triangles.is_empty()) {
        match merged.last_mut() {
            Some(last) if last.cloth == draw.cloth && last.triangles.end == draw.triangles.start => {
                last.triangles.end = draw.triangles.end;
            }
            _ => merged.push(draw.clone()),
        }
    }
    merged
}
