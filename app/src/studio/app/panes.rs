//! The panes, and the viewport among them.

use std::collections::BTreeSet;

use eframe::egui;
use studio_plugin::{Hand, ViewportView};

use super::App;
use crate::studio::dock::{self, Layout, Pane};
use crate::studio::stager::Shown;
use crate::studio::theme::{STEP, Tokens};
use crate::studio::{texts, welcome};
use crate::viewport::ViewportInput;

impl App {
    pub(super) fn show_panes(&mut self, ui: &mut egui::Ui) {
        // Taken out while it is shown: what is shown in it is the rest of the studio.
        let mut layout = std::mem::replace(&mut self.layout, Layout::empty(egui::Id::unique("lent")));
        let titles: Vec<(Pane, String)> = std::iter::once((Pane::Viewport, texts::VIEWPORT_TITLE.to_owned()))
            .chain(self.registry.plugins().iter().filter(|it| !it.is_off()).flat_map(|it| {
                let id = it.plugin().id();
                it.plugin().panes().into_iter().map(move |pane| {
                    (Pane::Plugin { plugin: id.to_owned(), pane: pane.id.to_owned() }, pane.title.to_owned())
                })
            }))
            .collect();
        let title =
            |wanted: &Pane| titles.iter().find(|(pane, _)| pane == wanted).map(|(_, title)| title.clone());
        let mut show = |pane: &Pane, ui: &mut egui::Ui| match pane {
            Pane::Viewport => self.show_viewport(ui),
            Pane::Plugin { plugin, pane } => self.show_pane(ui, plugin, pane),
        };
        let mut behavior = dock::Behavior { tokens: Tokens::of(ui), title: &title, show: &mut show };
        layout.ui(&mut behavior, ui);
        self.layout = if dock::is_usable(&layout) { layout } else { dock::initial(&self.registry) };
    }

    /// What is in a pane.
    pub(super) fn show_pane(&mut self, ui: &mut egui::Ui, plugin: &str, pane: &str) {
        self.with_context(|registry, studio| {
            if let Some(plugin) = registry.get_mut(plugin) {
                plugin.call(studio, |plugin, studio| plugin.show(pane, ui, studio));
            }
        });
    }

    fn show_viewport(&mut self, ui: &mut egui::Ui) {
        let Some(viewport) = &mut self.viewport else {
            ui.centered_and_justified(|ui| ui.label(texts::NO_GPU));
            return;
        };
        let Some(Shown { drawing, picker, compared }) = self.stager.shown() else {
            ui.centered_and_justified(|ui| ui.weak(texts::LOADING));
            return;
        };
        viewport.set_scene(drawing, picker.clone());
        viewport.set_compared(compared);
        let Some(garment) = &self.stager.stage.garment else { return };
        let project = self.desk.document.project();
        let number = |id: &String| garment.panels.iter().position(|panel| panel.id == *id);
        let selected: BTreeSet<usize> = self.selection.panels.iter().filter_map(number).collect();
        let hidden: BTreeSet<usize> =
            (0..garment.panels.len()).filter(|&k| !project.look_of(&garment.panels[k]).visible).collect();
        let tokens = Tokens::of(ui);
        let input = ViewportInput {
            selected: &selected,
            hovered: self.selection.hovered.as_ref().and_then(number),
            hidden: &hidden,
            shading: self.stager.stage.shading(&project.view),
            compared: self.stager.stage.compared_shading(&project.view),
            tool: self.tool.is_some(),
            backdrop: tokens.gap,
            selected_color: tokens.accent,
            hovered_color: tokens.text_weak,
        };
        let mut view = project.view.clone();
        let output = viewport.show(ui, &mut view, &input);
        let id = |panel: usize| garment.panels.get(panel).map(|panel| panel.id.clone());
        self.selection.hovered = output.hovered.and_then(id);
        if let Some(click) = output.clicked {
            match click.panel.and_then(id) {
                Some(panel) => self.selection.click(&panel, click.add),
                None if !click.add => self.selection.panels.clear(),
                None => {}
            }
        }
        if let Some(boxed) = output.boxed {
            if !boxed.add {
                self.selection.panels.clear();
            }
            self.selection.panels.extend(boxed.panels.into_iter().filter_map(id));
        }
        if view != project.view {
            self.desk.document.set_view(view);
        }
        if let Some(seen) = output.view {
            let view = ViewportView {
                rect: output.response.rect,
                view: seen,
                pixels_per_point: ui.pixels_per_point(),
                picker: &picker,
                hidden: &hidden,
            };
            self.lend_viewport(ui, &output.response, view);
        }
        if !self.preferences.welcomed
            && let Some(chosen) = welcome::show(ui, output.response.rect)
        {
            self.chosen_step = Some(chosen);
        }
    }

    /// Lets plugins paint over the garment, and the chosen tool work in it.
    fn lend_viewport(&mut self, ui: &egui::Ui, response: &egui::Response, viewport: ViewportView<'_>) {
        let painter = ui.painter_at(viewport.rect);
        let tool = self.tool;
        self.with_context(|registry, studio| {
            registry.each(studio, |plugin, studio| plugin.overlay(&painter, &viewport, studio));
            if let Some((plugin, tool)) = tool
                && let Some(plugin) = registry.get_mut(plugin)
            {
                let hand = Hand { viewport, response };
                plugin.call(studio, |plugin, studio| plugin.use_tool(tool, &hand, studio));
            }
        });
        if let Some(name) = self.tool_name() {
            let text = format!("{name}: {}", texts::PUT_AWAY);
            let at = viewport.rect.left_top() + egui::Vec2::splat(2.0 * STEP);
            let font = egui::TextStyle::Body.resolve(ui.style());
            painter.text(at, egui::Align2::LEFT_TOP, text, font, Tokens::of(ui).text);
        }
    }

    /// The name of the chosen tool. A tool whose plugin was switched off is put away.
    fn tool_name(&mut self) -> Option<&'static str> {
        let (id, tool) = self.tool?;
        let plugin = self.registry.get_mut(id).filter(|plugin| !plugin.is_off());
        let tools = plugin.map(|plugin| plugin.plugin().tools()).unwrap_or_default();
        let name = tools.iter().find(|it| it.id == tool).map(|it| it.name);
        if name.is_none() {
            self.tool = None;
        }
        name
    }
}
