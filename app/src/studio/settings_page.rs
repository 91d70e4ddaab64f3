//! Where the person chooses theme, text size, shortcuts and layouts.

use eframe::egui::{self, Event, Key};

use super::commands::Offered;
use super::dock::{self, Layout};
use super::settings::{Preferences, SCALES, Theme};
use super::shortcuts::{self, Shortcuts};
use super::texts::{self, settings as words};
use super::theme::{STEP, Tokens};

/// The page, while it is open.
#[derive(Debug, Default)]
pub(super) struct SettingsPage {
    open: Option<Tab>,
    /// The key of the command that is given a shortcut: the next key pressed.
    listening: Option<String>,
    /// Letters that the names of the shown commands have.
    filter: String,
    /// The name of the layout to be kept.
    layout_name: String,
}

/// How high the list of shortcuts may grow, points.
const LIST_HEIGHT: f32 = 90.0 * STEP;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tab {
    Appearance,
    Shortcuts,
    Layouts,
}

const TABS: [(Tab, &str); 3] = [
    (Tab::Appearance, words::APPEARANCE),
    (Tab::Shortcuts, words::SHORTCUTS),
    (Tab::Layouts, words::LAYOUTS),
];

impl SettingsPage {
    pub(super) fn toggle(&mut self) {
        self.open = if self.open.is_some() { None } else { Some(Tab::Appearance) };
        self.listening = None;
    }

    /// Whether the keys pressed now are for it.
    pub(super) fn is_listening(&self) -> bool {
        self.open.is_some() && self.listening.is_some()
    }

