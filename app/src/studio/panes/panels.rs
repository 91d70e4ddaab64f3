//! The garment's panels as a list: what each is made of, and whether it is shown.

use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Panel};
use eframe::egui::{self, RichText, Sense, vec2};
use studio_plugin::document::Edit;
use studio_plugin::{Command, Context, Pane, Place, Plugin};

use crate::studio::texts::{NO_FABRIC, OPENING, panels as texts};
use crate::studio::theme::{STEP, Tokens};
use crate::studio::thumbnail::Textures;

/// The list, and the textures of its thumbnails.
#[derive(Default)]
pub(super) struct Panels {
    textures: Textures,
}

const HIDE: Command = Command {
    id: "hide",
    name: texts::HIDE,
    tooltip: texts::HIDE_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::NONE, egui::Key::H)),
};
const ISOLATE: Command = Command {
    id: "isolate",
    name: texts::ISOLATE,
    tooltip: texts::ISOLATE_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::SHIFT, egui::Key::H)),
};
const SHOW_ALL: Command = Command {
    id: "show-all",
    name: texts::SHOW_ALL,
    tooltip: texts::SHOW_ALL_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::ALT, egui::Key::H)),
};

impl Plugin for Panels {
    fn id(&self) -> &'static str {
        "panels"
    }

    fn name(&self) -> &'static str {
        texts::NAME
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
        vec![Pane { id: "list", title: texts::NAME, place: Place::Left }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else {
            ui.weak(OPENING);
            return;
        };
        let mut hovered = None;
        for (part, panels) in parts(&garment) {
            if let [panel] = panels.as_slice() {
                self.row(ui, studio, &garment, *panel, &mut hovered);
                continue;
            }
            let title = texts::part(part, panels.len());
            egui::CollapsingHeader::new(title).id_salt(part).default_open(true).show(ui, |ui| {
                for panel in panels {
                    self.row(ui, studio, &garment, panel, &mut hovered);
                }
            });
        }
        if hovered.is_some() {
            studio.selection.hovered = hovered;
        }
    }
}

impl Panels {
    fn row(
        &mut self,
        ui: &mut egui::Ui,
        studio: &mut Context<'_>,
        garment: &Garment,
        number: usize,
        hovered: &mut Option<String>,
    ) {
        let panel = &garment.panels[number];
        let look = studio.document.project().look_of(panel);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            show_box(ui, studio, panel, look.visible);
            let direction = look.direction.unwrap_or_else(|| Direction::along_grain(panel));
            self.thumbnail(ui, studio, number, look.fabric.map(|_| direction.angle));
            let tokens = Tokens::of(ui);
            let selected = studio.selection.panels.contains(&panel.id);
            let weak = if selected { tokens.on_accent } else { tokens.text_weak };
            let fabric = look.fabric.and_then(|id| studio.document.project().fabric(id));
            let worn = fabric.map_or_else(
                || NO_FABRIC.to_owned(),
                |fabric| format!("{}, {:.0}°", fabric.name, direction.angle.to_degrees()),
            );
            let mark = if panel.flags.mirrored || panel.flags.degenerate { " *" } else { "" };
            let row = egui::Button::selectable(selected, format!("{}{mark}", panel.name))
                .right_text(RichText::new(worn).color(weak))
                .truncate()
                .min_size(vec2(ui.available_width(), 6.0 * STEP))
                .sense(Sense::click());
            let row = ui.add(row);
            if row.hovered() {
                *hovered = Some(panel.id.clone());
            }
            if row.clicked() {
                let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
                studio.selection.click(&panel.id, add);
            }
            if !mark.is_empty() {
                row.on_hover_text(flags(panel.flags));
            }
        });
    }

    /// The flat piece, and on it the direction of its warp, where it has one.
    fn thumbnail(&mut self, ui: &mut egui::Ui, studio: &Context<'_>, number: usize, angle: Option<f32>) {
        let tokens = Tokens::of(ui);
        let (rect, _) = ui.allocate_exact_size(vec2(6.0 * STEP, 6.0 * STEP), Sense::hover());
        if let Some(piece) = studio.stage.pieces.get(number) {
            let texture = self.textures.of(ui, piece);
            let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture, rect, whole, tokens.text_weak.gamma_multiply(0.6));
        }
        if let Some(angle) = angle {
            let along = 1.8 * STEP * vec2(angle.cos(), -angle.sin());
            ui.painter().arrow(rect.center() - along, 2.0 * along, egui::Stroke::new(1.0, tokens.accent));
        }
    }
}

fn show_box(ui: &mut egui::Ui, studio: &mut Context<'_>, panel: &Panel, mut visible: bool) {
    let eye = ui.checkbox(&mut visible, "").on_hover_text(texts::SHOWN_TIP);
    eye.widget_info(|| {
        let label = texts::show(&panel.name);
        egui::WidgetInfo::selected(egui::Role::CheckBox, true, visible, label)
    });
    if eye.changed() {
        studio.submit(Edit::SetVisible { panels: vec![panel.id.clone()], visible });
    }
}

/// Numbers of the panels, those of one part of the file together: `sleeve 1` and `sleeve 2` are of `sleeve`.
fn parts(garment: &Garment) -> Vec<(&str, Vec<usize>)> {
    let mut parts: Vec<(&str, Vec<usize>)> = Vec::new();
    for (number, panel) in garment.panels.iter().enumerate() {
        let part = match panel.name.rsplit_once(' ') {
            Some((part, end)) if end.parse::<usize>().is_ok() => part,
            _ => panel.name.as_str(),
        };
        match parts.iter_mut().find(|(known, _)| *known == part) {
            Some((_, panels)) => panels.push(number),
            None => parts.push((part, vec![number])),
        }
    }
    parts
}

/// What is unusual about a panel's UVs, for people.
pub(super) fn flags(flags: amc_core::mesh::PanelFlags) -> &'static str {
    match (flags.mirrored, flags.degenerate) {
        (true, true) => texts::MIRRORED_AND_DEGENERATE,
        (true, false) => texts::MIRRORED,
        (false, true) => texts::DEGENERATE,
        (false, false) => texts::REGULAR,
    }
}
