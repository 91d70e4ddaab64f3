//! What comes from outside the window, and what is asked before the work goes on.

use amc_core::mesh::Unit;
use eframe::egui::{self, ViewportCommand};
use studio_plugin::document::{Asset, Edit};

use super::App;
use crate::studio::files::{self, Dialog, Purpose};
use crate::studio::other_garment::{self, OtherGarment};
use crate::studio::questions::{self, OfMissing, OfRecovery};
use crate::studio::texts;
use crate::studio::theme::{STEP, Tokens};

impl App {
    pub(super) fn ask(&mut self, purpose: Purpose) {
        if self.dialog.is_none() {
            let name = files::suggested_name(self.desk.document.project());
            let file = self.desk.file.as_deref();
            self.dialog = Some(Dialog::open(purpose, (&name, file), self.has_dialogs, &mut self.jobs));
        }
    }

    /// Does what a dialog was for.
    pub(super) fn answered(&mut self, ui: &egui::Ui) {
        let Some(dialog) = &mut self.dialog else { return };
        let Some(answer) = dialog.poll(ui) else { return };
        let purpose = dialog.purpose.clone();
        self.dialog = None;
        match (answer, purpose) {
            (Ok(Some(path)), Purpose::Open) => self.open(&path),
            (Ok(Some(path)), Purpose::Save) => self.save_to(&path),
            (Ok(Some(path)), Purpose::Find(old)) => self.desk.locate(&old, &path, &mut self.notices),
            (Ok(Some(path)), Purpose::Where(plugin, ask) | Purpose::Which(plugin, ask)) => {
                self.with_context(|registry, studio| {
                    if let Some(plugin) = registry.get_mut(plugin) {
                        plugin.call(studio, |plugin, studio| plugin.chosen(ask.id, &path, studio));
                    }
                })
            }
            (Ok(None), _) => {}
            (Err(error), _) => self.notices.failed(error),
        }
    }

    /// Takes in files that were dropped, and says while some are held over the window that they can be.
    pub(super) fn drops(&mut self, ui: &egui::Ui) {
        let (dropped, held) =
            ui.input(|input| (input.raw.dropped_files.clone(), !input.raw.hovered_files.is_empty()));
        for file in dropped {
            self.open(file.path());
        }
        if held {
            let painter =
                ui.layer_painter(egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop")));
            let tokens = Tokens::of(ui);
            let rect = ui.content_rect().shrink(4.0 * STEP);
            painter.rect(
                rect,
                2.0 * STEP,
                tokens.surface.gamma_multiply(0.9),
                egui::Stroke::new(2.0, tokens.accent),
                egui::StrokeKind::Inside,
            );
            painter.text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                texts::DROP_HERE,
                egui::TextStyle::Heading.resolve(ui.style()),
                tokens.text,
            );
        }
    }

    /// Opens another garment: at once where nothing was chosen for panels that it may not have.
    pub(super) fn open_garment(&mut self, asset: Asset) {
        let project = self.desk.document.project();
        match other_garment::has_choices(project) {
            true => self.other_garment = Some(OtherGarment::new(asset, project, &mut self.jobs)),
            false => self.set_garment(asset),
        }
    }

    fn set_garment(&mut self, asset: Asset) {
        if let Err(error) = self.desk.document.submit(Edit::SetGarment(asset), None) {
            self.notices.failed(error);
        }
    }

    /// Takes in a garment that was read; where it has all panels that matter, there is nothing to ask.
    pub(super) fn read_garment(&mut self) {
        let Some(other) = &mut self.other_garment else { return };
        match other.poll(self.desk.document.project(), self.stager.stage.garment.as_deref()) {
            Ok(true) if other.lost.is_empty() => self.take_garment(),
            Ok(_) => {}
            Err(error) => {
                self.other_garment = None;
                self.notices.failed(error);
            }
        }
    }

    fn take_garment(&mut self) {
        let Some(OtherGarment { asset, garment, .. }) = self.other_garment.take() else { return };
        if let Some(garment) = garment {
            self.stager.offer(asset.clone(), Unit::Metre, garment);
        }
        self.set_garment(asset);
    }

    /// Asks what must be answered before the work goes on.
    pub(super) fn question(&mut self, ui: &egui::Ui) {
        // One at a time: what is taken back would take the place of what is not saved yet.
        let offered = if self.desk.document.is_changed() { &[] } else { self.desk.recoverable.as_slice() };
        match questions::recovery(ui, offered) {
            Some(OfRecovery::Recover(index)) => self.desk.recover(index, &mut self.jobs),
            Some(OfRecovery::Discard(index)) => self.desk.discard(index, &mut self.notices),
            None => {}
        }
        let other = self.other_garment.as_ref().filter(|other| !other.lost.is_empty());
        match other.and_then(|other| questions::other_garment(ui, &other.asset.name(), &other.lost)) {
            Some(true) => self.take_garment(),
            Some(false) => self.other_garment = None,
            None => {}
        }
        match questions::missing(ui, &self.desk.missing) {
            Some(OfMissing::Find(path)) => self.ask(Purpose::Find(path)),
            Some(OfMissing::Without) => self.desk.missing.clear(),
            None => {}
        }
    }

    /// Holds the window open while there are changes that nobody has said what to do with.
    pub(super) fn leave(&mut self, ui: &egui::Ui) {
        if ui.input(|input| input.viewport().close_requested())
            && self.desk.document.is_changed()
            && !self.discard
        {
            ui.send_viewport_cmd(ViewportCommand::CancelClose);
            self.leaving = true;
        }
        if self.leaving_saved && !self.desk.is_busy() && self.dialog.is_none() {
            // What could not be saved keeps the window open.
            self.leaving_saved = false;
            if !self.desk.document.is_changed() {
                ui.send_viewport_cmd(ViewportCommand::Close);
            }
        }
        if !self.leaving {
            return;
        }
        let mut save = false;
        let modal = egui::Modal::new(egui::Id::unique("leaving")).show(ui, |ui| {
            ui.heading(texts::UNSAVED_TITLE);
            ui.label(texts::UNSAVED_TEXT);
            ui.add_space(2.0 * STEP);
            ui.horizontal(|ui| {
                save = ui.button(texts::SAVE).clicked();
                self.discard = ui.button(texts::DISCARD).clicked();
                if ui.button(texts::STAY).clicked() {
                    self.leaving = false;
                }
            });
        });
        if modal.should_close() {
            self.leaving = false;
        }
        if save {
            self.save();
            self.leaving = false;
            self.leaving_saved = true;
        }
        if self.discard {
            ui.send_viewport_cmd(ViewportCommand::Close);
        }
    }
}