    /// Shows it while it is open.
    pub(super) fn show(
        &mut self,
        ui: &egui::Ui,
        preferences: &mut Preferences,
        layout: &mut Layout,
        commands: &[Offered],
    ) {
        let Some(tab) = self.open else { return };
        let modal = egui::Modal::new(egui::Id::unique("settings")).show(ui, |ui| {
            ui.set_width(130.0 * STEP);
            ui.horizontal(|ui| {
                ui.heading(texts::SETTINGS);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button(texts::CLOSE).clicked() {
                        self.open = None;
                    }
                });
            });
            ui.horizontal(|ui| {
                for (each, name) in TABS {
                    if ui.selectable_label(tab == each, name).clicked() {
                        (self.open, self.listening) = (Some(each), None);
                    }
                }
            });
            ui.separator();
            match tab {
                Tab::Appearance => appearance(ui, preferences),
                Tab::Shortcuts => self.shortcuts(ui, &mut preferences.shortcuts, commands),
                Tab::Layouts => self.layouts(ui, preferences, layout),
            }
        });
        if modal.should_close() && self.listening.is_none() {
            self.open = None;
        }
    }

    fn shortcuts(&mut self, ui: &mut egui::Ui, shortcuts: &mut Shortcuts, commands: &[Offered]) {
        self.listen(ui, shortcuts, commands);
        ui.horizontal(|ui| {
            let label = ui.label(words::FIND);
            ui.add(egui::TextEdit::singleline(&mut self.filter).desired_width(60.0 * STEP))
                .labelled_by(label.id);
            let reset = egui::Button::new(words::AS_THEY_COME);
            if ui.add_enabled(shortcuts.is_changed(), reset).clicked() {
                shortcuts.reset();
            }
        });
        ui.weak(words::HOW);
        let filter = self.filter.to_lowercase();
        let list = egui::ScrollArea::vertical().max_height(LIST_HEIGHT).min_scrolled_height(LIST_HEIGHT);
        list.auto_shrink([false, true]).show(ui, |ui| {
            egui::Grid::new("shortcuts").num_columns(3).striped(true).show(ui, |ui| {
                for offered in commands.iter().filter(|it| it.command.name.to_lowercase().contains(&filter)) {
                    self.row(ui, offered);
                }
            });
        });
    }

    fn row(&mut self, ui: &mut egui::Ui, offered: &Offered) {
        ui.label(offered.command.name).on_hover_text(offered.command.tooltip);
        ui.label(egui::RichText::new(offered.of).color(Tokens::of(ui).text_weak));
        let is_heard = self.listening.as_deref() == Some(offered.key.as_ref());
        let shown = match offered.command.shortcut {
            _ if is_heard => words::PRESS.to_owned(),
            Some(shortcut) => ui.format_shortcut(&shortcut),
            None => words::NONE.to_owned(),
        };
        let button =
            egui::Button::selectable(is_heard, shown.as_str()).min_size(egui::vec2(32.0 * STEP, 0.0));
        let button = ui.add(button);
        button.widget_info(|| {
            let label = words::shortcut_of(offered.command.name, &shown);
            egui::WidgetInfo::labeled(egui::Role::Button, true, label)
        });
        if button.clicked() {
            self.listening = Some(offered.key.to_string());
        }
        ui.end_row();
    }

    /// Takes the keys that are pressed for the command which waits for them.
    fn listen(&mut self, ui: &egui::Ui, shortcuts: &mut Shortcuts, commands: &[Offered]) {
        let Some(key) = self.listening.clone() else { return };
        let heard = ui.input_mut(|input| {
            let heard = input.events.iter().find_map(|event| match event {
                Event::Key { key, pressed: true, modifiers, .. } => Some((*key, *modifiers)),
                _ => None,
            });
            if heard.is_some() {
                input.events.retain(|event| !matches!(event, Event::Key { .. } | Event::Text(_)));
            }
            heard
        });
        match heard {
            None => return,
            Some((Key::Escape, _)) => {}
            Some((Key::Backspace | Key::Delete, held)) if held.is_none() => {
                shortcuts.set(commands, &key, None);
            }
            Some((pressed, held)) => {
                shortcuts.set(commands, &key, Some(shortcuts::pressed(pressed, held)));
            }
        }
        self.listening = None;
    }

    fn layouts(&mut self, ui: &mut egui::Ui, preferences: &mut Preferences, layout: &mut Layout) {
        ui.horizontal(|ui| {
            let label = ui.label(words::LAYOUT_NAME);
            ui.add(egui::TextEdit::singleline(&mut self.layout_name).desired_width(60.0 * STEP))
                .labelled_by(label.id);
            let name = self.layout_name.trim();
            let keep = egui::Button::new(words::KEEP_LAYOUT);
            if ui.add_enabled(!name.is_empty(), keep).clicked() {
                preferences.layouts.insert(name.to_owned(), layout.clone());
                self.layout_name.clear();
            }
        });
        if preferences.layouts.is_empty() {
            ui.weak(words::NO_LAYOUT);
        }
        let mut unwanted = None;
        for (name, kept) in &preferences.layouts {
            ui.horizontal(|ui| {
                let usable = dock::is_usable(kept);
                let button = ui.add_enabled(usable, egui::Button::new(words::USE));
                if button.on_hover_text(words::use_layout(name)).clicked() {
                    *layout = kept.clone();
                }
                if ui.button(words::REMOVE).on_hover_text(words::remove_layout(name)).clicked() {
                    unwanted = Some(name.clone());
                }
                ui.label(name);
            });
        }
        if let Some(name) = unwanted {
            preferences.layouts.remove(&name);
        }
    }
}

fn appearance(ui: &mut egui::Ui, preferences: &mut Preferences) {
    egui::Grid::new("appearance").num_columns(2).show(ui, |ui| {
        ui.label(words::THEME);
        ui.horizontal(|ui| {
            for (theme, name) in
                [(Theme::System, words::AS_SYSTEM), (Theme::Light, words::LIGHT), (Theme::Dark, words::DARK)]
            {
                ui.radio_value(&mut preferences.theme, theme, name);
            }
        });
        ui.end_row();
        let label = ui.label(words::SCALE);
        let mut percent = preferences.scale * 100.0;
        let range = SCALES.start() * 100.0..=SCALES.end() * 100.0;
        // While it is dragged, a change would move the field under the pointer.
        let field = egui::DragValue::new(&mut percent).range(range).max_decimals(0).suffix(" %");
        let field = ui.add(field.speed(1.0).update_while_editing(false)).labelled_by(label.id);
        if field.changed() {
            preferences.scale = percent / 100.0;
        }
        ui.end_row();
    });
}
