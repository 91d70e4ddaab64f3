//! What is drawn: garments on the graphics device, and where their panels are.

use std::sync::Arc;

use amc_core::mesh::Picker;
use amc_core::render::gpu::{Renderer, Scene};
use amc_core::render::{Bounds, Drawing};
use amc_core::{Error, Result};
use glam::Vec3;

/// A drawing, uploaded when it is first drawn.
#[derive(Debug)]
pub(super) struct Garment {
    pub(super) drawing: Arc<Drawing>,
    /// Tells it from those before it.
    pub(super) revision: u64,
    /// What was made of it, or of the drawing before it.
    scene: Option<Scene>,
    upload: Upload,
}

/// Whether the scene is one of the drawing.
#[derive(Debug)]
enum Upload {
    Due,
    Done,
    /// Kept, so that it is not tried again in every frame.
    Failed(Arc<Error>),
}

impl Garment {
    pub(super) fn new(drawing: Arc<Drawing>, revision: u64) -> Self {
        Self { drawing, revision, scene: None, upload: Upload::Due }
    }

    /// Shows another drawing from now on; what they share is kept.
    pub(super) fn replace(&mut self, drawing: Arc<Drawing>, revision: u64) {
        (self.drawing, self.revision, self.upload) = (drawing, revision, Upload::Due);
    }

    /// Its scene; uploaded now where it is not yet, sharing with `other` what it can.
    pub(super) fn scene(
        &mut self,
        renderer: &Renderer,
        other: Option<&Scene>,
    ) -> Result<&mut Scene, Arc<Error>> {
        if let Upload::Due = self.upload {
            self.upload = match self.uploaded_now(renderer, other) {
                Ok(scene) => {
                    self.scene = Some(scene);
                    Upload::Done
                }
                Err(error) => Upload::Failed(Arc::new(error)),
            };
        }
        match (&self.upload, &mut self.scene) {
            (Upload::Failed(error), _) => Err(Arc::clone(error)),
            (_, Some(scene)) => Ok(scene),
            (_, None) => Err(Arc::new(Error::invalid("the garment was not uploaded"))),
        }
    }

    fn uploaded_now(&mut self, renderer: &Renderer, other: Option<&Scene>) -> Result<Scene> {
        match (self.scene.take(), other) {
            (Some(mut scene), _) => renderer.update(&mut scene, &self.drawing).map(|_| scene),
            (None, Some(other)) => renderer.prepare_beside(other, &self.drawing),
            (None, None) => renderer.prepare(&self.drawing),
        }
    }

    /// The scene, where it was drawn before.
    pub(super) fn uploaded(&self) -> Option<&Scene> {
        self.scene.as_ref()
    }

    /// The bounds of some of its panels; none where they hold nothing.
    pub(super) fn bounds_of(&self, panels: impl IntoIterator<Item = usize>) -> Option<Bounds> {
        let Drawing { vertices, triangles, draws, .. } = &*self.drawing;
        let ranges = panels.into_iter().filter_map(|panel| draws.get(panel));
        let corners = ranges
            .filter_map(|draw| triangles.get(draw.triangles.start as usize..draw.triangles.end as usize))
            .flat_map(|triangles| triangles.as_flattened());
        let positions: Vec<Vec3> =
            corners.filter_map(|&corner| Some(vertices.get(corner as usize)?.position)).collect();
        Bounds::of(&positions).ok()
    }
}

/// What the pointer finds, and what views are fitted to.
#[derive(Debug)]
pub(super) struct Shape {
    pub(super) picker: Arc<Picker>,
    /// An error where there is nothing to fit a view to.
    pub(super) bounds: Result<Bounds, Arc<Error>>,
}

impl Shape {
    pub(super) fn new(drawing: &Drawing, picker: Arc<Picker>) -> Self {
        let positions: Vec<Vec3> = drawing.vertices.iter().map(|vertex| vertex.position).collect();
        Self { picker, bounds: Bounds::of(&positions).map_err(Arc::new) }
    }
}
