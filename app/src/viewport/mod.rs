//! The viewport: a garment that turns under the mouse.
//!
//! [`Viewport`] draws into textures of its own, only when something about the picture changed, and shows them in egui's
//! pass. Gestures change the [`ViewSettings`] they are given; what else they ask for is in the [`ViewportOutput`].

mod blit;
mod canvas;
mod gestures;
mod input_output;
mod paint;
mod pixels;
mod scenes;
mod split;
mod texts;
pub mod turning;

pub use input_output::{Boxed, Click, ViewportInput, ViewportOutput};
pub use texts::GESTURES;

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::Error;
use amc_core::mesh::Picker;
use amc_core::render::gpu::{FabricTexture, Gpu, Renderer};
use amc_core::render::{Drawing, Shading, View};
use eframe::{egui, egui_wgpu, wgpu};
use studio_plugin::document::ViewSettings;

use self::blit::Blitter;
use self::canvas::{Canvas, Marks, Tools, Wanted};
use self::gestures::{Asked, Gestures};
use self::paint::{describe, linear, outline, paint_rubber_band, say};
use self::pixels::Pixels;
use self::scenes::{Garment, Shape};
use self::split::Split;

/// A garment in a part of the window.
#[derive(Debug)]
pub struct Viewport {
    gpu: Gpu,
    target_format: wgpu::TextureFormat,
    renderer: Renderer,
    /// Made when it is first needed.
    blitter: Option<Blitter>,
    garment: Option<Garment>,
    shape: Option<Shape>,
    compared: Option<Garment>,
    canvases: [Canvas; 2],
    gestures: Gestures,
    split: Split,
    revision: u64,
    scenes_drawn: u64,
}

impl Viewport {
    /// On egui's device. Its pass must have one sample per pixel and no depth (egui's default).
    pub fn new(render_state: &egui_wgpu::RenderState) -> Self {
        let gpu = Gpu { device: render_state.device.clone(), queue: render_state.queue.clone() };
        let renderer = Renderer::new(&gpu.device, &gpu.queue);
        Self {
            canvases: [Canvas::new(&renderer), Canvas::new(&renderer)],
            target_format: render_state.target_format,
            blitter: None,
            garment: None,
            shape: None,
            compared: None,
            gestures: Gestures::default(),
            split: Split::default(),
            revision: 0,
            scenes_drawn: 0,
            renderer,
            gpu,
        }
    }

    /// Shows `drawing` from now on; `picker` is made of the same panels, and may be an older one if only fabrics changed.
    /// What is shown already costs nothing.
    pub fn set_scene(&mut self, drawing: Arc<Drawing>, picker: Arc<Picker>) {
        let shows = |garment: &Garment| Arc::ptr_eq(&garment.drawing, &drawing);
        let picks = |shape: &Shape| Arc::ptr_eq(&shape.picker, &picker);
        if self.garment.as_ref().is_some_and(shows) && self.shape.as_ref().is_some_and(picks) {
            return;
        }
        let is_as_large = |garment: &Garment| Arc::ptr_eq(&garment.drawing.vertices, &drawing.vertices);
        let revision = self.next_revision();
        match &mut self.shape {
            Some(shape) if picks(shape) && self.garment.as_ref().is_some_and(is_as_large) => {}
            shape => *shape = Some(Shape::new(&drawing, picker)),
        }
        match &mut self.garment {
            Some(garment) => garment.replace(drawing, revision),
            none => *none = Some(Garment::new(drawing, revision)),
        }
    }

    /// Shows nothing from now on.
    pub fn clear_scene(&mut self) {
        (self.shape, self.garment, self.compared) = (None, None, None);
    }

    /// What a split view shows right of its divider: other fabrics or directions of the same garment. None: the same.
    pub fn set_compared(&mut self, drawing: Option<Arc<Drawing>>) {
        let shown = self.compared.as_ref().map(|garment| Arc::as_ptr(&garment.drawing));
        if shown == drawing.as_ref().map(Arc::as_ptr) {
            return;
        }
        let revision = self.next_revision();
        match (&mut self.compared, drawing) {
            (Some(garment), Some(drawing)) => garment.replace(drawing, revision),
            (compared, drawing) => *compared = drawing.map(|drawing| Garment::new(drawing, revision)),
        }
    }

