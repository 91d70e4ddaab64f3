//! The selected panels: fabric, direction, what the file says of them.

use amc_core::direction::{Direction, Source};
use amc_core::mesh::{Garment, Panel, Unit};
use eframe::egui::{self, Key, KeyboardShortcut, Modifiers};
use studio_plugin::document::{Edit, Gesture, Project};
use studio_plugin::{Command, Context, Pane, Place, Plugin};

use super::panels::flags;
use super::picked;
use crate::studio::texts::{NO_FABRIC, OPENING, inspector as texts};
use crate::studio::theme::STEP;

/// The angle field: a drag of it is one gesture.
#[derive(Debug, Default)]
pub(super) struct Inspector {
    dragged: Option<Gesture>,
}

const SWAP: Command = Command {
    id: "swap",
    name: texts::SWAP,
    tooltip: texts::SWAP_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, Key::R)),
};
const BIAS: Command = Command {
    id: "bias",
    name: texts::BIAS,
    tooltip: texts::BIAS_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::SHIFT, Key::R)),
};
const GRAIN: Command = Command { id: "grain", name: texts::GRAIN, tooltip: texts::GRAIN_TIP, shortcut: None };

impl Plugin for Inspector {
    fn id(&self) -> &'static str {
        "inspector"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn commands(&self) -> Vec<Command> {
        vec![SWAP, BIAS, GRAIN]
    }

    fn can_run(&self, _command: &str, studio: &Context<'_>) -> bool {
        studio.stage.garment.is_some()
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else { return };
        let panels = picked(&garment, studio);
        let edit = if command == GRAIN.id {
            Edit::SetDirection {
                panels: panels.iter().map(|panel| panel.id.clone()).collect(),
                direction: None,
            }
        } else {
            let degrees: f32 = if command == SWAP.id { 90.0 } else { 45.0 };
            let now = panels.iter().map(|panel| (panel.id.clone(), direction(panel, studio)));
            Edit::TurnDirection { panels: now.collect(), by: degrees.to_radians() }
        };
        studio.submit(edit);
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "panel", title: texts::PANE, place: Place::Right }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else {
            ui.weak(OPENING);
            return;
        };
        let panels = picked(&garment, studio);
        match (studio.selection.panels.len(), panels.as_slice()) {
            (0, _) => {
                ui.heading(texts::ALL);
                ui.weak(texts::CLICK);
                unit(ui, studio);
            }
            (1, [panel]) => facts(ui, panel, (&garment, studio.document.project())),
            (count, _) => {
                ui.heading(texts::panels(count));
            }
        }
        if panels.is_empty() {
            return;
        }
        ui.add_space(2.0 * STEP);
        fabric(ui, &panels, studio);
        self.angle(ui, &panels, studio);
        for command in [SWAP, BIAS, GRAIN] {
            if ui.button(command.name).on_hover_text(command.tooltip).clicked() {
                self.run(command.id, studio);
            }
        }
    }
}

/// What the numbers of the garment's file mean. Bundled garments are in metres.
fn unit(ui: &mut egui::Ui, studio: &mut Context<'_>) {
    let project = studio.document.project();
    if project.garment.path().is_none() {
        return;
    }
    let mut unit = project.unit;
    ui.horizontal(|ui| {
        let label = ui.label(texts::UNIT);
        let list = egui::ComboBox::from_id_salt("unit").selected_text(unit.symbol()).show_ui(ui, |ui| {
            for each in Unit::ALL {
                ui.selectable_value(&mut unit, each, each.symbol());
            }
        });
        list.response.labelled_by(label.id).on_hover_text(texts::UNIT_TIP);
    });
    if unit != project.unit {
        studio.submit(Edit::SetUnit(unit));
    }
}

fn direction(panel: &Panel, studio: &Context<'_>) -> Direction {
    let look = studio.document.project().look_of(panel);
    look.direction.unwrap_or_else(|| Direction::along_grain(panel))
}

