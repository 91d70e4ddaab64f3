//! The studio's own panes: plugins like any other. A pane is one file here and one line below.

mod activity;
mod export;
mod fabrics;
mod history;
mod inspector;
mod look;
mod notes;
mod panels;

use studio_plugin::Registry;

/// Registers them, in the order of their tabs.
pub(super) fn register(registry: &mut Registry) {
    registry.register(panels::Panels::default());
    registry.register(fabrics::Fabrics::default());
    registry.register(inspector::Inspector::default());
    registry.register(look::Look);
    registry.register(export::Export::default());
    registry.register(history::History);
    registry.register(notes::Notes::default());
    registry.register(activity::Activity);
}
