//! A path to be typed, where the system has no dialogs.

use std::path::{Path, PathBuf};

use eframe::egui;

use super::files::{Purpose, with_suffix};
use super::texts;
use super::theme::STEP;

/// How wide the field is, points.
const WIDTH: f32 = 480.0;

/// A field for one path.
#[derive(Debug)]
pub(super) struct PathField {
    text: String,
    /// What is at the path, as it was when the text was changed last.
    found: Found,
    /// It was not shown yet.
    is_new: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Found {
    Nothing,
    File,
    Folder,
}

impl PathField {
    /// Beginning in the folder of `file`, else in the current one; for a new project with `name`.
    pub(super) fn new(purpose: &Purpose, name: &str, file: Option<&Path>) -> Self {
        let current = || std::env::current_dir().unwrap_or_default();
        let folder = |path: &Path| path.parent().map(Path::to_owned).unwrap_or_default();
        let start = match (purpose, file) {
            (Purpose::Save, Some(file)) => file.to_owned(),
            (Purpose::Save, None) => current().join(name),
            (Purpose::Where(_, ask), file) => file.map_or_else(current, folder).join(&ask.name),
            (Purpose::Find(missing), _) => missing.clone(),
            // Joined with nothing, a folder ends in what separates it from a name.
            (Purpose::Open | Purpose::Which(..), file) => file.map_or_else(current, folder).join(""),
        };
        let text = start.to_string_lossy().into_owned();
        Self { found: Found::at(&text, purpose), text, is_new: true }
    }

    /// Shows it; a path where one was chosen, nothing where it was called off.
    pub(super) fn show(&mut self, ui: &egui::Ui, purpose: &Purpose) -> Option<Option<PathBuf>> {
        let (mut chosen, mut called_off) = (false, false);
        let modal = egui::Modal::new(egui::Id::unique("path")).show(ui, |ui| {
            ui.set_width(WIDTH);
            let (title, text) = words(purpose);
            ui.heading(title);
            let label = ui.label(text);
            ui.add_space(STEP);
            let field = egui::TextEdit::singleline(&mut self.text).desired_width(f32::INFINITY);
            let output = field.hint_text(texts::PATH).show(ui);
            let response = output.response.response.labelled_by(label.id);
            if std::mem::take(&mut self.is_new) {
                response.request_focus();
            }
            if response.changed() {
                self.found = Found::at(&self.text, purpose);
            }
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
            ui.add_space(2.0 * STEP);
            ui.horizontal(|ui| {
                let button = egui::Button::new(self.verb(purpose));
                let clicked = ui.add_enabled(self.can_be_chosen(purpose), button).clicked();
                chosen = clicked || entered && self.can_be_chosen(purpose);
                called_off = ui.button(texts::CANCEL).clicked();
            });
        });
        if chosen {
            return Some(Some(path(&self.text, purpose)));
        }
        (called_off || modal.should_close()).then_some(None)
    }

    fn verb(&self, purpose: &Purpose) -> &'static str {
        match (purpose, self.found) {
            (Purpose::Open, _) => texts::OPEN,
            (Purpose::Find(_) | Purpose::Which(..), _) => texts::USE,
            (Purpose::Save | Purpose::Where(..), Found::File) => texts::REPLACE,
            (Purpose::Save | Purpose::Where(..), _) => texts::SAVE,
        }
    }

    fn can_be_chosen(&self, purpose: &Purpose) -> bool {
        match purpose {
            Purpose::Open | Purpose::Find(_) | Purpose::Which(..) => self.found == Found::File,
            Purpose::Save | Purpose::Where(..) => self.found != Found::Folder && !self.text.trim().is_empty(),
        }
    }
}

impl Found {
    fn at(text: &str, purpose: &Purpose) -> Self {
        let path = path(text, purpose);
        if path.is_dir() {
            Self::Folder
        } else if path.exists() {
            Self::File
        } else {
            Self::Nothing
        }
    }
}

/// The path that is meant, with the suffix it needs.
fn path(text: &str, purpose: &Purpose) -> PathBuf {
    with_suffix(PathBuf::from(text.trim()), purpose)
}

fn words(purpose: &Purpose) -> (&str, String) {
    match purpose {
        Purpose::Open => (texts::OPEN_TITLE, texts::OPEN_TEXT.to_owned()),
        Purpose::Save => (texts::SAVE_TITLE, texts::SAVE_TEXT.to_owned()),
        Purpose::Where(_, ask) | Purpose::Which(_, ask) => {
            let kinds = ask.kinds.iter().flat_map(|kind| kind.suffixes).map(|suffix| format!(".{suffix}"));
            (&ask.title, texts::files::ends_in(&kinds.collect::<Vec<_>>().join(", ")))
        }
        Purpose::Find(missing) => (texts::FIND_TITLE, missing.display().to_string()),
    }
}
