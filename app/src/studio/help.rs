//! The user guide, and what the program is made of.

use eframe::egui;
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};

use super::texts;
use super::theme::{STEP, Tokens};

/// A chapter of the guide: its title and its text, CommonMark.
struct Chapter {
    title: &'static str,
    text: &'static str,
}

macro_rules! chapter {
    ($title:literal, $file:literal) => {
        Chapter { title: $title, text: include_str!(concat!("../../../assets/guide/", $file)) }
    };
}

/// The chapters. The guide's folder holds them, to be read without the program too.
const CHAPTERS: [Chapter; 8] = [
    chapter!("First steps", "1-first-steps.md"),
    chapter!("Garments and panels", "2-garments.md"),
    chapter!("Fabrics", "3-fabrics.md"),
    chapter!("Directions", "4-directions.md"),
    chapter!("Looking", "5-looking.md"),
    chapter!("Projects", "6-projects.md"),
    chapter!("Pictures", "7-pictures.md"),
    chapter!("Keys and settings", "8-settings.md"),
];

macro_rules! picture {
    ($file:literal) => {
        (
            concat!("bytes://guide/pictures/", $file),
            include_bytes!(concat!("../../../assets/guide/pictures/", $file)) as &[u8],
        )
    };
}

/// The guide's pictures, by what the chapters call them.
const PICTURES: [(&str, &[u8]); 5] = [
    picture!("window.png"),
    picture!("panel.png"),
    picture!("comb.png"),
    picture!("split.png"),
    picture!("shortcuts.png"),
];

/// Who made what the program is made of, and under which licences: made by the test `licences`.
const LICENCES: &str = include_str!("../../../assets/licences/third-party.txt");

/// How high the list of licences is, points.
const LIST_HEIGHT: f32 = 100.0 * STEP;

/// The windows of the Help menu.
#[derive(Default)]
pub(super) struct Help {
    /// The chapter that is open.
    chapter: Option<usize>,
    /// The lines of the licences, while they are shown.
    licences: Option<Vec<&'static str>>,
    cache: CommonMarkCache,
    are_pictures_known: bool,
}

impl std::fmt::Debug for Help {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Help").field("chapter", &self.chapter).finish_non_exhaustive()
    }
}

impl Help {
    pub(super) fn toggle_guide(&mut self) {
        self.chapter = if self.chapter.is_some() { None } else { Some(0) };
    }

    pub(super) fn toggle_about(&mut self) {
        self.licences = if self.licences.is_some() { None } else { Some(LICENCES.lines().collect()) };
    }

    /// Shows what is open.
    pub(super) fn show(&mut self, ui: &egui::Ui) {
        self.guide(ui);
        self.about(ui);
    }

    fn guide(&mut self, ui: &egui::Ui) {
        let Some(mut open) = self.chapter else { return };
        if !self.are_pictures_known {
            egui_extras::install_image_loaders(ui);
            for (uri, bytes) in PICTURES {
                ui.include_bytes(uri, bytes);
            }
            self.are_pictures_known = true;
        }
        let mut stays = true;
        let size = egui::vec2(190.0 * STEP, 150.0 * STEP);
        egui::Window::new(texts::GUIDE).open(&mut stays).default_size(size).show(ui, |ui| {
            egui::Panel::left("chapters").resizable(false).show(ui, |ui| {
                for (number, chapter) in CHAPTERS.iter().enumerate() {
                    if ui.selectable_label(open == number, chapter.title).clicked() {
                        open = number;
                    }
                }
            });
            egui::CentralPanel::default().show(ui, |ui| {
                // Each chapter begins at its beginning.
                egui::ScrollArea::vertical().id_salt(open).auto_shrink(false).show(ui, |ui| {
                    CommonMarkViewer::new()
                        .default_implicit_uri_scheme("bytes://guide/")
                        .max_image_width(Some(ui.available_width() as usize))
                        .show(ui, &mut self.cache, CHAPTERS[open].text);
                });
            });
        });
        self.chapter = stays.then_some(open);
    }

    fn about(&mut self, ui: &egui::Ui) {
        let Some(lines) = &self.licences else { return };
        let mut closed = false;
        let modal = egui::Modal::new(egui::Id::unique("about")).show(ui, |ui| {
            ui.set_width(150.0 * STEP);
            ui.heading(format!("{} {}", texts::PROGRAM, env!("CARGO_PKG_VERSION")));
            ui.label(texts::ABOUT_TEXT);
            ui.add_space(2.0 * STEP);
            ui.strong(texts::LICENCES);
            let weak = Tokens::of(ui).text_weak;
            let row = ui.text_style_height(&egui::TextStyle::Monospace);
            let list = egui::ScrollArea::both().max_height(LIST_HEIGHT).min_scrolled_height(LIST_HEIGHT);
            list.auto_shrink(false).show_rows(ui, row, lines.len(), |ui, rows| {
                for line in &lines[rows] {
                    let text = egui::RichText::new(*line).monospace().color(weak);
                    ui.add(egui::Label::new(text).extend());
                }
            });
            ui.add_space(2.0 * STEP);
            closed = ui.button(texts::CLOSE).clicked();
        });
        if closed || modal.should_close() {
            self.licences = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_of_the_guide_is_there_and_used() {
        let used: Vec<String> = CHAPTERS
            .iter()
            .flat_map(|chapter| chapter.text.split("](").skip(1))
            .filter_map(|rest| rest.split(')').next())
            .filter(|target| target.ends_with(".png"))
            .map(|target| format!("bytes://guide/{target}"))
            .collect();
        for picture in &used {
            assert!(PICTURES.iter().any(|(uri, _)| uri == picture), "{picture} is not embedded");
        }
        for (uri, _) in PICTURES {
            assert!(used.iter().any(|picture| picture == uri), "{uri} is not used");
        }
    }

    #[test]
    fn chapters_begin_with_their_titles() {
        for Chapter { title, text } in &CHAPTERS {
            assert_eq!(text.lines().next(), Some(format!("# {title}").as_str()));
        }
    }
}
