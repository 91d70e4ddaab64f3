//! The document: a garment, the fabrics in use, what each panel is made of (in each of the colourways) and how
//! it is cut, the view, notes.
//!
//! A [`Project`] is plain data. A [`Document`] is a project with its history: it changes only through [`Edit`]s, which
//! are checked first, so that every change can be undone and no project is ever half right.

mod asset;
mod colourways;
mod comparison;
mod edit;
mod edit_name;
mod history;
mod panel_groups;
mod panel_print;
mod project;
#[cfg(test)]
mod tests;
mod view;

pub use asset::{Asset, FabricId, FabricInUse};
pub use colourways::{Colourway, ColourwayId, ColourwayLabel, Colourways, PanelWear};
pub use comparison::Comparison;
pub use edit::Edit;
pub use history::{Document, Gesture, Snapshot};
pub use panel_print::PanelPrint;
pub use project::{PanelChoice, PanelLook, Project};
pub use view::{Angles, Lens, NamedView, TurningStyle, ViewSettings};
