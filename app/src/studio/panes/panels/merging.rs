//! Merging panels, and what of their choices cannot be kept.

use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::direction::comb::{Comb, Path, Stroke};
use amc_core::mesh::{FlatLocator, Garment, Panel};
use eframe::egui;
use studio_plugin::Context;
use studio_plugin::document::{Edit, Project};

use crate::studio::texts::{CANCEL, panels as texts};
use crate::studio::theme::STEP;

/// Panels that are to become one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Merging {
    /// Their ids, the one that lends its looks first.
    panels: Vec<String>,
    /// What that one is called.
    name: String,
    /// The strokes that comb what they become.
    comb: Option<Arc<Comb>>,
    /// What cannot be kept.
    pub(super) lost: Vec<String>,
}

impl Merging {
    /// Of the panels of these numbers; none where there is nothing to merge.
    pub(super) fn new(project: &Project, garment: &Garment, numbers: &[usize]) -> Option<Self> {
        let &[lead, _, ..] = numbers else { return None };
        let panels: Vec<&Panel> = numbers.iter().map(|&number| &garment.panels[number]).collect();
        let lead = &garment.panels[lead];
        let mut comb = project.comb(&lead.id).map(|comb| (**comb).clone()).unwrap_or_default();
        let has_strokes = panels.iter().any(|panel| project.comb(&panel.id).is_some());
        let locators: Vec<FlatLocator> = match has_strokes {
            true => panels.iter().map(|panel| FlatLocator::new(garment, panel)).collect(),
            false => Vec::new(),
        };
        let mut lost = Vec::new();
        if project.print(&lead.id).is_some() {
            lost.push(texts::print_moves(project.panel_name(lead)));
        }
        for (number, panel) in panels.iter().enumerate().skip(1) {
            let mut parts = differences(project, lead, panel);
            let is_elsewhere = |other: usize, stroke: &Stroke| match &stroke.path {
                // Where another piece lies over it in the flat pattern, a stroke would comb that one too.
                Path::Pattern(points) => {
                    points.iter().any(|&uv| other != number && locators[other].locate(garment, uv).is_some())
                }
                Path::Space(_) => false,
            };
            let is_free = |stroke: &Stroke| !(0..panels.len()).any(|other| is_elsewhere(other, stroke));
            parts.extend(take_strokes(&mut comb, project.comb(&panel.id), is_free));
            if !parts.is_empty() {
                lost.push(texts::of_panel(project.panel_name(panel), &parts));
            }
        }
        let comb = (comb != Comb::default()).then(|| Arc::new(comb));
        let name = project.panel_name(lead).to_owned();
        Some(Self { panels: panels.iter().map(|panel| panel.id.clone()).collect(), name, comb, lost })
    }

    pub(super) fn submit(self, studio: &mut Context<'_>) {
        if let Some(lead) = self.panels.first() {
            studio.selection.click(lead, false);
        }
        studio.submit(Edit::MergePanels { panels: self.panels, comb: self.comb });
    }

    /// Says what cannot be kept; whether the panels are to be merged, once that is said.
    pub(super) fn ask(&self, context: &egui::Context) -> Option<bool> {
        let mut answer = None;
        let modal = egui::Modal::new(egui::Id::unique("merge-panels")).show(context, |ui| {
            ui.set_max_width(120.0 * STEP);
            ui.heading(texts::MERGE);
            ui.label(texts::merged(&self.name));
            egui::ScrollArea::vertical().max_height(60.0 * STEP).show(ui, |ui| {
                self.lost.iter().for_each(|lost| drop(ui.label(lost)));
            });
            ui.weak(texts::UNDO_BRINGS_BACK);
            ui.add_space(2.0 * STEP);
            ui.horizontal(|ui| {
                if ui.button(texts::MERGE_ANSWER).clicked() {
                    answer = Some(true);
                }
                if ui.button(CANCEL).clicked() {
                    answer = Some(false);
                }
            });
        });
        if modal.should_close() { answer.or(Some(false)) } else { answer }
    }
}

/// What was chosen for a panel and is not so for the other.
fn differences(project: &Project, lead: &Panel, panel: &Panel) -> Vec<String> {
    let (leading, look) = (project.look_of(lead), project.look_of(panel));
    let mut parts = Vec::new();
    if look.fabric != leading.fabric {
        let name = look.fabric.and_then(|id| project.fabric(id)).map(|fabric| fabric.name.as_str());
        parts.push(texts::its_fabric(name));
    }
    let direction =
        |panel: &Panel, chosen: Option<Direction>| chosen.unwrap_or_else(|| Direction::along_grain(panel));
    let own = direction(panel, look.direction);
    if own != direction(lead, leading.direction) {
        parts.push(texts::its_angle(own.angle.to_degrees()));
    }
    if project.print(&panel.id).is_some() && project.print(&panel.id) != project.print(&lead.id) {
        parts.push(texts::ITS_PRINT.to_owned());
    }
    if look.visible != leading.visible {
        parts.push(if look.visible { texts::SHOWN } else { texts::HIDDEN }.to_owned());
    }
    if project.arrangement.names.contains_key(&panel.id) {
        parts.push(texts::ITS_NAME.to_owned());
    }
    parts
}

/// Takes over the strokes that mean the same there; says how many do not.
fn take_strokes(comb: &mut Comb, from: Option<&Arc<Comb>>, is_free: impl Fn(&Stroke) -> bool) -> Vec<String> {
    let Some(from) = from else { return Vec::new() };
    let mut left_out = 0;
    for stroke in &from.strokes {
        if from.turn == comb.turn && comb.strokes.len() < Comb::MOST_STROKES && is_free(stroke) {
            comb.strokes.push(stroke.clone());
        } else {
            left_out += 1;
        }
    }
    let mut parts = Vec::new();
    if left_out > 0 {
        parts.push(texts::its_strokes(left_out, from.strokes.len()));
    }
    if (from.elsewhere, from.reach) != (comb.elsewhere, comb.reach) {
        parts.push(texts::ITS_COMB.to_owned());
    }
    parts
}
