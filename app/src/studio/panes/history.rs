//! The steps that were done, each to go back to by a click.

use eframe::egui;
use studio_plugin::{Context, Pane, Place, Plugin};

use crate::studio::texts::history as texts;

pub(super) struct History;

impl Plugin for History {
    fn id(&self) -> &'static str {
        "history"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "steps", title: texts::NAME, place: Place::Bottom }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let position = studio.document.position();
        let mut wanted = None;
        if ui.selectable_label(position == 0, texts::BEGINNING).clicked() {
            wanted = Some(0);
        }
        for (index, name) in studio.document.steps().enumerate() {
            let done = index < position;
            let text = egui::RichText::new(name);
            let text = if done { text } else { text.weak() };
            if ui.selectable_label(index + 1 == position, text).clicked() {
                wanted = Some(index + 1);
            }
        }
        if let Some(wanted) = wanted {
            studio.go_to(wanted);
        }
    }
}
