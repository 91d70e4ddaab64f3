//! The fabrics in use, and those that come with the program.

use std::path::Path;

use amc_core::reflectance::BUNDLED;
use eframe::egui::{self, vec2};
use studio_plugin::document::{Asset, Edit, FabricId, FabricInUse};
use studio_plugin::{Context, Importer, Pane, Place, Plugin};

use crate::studio::texts::fabrics as texts;
use crate::studio::theme::STEP;
use crate::studio::thumbnail::Textures;

/// The list, and the textures of its balls.
#[derive(Default)]
pub(super) struct Fabrics {
    textures: Textures,
}

impl Plugin for Fabrics {
    fn id(&self) -> &'static str {
        "fabrics"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "list", title: texts::NAME, place: Place::Left }]
    }

    fn importers(&self) -> Vec<Importer> {
        vec![Importer { name: texts::NAME, suffixes: &["amc.ktx2", "ktx2"] }]
    }

    fn import(&mut self, file: &Path, studio: &mut Context<'_>) {
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy();
        let name = name.trim_end_matches(".ktx2").trim_end_matches(".amc").to_owned();
        put_on(studio, Asset::file(file), &name);
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        ui.weak(texts::hint(studio.selection.panels.len()));
        ui.add_space(STEP);
        let fabrics = studio.document.project().fabrics.clone();
        for fabric in &fabrics {
            let detail = studio.stage.fabrics.get(&fabric.id).map_or_else(String::new, |amc| {
                let size = amc.size();
                texts::detail(size.side(), size.slices(), amc.symmetry.order())
            });
            ui.horizontal(|ui| {
                let (rect, _) = ui.allocate_exact_size(vec2(7.0 * STEP, 7.0 * STEP), egui::Sense::hover());
                if let Some(ball) = studio.stage.swatches.get(&fabric.id) {
                    let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                    ui.painter().image(self.textures.of(ui, ball), rect, whole, egui::Color32::WHITE);
                }
                if wide_button(ui, &fabric.name, &detail).clicked() {
                    wear(studio, fabric.id);
                }
            });
        }
        ui.add_space(2.0 * STEP);
        ui.strong(texts::BUNDLED);
        for bundled in BUNDLED {
            let asset = Asset::Bundled(format!("fabric:{}", bundled.name));
            if !fabrics.iter().any(|fabric| fabric.asset == asset)
                && wide_button(ui, &capitalised(bundled.name), "").clicked()
            {
                let name = capitalised(bundled.name);
                put_on(studio, asset, &name);
            }
        }
    }
}

/// A name as a title: `Satin`.
fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

fn wide_button(ui: &mut egui::Ui, name: &str, detail: &str) -> egui::Response {
    let detail = egui::RichText::new(detail).weak().small();
    ui.add(
        egui::Button::new(name)
            .right_text(detail)
            .truncate()
            .min_size(vec2(ui.available_width(), 7.0 * STEP)),
    )
}

/// Adds a fabric, unless it is there, and puts it on what is selected.
fn put_on(studio: &mut Context<'_>, asset: Asset, name: &str) {
    let project = studio.document.project();
    let known = project.fabrics.iter().find(|fabric| fabric.asset == asset).map(|fabric| fabric.id);
    let id = known.unwrap_or_else(|| project.free_fabric_id());
    if known.is_none() {
        studio.submit(Edit::AddFabric(FabricInUse { id, asset, name: name.to_owned() }));
    }
    wear(studio, id);
}

/// Puts a fabric on the selected panels; where none is, on all that take one.
fn wear(studio: &mut Context<'_>, fabric: FabricId) {
    let Some(garment) = &studio.stage.garment else { return };
    let selected = &studio.selection.panels;
    let panels = garment
        .panels
        .iter()
        .filter(|panel| if selected.is_empty() { panel.takes_fabric } else { selected.contains(&panel.id) });
    let panels = panels.map(|panel| panel.id.clone()).collect();
    studio.submit(Edit::SetFabric { panels, fabric: Some(fabric) });
}
