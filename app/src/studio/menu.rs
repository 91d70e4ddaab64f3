//! The menu bar, and the bar below the window.

use std::path::PathBuf;

use eframe::egui;
use studio_plugin::Command;

use super::commands::{Offered, Wanted};
use super::texts;
use super::theme::Tokens;

/// What the menus show.
pub(super) struct Menu<'a> {
    pub(super) commands: &'a [Offered],
    pub(super) can_run: &'a dyn Fn(Wanted) -> bool,
    /// What undo would take back, and redo do again.
    pub(super) undo: Option<&'a str>,
    pub(super) redo: Option<&'a str>,
    /// Projects opened or saved lately.
    pub(super) recent: &'a [PathBuf],
    /// The project's name.
    pub(super) title: &'a str,
    pub(super) changed: bool,
}

impl Menu<'_> {
    /// Shows the menu bar; gives what was chosen.
    pub(super) fn show(&self, ui: &mut egui::Ui) -> Option<Wanted> {
        let mut chosen = None;
        let mut names: Vec<&'static str> =
            vec![texts::FILE_MENU, texts::EDIT_MENU, texts::SELECT_MENU, texts::VIEW_MENU];
        let last = [texts::WINDOW_MENU, texts::HELP_MENU];
        for name in self.commands.iter().map(|it| it.of).filter(|name| !last.contains(name)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.extend(last);
        egui::MenuBar::new().ui(ui, |ui| {
            for name in names {
                let commands: Vec<_> = self.commands.iter().filter(|it| it.of == name).collect();
                if commands.is_empty() {
                    continue;
                }
                ui.menu_button(name, |ui| {
                    for Offered { command, wanted, .. } in commands {
                        if self.entry(ui, command, *wanted).clicked() {
                            chosen = Some(*wanted);
                            ui.close();
                        }
                    }
                    if name == texts::FILE_MENU {
                        chosen = chosen.or(self.recently_used(ui));
                    }
                });
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let mark = if self.changed { " *" } else { "" };
                ui.label(
                    egui::RichText::new(format!("{}{mark}", self.title)).color(Tokens::of(ui).text_weak),
                );
            });
        });
        chosen
    }

    fn recently_used(&self, ui: &mut egui::Ui) -> Option<Wanted> {
        let mut chosen = None;
        if !self.recent.is_empty() {
            ui.separator();
        }
        for (index, path) in self.recent.iter().enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                chosen = Some(Wanted::Recent(index));
                ui.close();
            }
        }
        chosen
    }

    fn entry(&self, ui: &mut egui::Ui, command: &Command, wanted: Wanted) -> egui::Response {
        let step = match command.name {
            texts::UNDO => self.undo,
            texts::REDO => self.redo,
            _ => None,
        };
        let name = step.map_or_else(|| command.name.to_owned(), |step| format!("{}: {step}", command.name));
        let shortcut = command.shortcut.map(|shortcut| ui.format_shortcut(&shortcut)).unwrap_or_default();
        let button = egui::Button::new(name).right_text(shortcut);
        ui.add_enabled((self.can_run)(wanted), button).on_hover_text(command.tooltip)
    }
}
