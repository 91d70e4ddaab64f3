//! The garment's panels as a list: what each is called and made of, whether it is shown, which belong together.

mod merging;
mod naming;

use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Panel};
use eframe::egui::{self, RichText, Sense, vec2};
use studio_plugin::document::{Edit, Project};
use studio_plugin::{Command, Context, Pane, Place, Plugin, ViewportView};

use self::merging::Merging;
use self::naming::Name;

use crate::studio::texts::{NO_FABRIC, OPENING, panels as texts};
use crate::studio::theme::{STEP, Tokens};
use crate::studio::thumbnail::Textures;

/// The list, the textures of its thumbnails, and what is being asked.
#[derive(Default)]
pub(super) struct Panels {
    textures: Textures,
    /// The panel that is being renamed, by its id.
    renamed: Option<(String, Name)>,
    /// The panels that are being grouped.
    grouped: Option<(Vec<String>, Name)>,
    merging: Option<Merging>,
}

const RENAME: Command = Command {
    id: "rename",
    name: texts::RENAME,
    tooltip: texts::RENAME_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::NONE, egui::Key::F2)),
};
const GROUP: Command = Command {
    id: "group",
    name: texts::GROUP,
    tooltip: texts::GROUP_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(egui::Modifiers::COMMAND, egui::Key::G)),
};
const UNGROUP: Command = Command {
    id: "ungroup",
    name: texts::UNGROUP,
    tooltip: texts::UNGROUP_TIP,
    shortcut: Some(egui::KeyboardShortcut::new(
        egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT),
        egui::Key::G,
    )),
};
const MERGE: Command = Command { id: "merge", name: texts::MERGE, tooltip: texts::MERGE_TIP, shortcut: None };

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
        vec![HIDE, ISOLATE, SHOW_ALL, RENAME, GROUP, UNGROUP, MERGE]
    }

    fn can_run(&self, command: &str, studio: &Context<'_>) -> bool {
        let selected = &studio.selection.panels;
        match command {
            _ if command == SHOW_ALL.id => true,
            _ if command == RENAME.id => selected.len() == 1,
            _ if command == MERGE.id => selected.len() > 1,
            _ if command == UNGROUP.id => {
                let project = studio.document.project();
                selected.iter().any(|id| project.group_of(id).is_some())
            }
            _ => !selected.is_empty(),
        }
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else { return };
        if [RENAME, GROUP, UNGROUP, MERGE].iter().any(|known| known.id == command) {
            return self.arrange(command, &garment, studio);
        }
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
        let project = studio.document.snapshot().project;
        let mut hovered = None;
        for (group, members) in &project.groups {
            let there = |number: &usize| members.contains(&garment.panels[*number].id);
            let panels: Vec<usize> = (0..garment.panels.len()).filter(there).collect();
            if !panels.is_empty() {
                self.group(ui, studio, &garment, (group, &panels), &mut hovered);
            }
        }
        for (part, panels) in parts(&garment, &project) {
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

    fn overlay(&mut self, painter: &egui::Painter, _view: &ViewportView<'_>, studio: &mut Context<'_>) {
        let context = painter.ctx();
        if let Some((panels, name)) = &mut self.grouped
            && let Some(answer) = naming::ask_group(context, name)
        {
            let panels = std::mem::take(panels);
            self.grouped = None;
            if let Some(group) = answer {
                studio.submit(Edit::GroupPanels { panels, group: Some(group) });
            }
        }
        if let Some(answer) = self.merging.as_ref().and_then(|merging| merging.ask(context))
            && let Some(merging) = self.merging.take()
            && answer
        {
            merging.submit(studio);
        }
    }
}

impl Panels {
    /// Renames, groups, merges what is selected; asks first where there is something to ask.
    fn arrange(&mut self, command: &str, garment: &Garment, studio: &mut Context<'_>) {
        let selected = &studio.selection.panels;
        let numbers: Vec<usize> =
            (0..garment.panels.len()).filter(|&it| selected.contains(&garment.panels[it].id)).collect();
        let ids = || numbers.iter().map(|&number| garment.panels[number].id.clone()).collect::<Vec<_>>();
        let project = studio.document.project();
        if command == RENAME.id {
            if let [number] = numbers[..] {
                self.rename(&garment.panels[number], project);
            }
        } else if command == GROUP.id {
            self.grouped = Some((ids(), Name::default()));
        } else if command == UNGROUP.id {
            studio.submit(Edit::GroupPanels { panels: ids(), group: None });
        } else if let Some(merging) = Merging::new(project, garment, &numbers) {
            match merging.lost.is_empty() {
                true => merging.submit(studio),
                false => self.merging = Some(merging),
            }
        }
    }

    fn rename(&mut self, panel: &Panel, project: &Project) {
        self.renamed = Some((panel.id.clone(), Name::new(project.panel_name(panel))));
    }

    /// A group; a click on its name selects all of it.
    fn group(
        &mut self,
        ui: &mut egui::Ui,
        studio: &mut Context<'_>,
        garment: &Garment,
        (group, panels): (&str, &[usize]),
        hovered: &mut Option<String>,
    ) {
        let ids = || panels.iter().map(|&number| garment.panels[number].id.clone());
        let id = ui.make_persistent_id(("group", group));
        let state = egui::collapsing_header::CollapsingState::load_with_default_open(ui.ctx(), id, true);
        let header = state.show_header(ui, |ui| {
            let is_selected = ids().all(|id| studio.selection.panels.contains(&id));
            let title = ui.selectable_label(is_selected, texts::part(group, panels.len()));
            if title.on_hover_text(texts::GROUP_ROW_TIP).clicked() {
                if !ui.input(|input| input.modifiers.command || input.modifiers.shift) {
                    studio.selection.panels.clear();
                }
                studio.selection.panels.extend(ids());
            }
        });
        header.body(|ui| {
            for &panel in panels {
                self.row(ui, studio, garment, panel, hovered);
            }
        });
    }

    /// The field for a panel's new name, where it is being renamed.
    fn name_field(&mut self, ui: &mut egui::Ui, studio: &mut Context<'_>, panel: &Panel) -> bool {
        let Some((_, name)) = self.renamed.as_mut().filter(|(id, _)| *id == panel.id) else { return false };
        if let Some(answer) = name.show(ui, texts::NEW_NAME) {
            self.renamed = None;
            // Without a name it is called as in its file.
            if let Some(name) = answer {
                let name = Some(name).filter(|name| !name.is_empty() && *name != panel.name);
                studio.submit(Edit::RenamePanel { panel: panel.id.clone(), name });
            }
        }
        true
    }

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
        let name = studio.document.project().panel_name(panel).to_owned();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            show_box(ui, studio, (panel, &name), look.visible);
            let direction = look.direction.unwrap_or_else(|| Direction::along_grain(panel));
            self.thumbnail(ui, studio, number, look.fabric.map(|_| direction.angle));
            if self.name_field(ui, studio, panel) {
                return;
            }
            let tokens = Tokens::of(ui);
            let selected = studio.selection.panels.contains(&panel.id);
            let weak = if selected { tokens.on_accent } else { tokens.text_weak };
            let fabric = look.fabric.and_then(|id| studio.document.project().fabric(id));
            let worn = fabric.map_or_else(
                || NO_FABRIC.to_owned(),
                |fabric| format!("{}, {:.0}°", fabric.name, direction.angle.to_degrees()),
            );
            let mark = if panel.flags.mirrored || panel.flags.degenerate { " *" } else { "" };
            let row = egui::Button::selectable(selected, format!("{name}{mark}"))
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
            if row.double_clicked() {
                self.rename(panel, studio.document.project());
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

fn show_box(ui: &mut egui::Ui, studio: &mut Context<'_>, (panel, name): (&Panel, &str), mut visible: bool) {
    let eye = ui.checkbox(&mut visible, "").on_hover_text(texts::SHOWN_TIP);
    eye.widget_info(|| {
        let label = texts::show(name);
        egui::WidgetInfo::selected(egui::Role::CheckBox, true, visible, label)
    });
    if eye.changed() {
        studio.submit(Edit::SetVisible { panels: vec![panel.id.clone()], visible });
    }
}

/// Numbers of the panels in no group, those of one part of the file together: `sleeve 1` and `sleeve 2` are of `sleeve`.
fn parts<'a>(garment: &'a Garment, project: &'a Project) -> Vec<(&'a str, Vec<usize>)> {
    let mut parts: Vec<(&str, Vec<usize>)> = Vec::new();
    let panels = garment.panels.iter().enumerate();
    for (number, panel) in panels.filter(|(_, panel)| project.group_of(&panel.id).is_none()) {
        let name = project.panel_name(panel);
        let part = match name.rsplit_once(' ') {
            Some((part, end)) if end.parse::<usize>().is_ok() => part,
            _ => name,
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
