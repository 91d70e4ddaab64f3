//! Names that are typed: of a panel, in its row; of a group, in a question.

use eframe::egui::{self, Key, Modifiers};

use crate::studio::texts::{CANCEL, panels as texts};
use crate::studio::theme::STEP;

/// A name that is being typed.
#[derive(Debug, Default)]
pub(super) struct Name {
    text: String,
    has_begun: bool,
}

impl Name {
    pub(super) fn new(text: &str) -> Self {
        Self { text: text.to_owned(), has_begun: false }
    }

    /// The field; the name once it is entered, nothing where it was called off.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, hint: &str) -> Option<Option<String>> {
        let field = egui::TextEdit::singleline(&mut self.text).hint_text(hint).desired_width(f32::INFINITY);
        let mut output = field.show(ui);
        let response = &output.response.response;
        if !std::mem::replace(&mut self.has_begun, true) {
            response.request_focus();
            let all = egui::text_selection::CCursorRange::select_all_str(&self.text);
            output.state.cursor.set_char_range(Some(all));
            output.state.store(ui.ctx(), response.id);
            return None;
        }
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            return Some(None);
        }
        response.lost_focus().then(|| Some(self.text.trim().to_owned()))
    }
}

/// Asks what a group is to be called.
pub(super) fn ask_group(context: &egui::Context, name: &mut Name) -> Option<Option<String>> {
    let mut answer = None;
    let modal = egui::Modal::new(egui::Id::unique("group-panels")).show(context, |ui| {
        ui.set_width(90.0 * STEP);
        ui.heading(texts::GROUP);
        let typed = name.show(ui, texts::GROUP_NAME);
        ui.add_space(2.0 * STEP);
        ui.horizontal(|ui| {
            let is_named = !name.text.trim().is_empty();
            let clicked = ui.add_enabled(is_named, egui::Button::new(texts::GROUP_ANSWER)).clicked();
            let entered = typed.is_some() && ui.input(|input| input.key_pressed(Key::Enter));
            if is_named && (clicked || entered) {
                answer = Some(Some(name.text.trim().to_owned()));
            }
            if typed == Some(None) || ui.button(CANCEL).clicked() {
                answer = Some(None);
            }
        });
    });
    if modal.should_close() { answer.or(Some(None)) } else { answer }
}
