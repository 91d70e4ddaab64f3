//! The studio's own panes: plugins like any other. A pane is one file here and one line below; a plugin of `plugins/` is one line.

mod activity;
mod colourways;
mod export;
mod fabrics;
mod history;
mod inspector;
mod look;
mod notes;
mod panels;
mod print;

use amc_core::mesh::{Garment, Panel};
use studio_plugin::{Context, Registry};

/// Registers them, in the order of their tabs.
pub(super) fn register(registry: &mut Registry) {
    registry.register(panels::Panels::default());
    registry.register(fabrics::Fabrics::default());
    registry.register(colourways::Colourways::default());
    registry.register(inspector::Inspector::default());
    #[cfg(feature = "editor")]
    registry.register(tangent_editor::TangentEditor::default());
    registry.register(print::Prints::default());
    registry.register(look::Look);
    registry.register(export::Export::default());
    registry.register(notes::Notes::default());
    registry.register(history::History);
    registry.register(activity::Activity);
}

/// The selected panels; where none is, all that take a fabric.
fn picked<'a>(garment: &'a Garment, studio: &Context<'_>) -> Vec<&'a Panel> {
    let selected = &studio.selection.panels;
    let picked = |panel: &&Panel| {
        if selected.is_empty() { panel.takes_fabric } else { selected.contains(&panel.id) }
    };
    garment.panels.iter().filter(picked).collect()
}
