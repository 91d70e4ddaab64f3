//! A studio with one plugin more: it adds up how much cloth the garment takes, fabric by fabric.

use std::collections::BTreeMap;

use amc_studio::studio::Studio;
use eframe::egui;
use studio_plugin::{Command, Context, Pane, Place, Plugin};

/// The share of the cloth that is cut away, of 1.
struct ClothNeeded {
    waste: f32,
}

const COPY: Command = Command {
    id: "copy",
    name: "Copy the cloth needed",
    tooltip: "Puts the list of areas into the clipboard",
    shortcut: None,
};

impl ClothNeeded {
    /// Square metres of each fabric, waste counted.
    fn areas(&self, studio: &Context<'_>) -> BTreeMap<String, f32> {
        let project = studio.document.project();
        let mut areas = BTreeMap::new();
        for panel in studio.stage.garment.iter().flat_map(|garment| &garment.panels) {
            if let Some(fabric) = project.look_of(panel).fabric.and_then(|id| project.fabric(id)) {
                *areas.entry(fabric.name.clone()).or_default() += panel.area / (1.0 - self.waste);
            }
        }
        areas
    }
}

impl Plugin for ClothNeeded {
    fn id(&self) -> &'static str {
        "cloth-needed"
    }

    fn name(&self) -> &'static str {
        "Cloth needed"
    }

    fn commands(&self) -> Vec<Command> {
        vec![COPY]
    }

    fn run(&mut self, _command: &str, studio: &mut Context<'_>) {
        let lines = self.areas(studio).into_iter().map(|(name, area)| format!("{name}\t{area:.2} m2\n"));
        let text: String = lines.collect();
        studio.copy(text);
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "list", title: "Cloth needed", place: Place::Right }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        ui.add(egui::Slider::new(&mut self.waste, 0.0..=0.5).text("Cut away"));
        for (name, area) in self.areas(studio) {
            ui.label(format!("{name}: {area:.2} m2"));
        }
    }
}

fn main() -> amc_core::Result<()> {
    Studio::new().with_plugin(ClothNeeded { waste: 0.15 }).run()
}