fn facts(ui: &mut egui::Ui, panel: &Panel, (garment, project): (&Garment, &Project)) {
    ui.heading(project.panel_name(panel));
    let name = |index: usize| garment.panels.get(index).map_or("", |panel| project.panel_name(panel));
    let mut facts =
        vec![(texts::AREA, texts::area(panel.area)), (texts::TRIANGLES, panel.triangles.len().to_string())];
    if let Some(grain) = panel.pattern.grain {
        facts.push((texts::GRAIN_FACT, texts::degrees(grain)));
    }
    if let Some(mirror) = panel.pattern.mirror {
        facts.push((texts::MIRROR, name(mirror).to_owned()));
    }
    egui::Grid::new("facts").num_columns(2).show(ui, |ui| {
        for (what, value) in facts {
            ui.weak(what);
            ui.label(value);
            ui.end_row();
        }
    });
    if panel.flags.mirrored || panel.flags.degenerate {
        ui.label(flags(panel.flags));
    }
}

fn fabric(ui: &mut egui::Ui, panels: &[&Panel], studio: &mut Context<'_>) {
    let project = studio.document.project();
    let worn: Vec<_> = panels.iter().map(|panel| project.look_of(panel).fabric).collect();
    let same = worn.first().copied().filter(|first| worn.iter().all(|other| other == first));
    let named =
        |id| project.fabrics.iter().find(|fabric| Some(fabric.id) == id).map(|fabric| fabric.name.clone());
    let shown = match same {
        Some(id) => named(id).unwrap_or_else(|| NO_FABRIC.to_owned()),
        None => texts::SEVERAL.to_owned(),
    };
    let fabrics = project.fabrics.clone();
    let ids: Vec<String> = panels.iter().map(|panel| panel.id.clone()).collect();
    ui.horizontal(|ui| {
        let label = ui.label(texts::FABRIC);
        let list = egui::ComboBox::from_id_salt("fabric").selected_text(shown).show_ui(ui, |ui| {
            for fabric in fabrics {
                if ui.selectable_label(same == Some(Some(fabric.id)), &fabric.name).clicked() {
                    studio.submit(Edit::SetFabric { panels: ids.clone(), fabric: Some(fabric.id) });
                }
            }
            if ui.selectable_label(same == Some(None), NO_FABRIC).clicked() {
                studio.submit(Edit::SetFabric { panels: ids.clone(), fabric: None });
            }
        });
        list.response.labelled_by(label.id).on_hover_text(texts::FABRIC_TIP);
    });
}

impl Inspector {
    fn angle(&mut self, ui: &mut egui::Ui, panels: &[&Panel], studio: &mut Context<'_>) {
        let now: Vec<(String, Direction)> =
            panels.iter().map(|panel| (panel.id.clone(), direction(panel, studio))).collect();
        let Some((_, first)) = now.first().cloned() else { return };
        let mut degrees = first.angle.to_degrees();
        let before = degrees;
        ui.horizontal(|ui| {
            let field = egui::DragValue::new(&mut degrees).speed(0.5).max_decimals(1).suffix("°");
            let label = ui.label(texts::NAME);
            let field = ui.add(field).labelled_by(label.id).on_hover_text(texts::ANGLE_TIP);
            if field.drag_started() {
                self.dragged = Some(Gesture::begin());
            }
            if degrees != before {
                let edit = Edit::TurnDirection { panels: now.clone(), by: (degrees - before).to_radians() };
                match self.dragged {
                    Some(gesture) => studio.submit_in(gesture, edit),
                    None => studio.submit(edit),
                }
            }
            if field.drag_stopped() {
                self.dragged = None;
            }
        });
        ui.horizontal(|ui| {
            for (source, name, tooltip) in [
                (Source::Gradient, texts::GRADIENT, texts::GRADIENT_TIP),
                (Source::Yarn, texts::YARN, texts::YARN_TIP),
            ] {
                if ui.radio(first.source == source, name).on_hover_text(tooltip).clicked() {
                    let gesture = Gesture::begin();
                    for (id, direction) in &now {
                        let direction = Some(Direction { source, ..*direction });
                        let edit = Edit::SetDirection { panels: vec![id.clone()], direction };
                        studio.submit_in(gesture, edit);
                    }
                }
            }
        });
    }
}
