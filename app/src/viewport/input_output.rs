//! What the viewport is told in a frame, and what it says.

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::Error;
use amc_core::render::{Shading, View};
use eframe::egui;

/// What the viewport is told in every frame. Panels are numbers of the drawing's draws.
#[derive(Debug, Clone)]
pub struct ViewportInput<'a> {
    /// Panels with an outline.
    pub selected: &'a BTreeSet<usize>,
    /// A panel that is pointed at elsewhere, such as in a list; it gets an outline too.
    pub hovered: Option<usize>,
    /// Panels that are not there. To isolate some, hide all others.
    pub hidden: &'a BTreeSet<usize>,
    /// How the garment is shaded.
    pub shading: Shading,
    /// The other look of a split view, right of its divider: this shading, of the drawing given to
    /// [`super::Viewport::set_compared`] or else of the same one. None: the view is not split.
    pub compared: Option<Shading>,
    /// Whether the left button belongs to a tool: then it neither turns nor selects.
    pub tool: bool,
    /// Behind the garment, where the view has no background of its own.
    pub backdrop: egui::Color32,
    /// The outline of selected panels.
    pub selected_color: egui::Color32,
    /// The outline of the hovered panel.
    pub hovered_color: egui::Color32,
}

/// A click.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Click {
    /// What was clicked; none: nothing.
    pub panel: Option<usize>,
    /// Whether it is to be added to the selection, or taken away from it.
    pub add: bool,
}

/// A box that was drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Boxed {
    /// The panels that are seen in it.
    pub panels: BTreeSet<usize>,
    /// Whether they are to be added to the selection.
    pub add: bool,
}

/// What happened in a frame.
#[derive(Debug, Clone)]
pub struct ViewportOutput {
    /// The canvas, for menus, tooltips and tools.
    pub response: egui::Response,
    /// The panel under the pointer.
    pub hovered: Option<usize>,
    /// A click of the left button.
    pub clicked: Option<Click>,
    /// A box was drawn.
    pub boxed: Option<Boxed>,
    /// Whether the view settings changed.
    pub changed: bool,
    /// The view that is drawn, in pixels of the canvas; none where nothing can be seen.
    pub view: Option<View>,
    /// Why nothing is drawn; it stands in the viewport too.
    pub error: Option<Arc<Error>>,
}
