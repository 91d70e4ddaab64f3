//! A scene drawn offscreen, and kept until something about it changes.

use std::collections::BTreeSet;

use amc_core::Result;
use amc_core::render::gpu::{Eye, Gpu, Offscreen, Renderer, Scene, SceneDrawData, TargetFormat};
use amc_core::render::{Shading, View};
use eframe::wgpu;

use super::blit::{Blit, Blitter, OutlineUniforms};

/// Bits of a mark, as `viewport.wgsl` reads them.
const SELECTED: u8 = 1;
const HOVERED: u8 = 2;

/// What marks are drawn into.
const MARKS: TargetFormat = TargetFormat {
    color: wgpu::TextureFormat::Rgba8Unorm,
    depth: wgpu::TextureFormat::Depth32Float,
    samples: 1,
};

/// Which panels are outlined.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Marks {
    pub(super) selected: BTreeSet<usize>,
    pub(super) hovered: Option<usize>,
}

impl Marks {
    fn is_empty(&self) -> bool {
        self.selected.is_empty() && self.hovered.is_none()
    }

    fn of(&self, panel: usize) -> u8 {
        let bit = |is_set: bool, bit: u8| if is_set { bit } else { 0 };
        bit(self.selected.contains(&panel), SELECTED) | bit(self.hovered == Some(panel), HOVERED)
    }
}

/// What a canvas is to show.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wanted {
    pub(super) view: View,
    pub(super) shading: Shading,
    /// Changes whenever the scene does: what it holds, or which of its panels are shown.
    pub(super) revision: u64,
    pub(super) hidden: BTreeSet<usize>,
    pub(super) marks: Marks,
    pub(super) outline: OutlineUniforms,
}

/// Attachments for one size, and what shows them.
#[derive(Debug)]
struct Targets {
    size: [u32; 2],
    picture: Offscreen,
    /// Made when something is marked for the first time.
    marks: Option<Offscreen>,
    blit: Blit,
}

/// A picture of a scene, kept between frames.
#[derive(Debug)]
pub(super) struct Canvas {
    eye: Eye,
    targets: Option<Targets>,
    shown: Option<Wanted>,
}

/// What a canvas draws with.
pub(super) struct Tools<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) renderer: &'a mut Renderer,
    pub(super) blitter: &'a Blitter,
}

impl Canvas {
    pub(super) fn new(renderer: &Renderer) -> Self {
        Self { eye: renderer.eye(), targets: None, shown: None }
    }

    /// The picture of `scene` as it is wanted; drawn only where it is not that already. `drawn` counts the scenes that
    /// were drawn.
    ///
    /// # Errors
    /// The device refuses; the next call tries again.
    pub(super) fn picture(
        &mut self,
        tools: &mut Tools<'_>,
        scene: &mut Scene,
        wanted: &Wanted,
        drawn: &mut u64,
    ) -> Result<Blit> {
        // Only what succeeds is remembered.
        let shown = self.shown.take();
        let (mut targets, shown) = match self.targets.take() {
            Some(targets) if targets.size == wanted.size() => (targets, shown),
            _ => (Targets::new(tools, wanted)?, None),
        };
        let is_scene_shown = shown.as_ref().is_some_and(|shown| shown.has_scene_of(wanted));
        let are_marks_shown =
            is_scene_shown && shown.as_ref().is_some_and(|shown| shown.marks == wanted.marks);
        let is_outline_shown = are_marks_shown && shown.is_some_and(|shown| shown.outline == wanted.outline);
        if !is_scene_shown {
            self.draw_scene(tools, scene, &targets, wanted)?;
            *drawn += 1;
        }
        if !are_marks_shown && !wanted.marks.is_empty() {
            self.draw_marks(tools, scene, &mut targets, wanted)?;
        }
        if !is_outline_shown {
            let none = [[0.0; 4]; 2];
            targets.blit.set_outline(tools.gpu, if wanted.marks.is_empty() { none } else { wanted.outline });
        }
        let blit = targets.blit.clone();
        (self.targets, self.shown) = (Some(targets), Some(wanted.clone()));
        Ok(blit)
    }

    fn draw_scene(
        &self,
        tools: &mut Tools<'_>,
        scene: &mut Scene,
        targets: &Targets,
        wanted: &Wanted,
    ) -> Result<()> {
        scene.show_only(|panel| !wanted.hidden.contains(&panel));
        let Wanted { view, shading, .. } = wanted;
        let frame = tools.renderer.draw_data(scene, &self.eye, view, shading, targets.picture.target())?;
        submit(tools.gpu, &targets.picture, &frame, shading.background);
        Ok(())
    }

    fn draw_marks(
        &self,
        tools: &mut Tools<'_>,
        scene: &Scene,
        targets: &mut Targets,
        wanted: &Wanted,
    ) -> Result<()> {
        let marks = match targets.marks.take() {
            Some(marks) => marks,
            None => {
                let marks =
                    Offscreen::of_format(&tools.gpu.device, wanted.view.width, wanted.view.height, MARKS)?;
                let picture = targets.picture.color();
                targets.blit = tools.blitter.blit(tools.gpu, picture, Some(marks.color()));
                marks
            }
        };
        let mark = |panel| (!wanted.hidden.contains(&panel)).then(|| wanted.marks.of(panel));
        let frame = tools.renderer.mark_data(scene, &self.eye, mark, MARKS)?;
        submit(tools.gpu, &marks, &frame, None);
        targets.marks = Some(marks);
        Ok(())
    }
}

impl Wanted {
    fn size(&self) -> [u32; 2] {
        [self.view.width, self.view.height]
    }

    /// Whether the picture but for marks is the same.
    fn has_scene_of(&self, other: &Self) -> bool {
        self.revision == other.revision
            && self.view == other.view
            && self.shading == other.shading
            && self.hidden == other.hidden
    }
}

impl Targets {
    fn new(tools: &Tools<'_>, wanted: &Wanted) -> Result<Self> {
        let size @ [width, height] = wanted.size();
        let picture = Offscreen::new(&tools.gpu.device, width, height, wanted.shading.samples)?;
        let blit = tools.blitter.blit(tools.gpu, picture.color(), None);
        Ok(Self { size, picture, marks: None, blit })
    }
}

/// Draws in a submission of its own, before egui's.
fn submit(gpu: &Gpu, target: &Offscreen, frame: &SceneDrawData, background: Option<[f32; 3]>) {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    target.draw(&mut encoder, frame, background);
    gpu.queue.submit([encoder.finish()]);
}
