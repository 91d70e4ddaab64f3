//! Draws views of one garment, on the graphics device or with the reference renderer.

use std::collections::BTreeSet;

use amc_core::image::Picture;
#[cfg(feature = "gpu")]
use amc_core::render::gpu::{Backend, Eye, Gpu, Offscreen, Renderer, Scene};
use amc_core::render::{Drawing, Shading, View, cpu};
use amc_core::{Progress, Result};

/// The most pixels drawn at once on a graphics device: some 60 MB of its memory with four samples each.
#[cfg(feature = "gpu")]
const GPU_PIXELS: u32 = 1 << 20;

/// The most pixels drawn at once by the reference renderer: 256 MiB of them.
const CPU_PIXELS: u32 = 1 << 24;

/// What is drawn with.
#[derive(Debug, Clone)]
pub(crate) enum Device {
    #[cfg(feature = "gpu")]
    Gpu(Gpu),
    /// The reference renderer.
    Cpu,
}

/// A garment, ready to be drawn.
#[derive(Debug)]
pub(crate) struct Painter(Means);

#[derive(Debug)]
enum Means {
    #[cfg(feature = "gpu")]
    Gpu(Box<OnGpu>),
    Cpu(Drawing),
}

#[cfg(feature = "gpu")]
#[derive(Debug)]
struct OnGpu {
    gpu: Gpu,
    renderer: Renderer,
    scene: Scene,
    eye: Eye,
    /// Kept for views of the same size: width, height, samples.
    target: Option<([u32; 3], Offscreen)>,
}

impl Device {
    /// A graphics device that needs no window.
    #[cfg(feature = "gpu")]
    pub(crate) fn headless() -> Result<Self> {
        Gpu::headless(Backend::Auto).map(Self::Gpu)
    }

    /// There is none in this program.
    #[cfg(not(feature = "gpu"))]
    pub(crate) fn headless() -> Result<Self> {
        Err(amc_core::Error::device("this program is built without a graphics interface"))
    }

    /// For people.
    pub(crate) fn name(&self) -> String {
        match self {
            #[cfg(feature = "gpu")]
            Self::Gpu(gpu) => gpu.name(),
            Self::Cpu => "cpu".to_owned(),
        }
    }
}

impl Painter {
    /// Of `drawing` without the panels (draws of the drawing) that are hidden.
    pub(crate) fn new(device: Device, mut drawing: Drawing, hidden: &BTreeSet<usize>) -> Result<Self> {
        Ok(Self(match device {
            Device::Cpu => {
                for &panel in hidden {
                    if let Some(draw) = drawing.draws.get_mut(panel) {
                        draw.triangles = 0..0;
                    }
                }
                Means::Cpu(drawing)
            }
            #[cfg(feature = "gpu")]
            Device::Gpu(gpu) => {
                let renderer = Renderer::new(&gpu.device, &gpu.queue);
                let mut scene = renderer.prepare(&drawing)?;
                scene.show_only(|panel| !hidden.contains(&panel));
                let eye = renderer.eye();
                Means::Gpu(Box::new(OnGpu { gpu, renderer, scene, eye, target: None }))
            }
        }))
    }

    /// The most columns that it draws at once where it draws so many rows.
    pub(super) fn columns(&self, rows: u32) -> u32 {
        match &self.0 {
            Means::Cpu(_) => (CPU_PIXELS / rows.max(1)).min(View::SIDE_LIMIT),
            #[cfg(feature = "gpu")]
            Means::Gpu(on) => (GPU_PIXELS / rows.max(1)).min(on.gpu.device.limits().max_texture_dimension_2d),
        }
    }

    /// Draws one view, of no more pixels than it draws at once.
    pub(super) fn draw(
        &mut self,
        view: &View,
        shading: &Shading,
        progress: &Progress<'_>,
    ) -> Result<Picture> {
        match &mut self.0 {
            Means::Cpu(drawing) => cpu::render(drawing, view, shading, progress),
            #[cfg(feature = "gpu")]
            Means::Gpu(on) => on.draw(view, shading),
        }
    }
}

#[cfg(feature = "gpu")]
impl OnGpu {
    fn draw(&mut self, view: &View, shading: &Shading) -> Result<Picture> {
        let size = [view.width, view.height, shading.samples];
        let target = match self.target.take() {
            Some((kept, target)) if kept == size => target,
            _ => Offscreen::new(&self.gpu.device, view.width, view.height, shading.samples)?,
        };
        let frame = self.renderer.draw_data(&mut self.scene, &self.eye, view, shading, target.target())?;
        let picture = target.picture(&self.gpu, &frame, shading.background);
        self.target = Some((size, target));
        picture
    }
}
