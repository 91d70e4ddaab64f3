//! The garment's panels as a list: what each is made of, and whether it is shown.

use eframe::egui::{self, RichText, Sense, vec2};
use studio_plugin::document::Edit;
use studio_plugin::{Command, Context, Pane, Place, Plugin};

use crate::studio::theme::{STEP, Tokens};

pub(super) struct Panels;

const HIDE: Command = Command {
    id: "hide",
    name: "Hide selected panels",
    tooltip: "They are not drawn until they are shown again",
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::NONE, egui::Key::H)),
};
const ISOLATE: Command = Command {
    id: "isolate",
    name: "Hide all others",
    tooltip: "Only the selected panels are drawn",
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::SHIFT, egui::Key::H)),
};
const SHOW_ALL: Command = Command {
    id: "show-all",
    name: "Show all panels",
    tooltip: "Panels that were hidden are drawn again",
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::ALT, egui::Key::H)),
};

impl Plugin for Panels {
    fn id(&self) -> &'static str {
        "panels"
    }

    fn name(&self) -> &'static str {
        "Panels"
    }

    fn commands(&self) -> Vec<Command> {
        vec![HIDE, ISOLATE, SHOW_ALL]
    }

    fn can_run(&self, command: &str, studio: &Context<'_>) -> bool {
        command == SHOW_ALL.id || !studio.selection.panels.is_empty()
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        let Some(garment) = &studio.stage.garment else { return };
        let all = garment.panels.iter().map(|panel| panel.id.clone());
        let selected = &studio.selection.panels;
        let edit = if command == HIDE.id {
            Edit::SetVisible { panels: selected.iter().cloned().collect(), visible: false }
        } else if command == ISOLATE.id {
            Edit::SetVisible { panels: all.filter(|id| !selected.contains(id)).collect(), visible: false }
        } else {
            Edit::SetVisible { panels: all.collect(), visible: true }
        };
        studio.submit(edit);
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "list", title: "Panels", place: Place::Left }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else {
            ui.weak("The garment is being opened.");
            return;
        };
        let tokens = Tokens::of(ui);
        let mut hovered = None;
        for panel in &garment.panels {
            let look = studio.document.project().look_of(panel);
            ui.horizontal(|ui| {
                let mut visible = look.visible;
                let eye = ui.checkbox(&mut visible, "").on_hover_text("Shown in the view");
                eye.widget_info(|| {
                    egui::WidgetInfo::selected(egui::Role::CheckBox, true, visible, format!("Show {}", panel.name))
                });
                if eye.changed() {
                    studio.submit(Edit::SetVisible { panels: vec![panel.id.clone()], visible });
                }
                let selected = studio.selection.panels.contains(&panel.id);
                let fabric = look.fabric.and_then(|id| studio.document.project().fabric(id));
                let weak = if selected { tokens.on_accent } else { tokens.text_weak };
                let fabric = RichText::new(fabric.map_or("no fabric", |fabric| fabric.name.as_str())).color(weak);
                let row = egui::Button::selectable(selected, panel.name.as_str())
                    .right_text(fabric)
                    .truncate()
                    .min_size(vec2(ui.available_width(), 6.0 * STEP))
                    .sense(Sense::click());
                let row = ui.add(row);
                if row.hovered() {
                    hovered = Some(panel.id.clone());
                }
                if row.clicked() {
                    let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
                    studio.selection.click(&panel.id, add);
                }
                if panel.flags.mirrored || panel.flags.degenerate {
                    row.on_hover_text(flags(panel.flags));
                }
            });
        }
        if hovered.is_some() {
            studio.selection.hovered = hovered;
        }
    }
}

/// What is unusual about a panel's UVs, for people.
pub(super) fn flags(flags: amc_core::mesh::PanelFlags) -> &'static str {
    match (flags.mirrored, flags.degenerate) {
        (true, true) => "Its UVs are mirrored, and some of it has none: directions there are filled from the neighbours",
        (true, false) => "Its UVs are mirrored",
        (false, true) => "Some of it has no UVs: directions there are filled from the neighbours",
        (false, false) => "Its UVs are as they should be",
    }
}
