//! What the person is asked before the work goes on.

use std::path::{Path, PathBuf};

use eframe::egui;

use super::texts::{self, files as words};
use super::theme::{STEP, Tokens};
use crate::project::{Missing, Recoverable};

/// An answer to what is asked at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OfRecovery {
    /// Take it back.
    Recover(usize),
    /// Throw it away.
    Discard(usize),
}

/// Asks about what dead sessions left.
pub(super) fn recovery(ui: &egui::Ui, works: &[Recoverable]) -> Option<OfRecovery> {
    let mut answer = None;
    if works.is_empty() {
        return None;
    }
    egui::Modal::new(egui::Id::unique("recovery")).show(ui, |ui| {
        ui.set_max_width(120.0 * STEP);
        ui.heading(texts::RECOVER_TITLE);
        ui.label(texts::RECOVER_TEXT);
        for (index, work) in works.iter().enumerate() {
            ui.add_space(2.0 * STEP);
            let name = work.belongs_to.as_deref().map_or(texts::UNNAMED.to_owned(), shown);
            ui.strong(name);
            if work.is_older {
                ui.weak(words::SAVED_AFTER);
            }
            ui.horizontal(|ui| {
                if ui.button(texts::RECOVER).clicked() {
                    answer = Some(OfRecovery::Recover(index));
                }
                if ui.button(texts::DISCARD).clicked() {
                    answer = Some(OfRecovery::Discard(index));
                }
            });
        }
    });
    answer
}

/// An answer to what is asked about missing files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum OfMissing {
    /// A dialog is to ask where this one is.
    Find(PathBuf),
    /// They stay missing.
    Without,
}

/// Asks about files that are not there.
pub(super) fn missing(ui: &egui::Ui, files: &[Missing]) -> Option<OfMissing> {
    let mut answer = None;
    if files.is_empty() {
        return None;
    }
    let modal = egui::Modal::new(egui::Id::unique("missing")).show(ui, |ui| {
        ui.set_max_width(140.0 * STEP);
        ui.heading(texts::MISSING_TITLE);
        ui.label(texts::MISSING_TEXT);
        for file in files {
            ui.add_space(2.0 * STEP);
            let Some(path) = file.asset.path() else { continue };
            ui.horizontal(|ui| {
                if ui.button(texts::FIND).on_hover_text(words::where_is(shown(path))).clicked() {
                    answer = Some(OfMissing::Find(path.to_owned()));
                }
                ui.label(shown(path));
            });
            for place in &file.looked_for {
                ui.label(egui::RichText::new(words::not_at(shown(place))).color(Tokens::of(ui).text_weak));
            }
        }
        ui.add_space(2.0 * STEP);
        if ui.button(texts::WITHOUT).clicked() {
            answer = Some(OfMissing::Without);
        }
    });
    if modal.should_close() { Some(OfMissing::Without) } else { answer }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// Asks whether a garment is to be opened that has not all panels for which something was chosen.
pub(super) fn other_garment(ui: &egui::Ui, name: &str, lost: &[String]) -> Option<bool> {
    let mut answer = None;
    let modal = egui::Modal::new(egui::Id::unique("other-garment")).show(ui, |ui| {
        ui.set_max_width(140.0 * STEP);
        ui.heading(words::other_garment(name));
        ui.label(words::HAS_NO_PANEL_FOR);
        ui.add_space(STEP);
        egui::ScrollArea::vertical().max_height(60.0 * STEP).show(ui, |ui| {
            lost.iter().for_each(|lost| drop(ui.label(lost)));
        });
        ui.add_space(STEP);
        ui.label(words::COMES_BACK);
        ui.add_space(2.0 * STEP);
        ui.horizontal(|ui| {
            if ui.button(words::OPEN_ANYWAY).clicked() {
                answer = Some(true);
            }
            if ui.button(texts::CANCEL).clicked() {
                answer = Some(false);
            }
        });
    });
    if modal.should_close() { answer.or(Some(false)) } else { answer }
}