    /// The texture of fabric `index` of the drawing, once it was drawn, to replace slices of it; then [`Viewport::redraw`].
    pub fn fabric(&self, index: usize) -> Option<&FabricTexture> {
        self.garment.as_ref()?.uploaded()?.fabric(index)
    }

    /// Draws anew in the next frame, for what cannot be seen from outside: a texture was changed.
    pub fn redraw(&mut self) {
        let revision = self.next_revision();
        for garment in [&mut self.garment, &mut self.compared].into_iter().flatten() {
            garment.revision = revision;
        }
    }

    /// How many times a scene was drawn so far. Frames in which nothing changes draw none.
    pub fn scenes_drawn(&self) -> u64 {
        self.scenes_drawn
    }

    /// Where the divider of a split view stands: 0 at the left, 1 at the right.
    pub fn divider(&self) -> f32 {
        self.split.share()
    }

    /// Moves the divider of a split view.
    pub fn set_divider(&mut self, share: f32) {
        self.split.set_share(share);
    }

    /// Fills what is left of `ui`.
    pub fn show(
        &mut self,
        ui: &mut egui::Ui,
        settings: &mut ViewSettings,
        input: &ViewportInput<'_>,
    ) -> ViewportOutput {
        let (rect, response) =
            ui.allocate_exact_size(ui.available_size_before_wrap(), egui::Sense::click_and_drag());
        describe(ui, &response);
        let mut output = ViewportOutput {
            response,
            hovered: None,
            clicked: None,
            boxed: None,
            changed: false,
            view: None,
            error: None,
        };
        let Some(at) = Pixels::of(rect, ui.pixels_per_point()) else { return output };
        let before = settings.clone();
        let split = input.compared.is_some().then(|| self.split.take(ui, rect)).flatten();
        let asked = self.gestures.take(ui, &output.response, &at, input.tool, settings);
        self.frame(settings, input, &at, asked);
        self.turn_by_itself(ui, settings);
        self.point(ui, settings, input, &at, asked, &mut output);
        output.changed = *settings != before;
        match self.draw(ui, settings, input, &at, &output) {
            Ok(view) => output.view = view,
            Err(error) => {
                say(ui, rect, input.backdrop, &error.to_string());
                output.error = Some(error);
            }
        }
        if let Some(divider) = split {
            divider.paint(ui);
        }
        paint_rubber_band(ui, rect, asked);
        if output.response.has_focus() {
            let stroke = ui.visuals().selection.stroke;
            ui.painter().rect_stroke(rect, 0.0, stroke, egui::StrokeKind::Inside);
        }
        output
    }

    fn next_revision(&mut self) -> u64 {
        self.revision += 1;
        self.revision
    }

    /// The view of these settings; none where there is nothing to see.
    fn view(&self, settings: &ViewSettings, at: &Pixels) -> Option<View> {
        let bounds = self.shape.as_ref()?.bounds.as_ref().ok()?;
        Some(settings.view(*bounds, at.width, at.height))
    }

    fn pick(&self, view: &View, at: &Pixels, point: egui::Pos2, hidden: &BTreeSet<usize>) -> Option<usize> {
        self.shape.as_ref()?.picker.first(view.ray(at.pixel(point)), |panel| hidden.contains(&panel))
    }

    /// Does what a double click or F asks for.
    fn frame(&self, settings: &mut ViewSettings, input: &ViewportInput<'_>, at: &Pixels, asked: Asked) {
        let Some(view) = self.view(settings, at) else { return };
        let panels: BTreeSet<usize> = match asked.frame_at {
            Some(point) => self.pick(&view, at, point, input.hidden).into_iter().collect(),
            None if asked.frame_selection => input.selected.clone(),
            None => return,
        };
        let target = self.garment.as_ref().and_then(|garment| garment.bounds_of(panels));
        match (target, self.shape.as_ref().map(|shape| &shape.bounds)) {
            (Some(target), Some(Ok(bounds))) => {
                turning::frame(settings, *bounds, target, at.width, at.height);
            }
            _ => settings.fit(),
        }
    }

