//! Whatever the person writes down about the project.

use eframe::egui;
use studio_plugin::document::{Edit, Gesture, Project};
use studio_plugin::{Context, Pane, Place, Plugin};

use crate::studio::texts::notes as texts;

/// What is written while the field has the focus is one step of the undo.
#[derive(Debug, Default)]
pub(super) struct Notes {
    writing: Option<Gesture>,
}

impl Plugin for Notes {
    fn id(&self) -> &'static str {
        "notes"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "text", title: texts::NAME, place: Place::Bottom }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let mut text = studio.document.project().notes.clone();
        let field = egui::TextEdit::multiline(&mut text)
            .hint_text(texts::HINT)
            .char_limit(Project::LONGEST_NOTES / 4)
            .desired_width(f32::INFINITY)
            .desired_rows(4);
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::MultilineTextInput, true, texts::FIELD));
        if field.changed() {
            let gesture = *self.writing.get_or_insert_with(Gesture::begin);
            studio.submit_in(gesture, Edit::SetNotes(text));
        }
        if !field.has_focus() {
            self.writing = None;
        }
    }
}