    fn turn_by_itself(&self, ui: &egui::Ui, settings: &mut ViewSettings) {
        let Some(speed) = settings.auto_turn.filter(|speed| *speed != 0.0) else { return };
        if self.garment.is_some() && !self.gestures.is_under_way() {
            turning::spin(settings, f64::from(speed * ui.input(|input| input.stable_dt)));
            ui.request_repaint();
        }
    }

    /// What the pointer is on, and what was clicked or boxed.
    fn point(
        &self,
        ui: &egui::Ui,
        settings: &ViewSettings,
        input: &ViewportInput<'_>,
        at: &Pixels,
        asked: Asked,
        output: &mut ViewportOutput,
    ) {
        let Some(view) = self.view(settings, at) else { return };
        let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
        if !self.gestures.is_under_way() {
            let pointer = output.response.hover_pos();
            output.hovered = pointer.and_then(|point| self.pick(&view, at, point, input.hidden));
        }
        if output.response.clicked() {
            output.response.request_focus();
            if let Some(point) = output.response.interact_pointer_pos().filter(|_| !input.tool) {
                let panel = self.pick(&view, at, point, input.hidden);
                output.clicked = Some(Click { panel, add });
            }
        }
        if let (Some([from, to]), Some(shape)) = (asked.boxed, &self.shape) {
            let hidden = |panel| input.hidden.contains(&panel);
            let panels = shape.picker.in_box(&view, at.pixel(from), at.pixel(to), hidden);
            output.boxed = Some(Boxed { panels, add });
        }
    }

    /// Draws what changed, and shows it. The view; none where no garment is open.
    fn draw(
        &mut self,
        ui: &egui::Ui,
        settings: &ViewSettings,
        input: &ViewportInput<'_>,
        at: &Pixels,
        output: &ViewportOutput,
    ) -> Result<Option<View>, Arc<Error>> {
        let Some(shape) = &self.shape else {
            say(ui, at.rect, input.backdrop, texts::EMPTY);
            return Ok(None);
        };
        let view = settings.view(shape.bounds.clone()?, at.width, at.height);
        let marks = Marks { selected: input.selected.clone(), hovered: output.hovered.or(input.hovered) };
        let wanted = |mut shading: Shading, revision| {
            shading.background.get_or_insert(linear(input.backdrop));
            let (hidden, marks) = (input.hidden.clone(), marks.clone());
            Wanted { view, shading, revision, hidden, marks, outline: outline(ui, input) }
        };
        let blitter = match self.blitter.take() {
            Some(blitter) => blitter,
            None => Blitter::new(&self.gpu, self.target_format)?,
        };
        let blitter = self.blitter.insert(blitter);
        let mut tools = Tools { gpu: &self.gpu, renderer: &mut self.renderer, blitter };
        let shadings = [Some(input.shading.clone()), input.compared.clone()];
        let halves = self.split.halves(at.rect, input.compared.is_some());
        for (side, (canvas, shading)) in self.canvases.iter_mut().zip(shadings).enumerate() {
            let Some(shading) = shading else { continue };
            let (garment, other) = match (&mut self.compared, &mut self.garment) {
                (Some(compared), garment) if side == 1 => {
                    (compared, garment.as_ref().and_then(Garment::uploaded))
                }
                (_, Some(garment)) => (garment, None),
                (_, None) => continue,
            };
            let wanted = wanted(shading, garment.revision);
            let scene = garment.scene(tools.renderer, other)?;
            let blit = canvas.picture(&mut tools, scene, &wanted, &mut self.scenes_drawn)?;
            ui.painter()
                .with_clip_rect(halves[side].intersect(ui.clip_rect()))
                .add(blit.shape(at.rect, at.viewport()));
        }
        Ok(Some(view))
    }
}
