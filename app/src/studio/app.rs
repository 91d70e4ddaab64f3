//! The application: what is open, and one frame of it.

use std::collections::BTreeSet;
use std::path::Path;

use amc_core::render::gpu::Gpu;
use eframe::egui::{self, Key, Modifiers, ViewportCommand};
use studio_plugin::document::Document;
use studio_plugin::{Context, Jobs, Notices, Registry, Request, Selection};

use super::commands::{self, Action, Wanted};
use super::desk::Desk;
use super::device_loss::{Handover, Kept, Watch};
use super::dock::{self, Layout, Pane};
use super::files::{self, Dialog, Opened, Purpose};
use super::menu::Menu;
use super::milestones::Milestones;
use super::palette::Palette;
use super::questions::{self, OfMissing, OfRecovery};
use super::stager::Stager;
use super::theme::{self, STEP, Tokens};
use super::{Studio, settings, texts, toasts};
use crate::viewport::{Viewport, ViewportInput};

/// The studio's window.
pub struct App {
    desk: Desk,
    selection: Selection,
    jobs: Jobs,
    notices: Notices,
    registry: Registry,
    stager: Stager,
    gpu: Option<Gpu>,
    viewport: Option<Viewport>,
    layout: Layout,
    palette: Palette,
    dialog: Option<Dialog>,
    /// Asked before the window closes with changes.
    leaving: bool,
    /// Changes are to be thrown away: the window may close.
    discard: bool,
    /// The window is to close once the project is saved.
    leaving_saved: bool,
    context: egui::Context,
    has_dialogs: bool,
    milestones: Milestones,
    device: Watch,
    /// Where the work goes if the device is lost; none: there is no next window.
    handover: Option<Handover>,
}

impl std::fmt::Debug for App {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("App")
            .field("desk", &self.desk)
            .field("registry", &self.registry)
            .finish_non_exhaustive()
    }
}

impl App {
    pub(super) fn new(studio: Studio, creation: &eframe::CreationContext<'_>) -> Self {
        let Studio { plugins: mut registry, files, folders, has_dialogs, tell } = studio;
        let mut notices = Notices::default();
        let desk = Desk::new(folders, &mut notices);
        let layout =
            desk.settings_folder().and_then(|folder| settings::restore(folder, &mut registry, &mut notices));
        let layout = layout.unwrap_or_else(|| dock::initial(&registry));
        let kept = Kept { desk, selection: Selection::default(), registry, layout, notices, has_dialogs };
        let mut app = Self::with(kept, creation);
        app.milestones = tell.map_or_else(Milestones::default, Milestones::new);
        for file in files {
            app.open(&file);
        }
        app
    }

    /// Goes on where a window was whose device is lost.
    pub(super) fn resume(kept: Kept, creation: &eframe::CreationContext<'_>) -> Self {
        let mut app = Self::with(kept, creation);
        app.notices.note(texts::DEVICE_LOST);
        app
    }

    /// Leaving the work there if the device is lost.
    pub(super) fn leaving_to(mut self, handover: Handover) -> Self {
        self.handover = Some(handover);
        self
    }

    fn with(kept: Kept, creation: &eframe::CreationContext<'_>) -> Self {
        theme::apply(&creation.egui_ctx);
        let context = creation.egui_ctx.clone();
        let render_state = creation.wgpu_render_state.as_ref();
        let Kept { desk, selection, registry, layout, notices, has_dialogs } = kept;
        Self {
            desk,
            selection,
            jobs: Jobs::new(move || context.request_repaint()),
            notices,
            layout,
            registry,
            stager: Stager::default(),
            gpu: render_state.map(|state| Gpu { device: state.device.clone(), queue: state.queue.clone() }),
            viewport: render_state.map(Viewport::new),
            palette: Palette::default(),
            dialog: None,
            leaving: false,
            discard: false,
            leaving_saved: false,
            context: creation.egui_ctx.clone(),
            has_dialogs,
            milestones: Milestones::default(),
            device: render_state
                .map_or_else(Watch::default, |state| Watch::over(&state.device, &creation.egui_ctx)),
            handover: None,
        }
    }

    /// What the person works on.
    pub fn document(&self) -> &Document {
        &self.desk.document
    }

    /// Whether all that the document asks for is drawn, and nothing runs.
    pub fn is_settled(&self) -> bool {
        self.jobs.is_idle() && !self.desk.is_busy() && !self.stager.is_busy()
    }

    /// Opens a file as one that was dropped.
    pub fn open(&mut self, file: &Path) {
        match files::opened(file) {
            Opened::Project(path) => self.desk.open(&path, &mut self.jobs),
            Opened::Edit(edit) => {
                if let Err(error) = self.desk.document.submit(edit, None) {
                    self.notices.failed(error);
                }
            }
            Opened::Import(path) => self.import(&path),
        }
    }

    /// Saves to where the project is, else asks where.
    fn save(&mut self) {
        match self.desk.file.clone() {
            Some(path) => self.save_to(&path),
            None => self.ask(Purpose::Save),
        }
    }

    /// Saves the project to a file, which is from then on where it is saved.
    pub fn save_to(&mut self, path: &Path) {
        self.desk.save(path, &mut self.jobs);
    }

    fn import(&mut self, file: &Path) {
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().to_lowercase();
        let takes = |registered: &studio_plugin::Registered| {
            let importers = registered.plugin().importers();
            !registered.is_off()
                && importers
                    .iter()
                    .flat_map(|it| it.suffixes)
                    .any(|suffix| name.ends_with(&format!(".{suffix}")))
        };
        let Some(index) = self.registry.plugins().iter().position(takes) else {
            self.notices.failed(format!(
                "nothing here opens '{name}': projects end in .amcproj, garments in .glb, .gltf or .obj, fabrics in .amc.ktx2"
            ));
            return;
        };
        self.with_context(|registry, studio| {
            registry.plugins_mut()[index].call(studio, |plugin, studio| plugin.import(file, studio));
        });
    }

    fn ask(&mut self, purpose: Purpose) {
        if self.dialog.is_none() {
            let name = files::suggested_name(self.desk.document.project());
            let file = self.desk.file.as_deref();
            self.dialog = Some(Dialog::open(purpose, (&name, file), self.has_dialogs, &mut self.jobs));
        }
    }

    fn answered(&mut self, ui: &egui::Ui) {
        let Some(dialog) = &mut self.dialog else { return };
        let Some(answer) = dialog.poll(ui) else { return };
        let purpose = dialog.purpose.clone();
        self.dialog = None;
        match (answer, purpose) {
            (Ok(Some(path)), Purpose::Open) => self.open(&path),
            (Ok(Some(path)), Purpose::Save) => self.save_to(&path),
            (Ok(Some(path)), Purpose::Find(old)) => self.desk.locate(&old, &path, &mut self.notices),
            (Ok(None), _) => {}
            (Err(error), _) => self.notices.failed(error),
        }
    }

    /// Lends plugins what they may see, then does what they asked for.
    fn with_context<T>(&mut self, call: impl FnOnce(&mut Registry, &mut Context<'_>) -> T) -> T {
        let mut requests = Vec::new();
        let mut studio = Context::new(
            (&self.desk.document, &self.stager.stage),
            &mut self.selection,
            (&mut self.jobs, &mut self.notices),
            self.gpu.as_ref(),
            &mut requests,
        );
        let outcome = call(&mut self.registry, &mut studio);
        for request in requests {
            self.grant(request);
        }
        outcome
    }

    fn grant(&mut self, request: Request) {
        match request {
            Request::Edit(edit, gesture) => {
                if let Err(error) = self.desk.document.submit(edit, gesture) {
                    self.notices.failed(error);
                }
            }
            Request::GoTo(position) => self.desk.document.go_to(position),
            Request::View(view) => self.desk.document.set_view(view),
            Request::Copy(text) => self.context.copy_text(text),
        }
    }

    fn run(&mut self, wanted: Wanted, ui: &egui::Ui) {
        match wanted {
            Wanted::Own(action) => self.act(action, ui),
            Wanted::Recent(index) => {
                if let Some(path) = self.desk.recent.get(index).cloned() {
                    self.open(&path);
                }
            }
            Wanted::Pane { plugin, pane } => {
                let pane = Pane::Plugin { plugin: plugin.to_owned(), pane: pane.to_owned() };
                dock::bring_forward(&mut self.layout, &pane);
            }
            Wanted::Plugin { plugin, command } => self.with_context(|registry, studio| {
                if let Some(plugin) = registry.get_mut(plugin) {
                    plugin.call(studio, |plugin, studio| {
                        if plugin.can_run(command, studio) {
                            plugin.run(command, studio);
                        }
                    });
                }
            }),
        }
    }

    fn act(&mut self, action: Action, ui: &egui::Ui) {
        match action {
            Action::New => self.desk.begin(),
            Action::Open => self.ask(Purpose::Open),
            Action::Save => self.save(),
            Action::SaveAs => self.ask(Purpose::Save),
            Action::Quit => ui.send_viewport_cmd(ViewportCommand::Close),
            Action::Undo => {
                self.desk.document.undo();
            }
            Action::Redo => {
                self.desk.document.redo();
            }
            Action::SelectAll => {
                let panels = self.stager.stage.garment.iter().flat_map(|garment| &garment.panels);
                let panels = panels.filter(|panel| panel.takes_fabric).map(|panel| panel.id.clone());
                self.selection.panels = panels.collect();
            }
            Action::SelectNone => self.selection.panels.clear(),
            Action::Palette => self.palette.toggle(),
            Action::Theme => {
                let other =
                    if ui.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ui.set_theme(other);
            }
            Action::ResetLayout => self.layout = dock::initial(&self.registry),
            Action::Larger => ui.set_zoom_factor((ui.zoom_factor() + 0.1).min(2.5)),
            Action::Smaller => ui.set_zoom_factor((ui.zoom_factor() - 0.1).max(0.5)),
        }
    }

    fn can_run(&self, wanted: Wanted) -> bool {
        match wanted {
            Wanted::Own(Action::Undo) => self.desk.document.undo_name().is_some(),
            Wanted::Own(Action::Redo) => self.desk.document.redo_name().is_some(),
            Wanted::Own(Action::SelectNone) => !self.selection.panels.is_empty(),
            Wanted::Own(_) | Wanted::Plugin { .. } | Wanted::Pane { .. } | Wanted::Recent(_) => true,
        }
    }

    /// The plugins' commands that cannot be run now.
    fn blocked(&mut self, all: &[(&'static str, studio_plugin::Command, Wanted)]) -> Vec<Wanted> {
        self.with_context(|registry, studio| {
            let mut is_blocked = |wanted: &Wanted| {
                let Wanted::Plugin { plugin, command } = *wanted else { return false };
                let plugin = registry.get_mut(plugin);
                plugin.and_then(|it| it.call(studio, |plugin, studio| plugin.can_run(command, studio)))
                    == Some(false)
            };
            all.iter().map(|(.., wanted)| *wanted).filter(|wanted| is_blocked(wanted)).collect()
        })
    }

    /// The command whose shortcut was pressed, unless somebody types a text.
    fn pressed(
        &self,
        ui: &egui::Ui,
        all: &[(&'static str, studio_plugin::Command, Wanted)],
    ) -> Option<Wanted> {
        let typing = ui.egui_wants_keyboard_input();
        let fires = |shortcut: &egui::KeyboardShortcut| {
            // Letters alone are for whoever is typing.
            let plain = !shortcut.modifiers.command && !shortcut.modifiers.alt;
            !(typing && plain) && ui.input_mut(|input| input.consume_shortcut(shortcut))
        };
        // Those with more modifiers first: what is pressed with Shift is not what is pressed without.
        let mut with_keys: Vec<_> =
            all.iter().filter_map(|(_, command, wanted)| Some((command.shortcut?, *wanted))).collect();
        let count = |modifiers: Modifiers| {
            u8::from(modifiers.command) + u8::from(modifiers.shift) + u8::from(modifiers.alt)
        };
        with_keys.sort_by_key(|(shortcut, _)| std::cmp::Reverse(count(shortcut.modifiers)));
        with_keys.into_iter().find(|(shortcut, _)| fires(shortcut)).map(|(_, wanted)| wanted)
    }

    fn title(&self) -> String {
        let name = self.desk.file.as_ref().and_then(|file| file.file_name());
        name.map_or_else(|| texts::UNNAMED.to_owned(), |name| name.to_string_lossy().into_owned())
    }

    fn show_panes(&mut self, ui: &mut egui::Ui) {
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
            Pane::Plugin { plugin, pane } => self.with_context(|registry, studio| {
                if let Some(plugin) = registry.get_mut(plugin) {
                    plugin.call(studio, |plugin, studio| plugin.show(pane, ui, studio));
                }
            }),
        };
        let mut behavior = dock::Behavior { tokens: Tokens::of(ui), title: &title, show: &mut show };
        layout.ui(&mut behavior, ui);
        self.layout = if dock::is_usable(&layout) { layout } else { dock::initial(&self.registry) };
    }

    fn show_viewport(&mut self, ui: &mut egui::Ui) {
        let Some(viewport) = &mut self.viewport else {
            ui.centered_and_justified(|ui| ui.label(texts::NO_GPU));
            return;
        };
        let Some((drawing, picker)) = &self.stager.drawn.latest else {
            ui.centered_and_justified(|ui| ui.weak(texts::LOADING));
            return;
        };
        viewport.set_scene(drawing.clone(), picker.clone());
        viewport.set_compared(self.stager.compared.latest.as_ref().map(|(drawing, _)| drawing.clone()));
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
            compared: project.view.compared_shading(),
            tool: false,
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
    }

    /// Takes in files that were dropped, and says while some are held over the window that they can be.
    fn drops(&mut self, ui: &egui::Ui) {
        let (dropped, held) =
            ui.input(|input| (input.raw.dropped_files.clone(), !input.raw.hovered_files.is_empty()));
        for file in dropped {
            self.open(file.path());
        }
        if held {
            let painter =
                ui.layer_painter(egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop")));
            let tokens = Tokens::of(ui);
            let rect = ui.content_rect().shrink(4.0 * STEP);
            painter.rect(
                rect,
                2.0 * STEP,
                tokens.surface.gamma_multiply(0.9),
                egui::Stroke::new(2.0, tokens.accent),
                egui::StrokeKind::Inside,
            );
            painter.text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                texts::DROP_HERE,
                egui::TextStyle::Heading.resolve(ui.style()),
                tokens.text,
            );
        }
    }

    /// Asks what must be answered before the work goes on.
    fn question(&mut self, ui: &egui::Ui) {
        // One at a time: what is taken back would take the place of what is not saved yet.
        let offered = if self.desk.document.is_changed() { &[] } else { self.desk.recoverable.as_slice() };
        match questions::recovery(ui, offered) {
            Some(OfRecovery::Recover(index)) => self.desk.recover(index, &mut self.notices),
            Some(OfRecovery::Discard(index)) => self.desk.discard(index, &mut self.notices),
            None => {}
        }
        match questions::missing(ui, &self.desk.missing) {
            Some(OfMissing::Find(path)) => self.ask(Purpose::Find(path)),
            Some(OfMissing::Without) => self.desk.missing.clear(),
            None => {}
        }
    }

    /// Holds the window open while there are changes that nobody has said what to do with.
    fn leave(&mut self, ui: &egui::Ui) {
        if ui.input(|input| input.viewport().close_requested())
            && self.desk.document.is_changed()
            && !self.discard
        {
            ui.send_viewport_cmd(ViewportCommand::CancelClose);
            self.leaving = true;
        }
        if self.leaving_saved && !self.desk.is_busy() && self.dialog.is_none() {
            // What could not be saved keeps the window open.
            self.leaving_saved = false;
            if !self.desk.document.is_changed() {
                ui.send_viewport_cmd(ViewportCommand::Close);
            }
        }
        if !self.leaving {
            return;
        }
        let mut save = false;
        let modal = egui::Modal::new(egui::Id::unique("leaving")).show(ui, |ui| {
            ui.heading(texts::UNSAVED_TITLE);
            ui.label(texts::UNSAVED_TEXT);
            ui.add_space(2.0 * STEP);
            ui.horizontal(|ui| {
                save = ui.button(texts::SAVE).clicked();
                self.discard = ui.button(texts::DISCARD).clicked();
                if ui.button(texts::STAY).clicked() {
                    self.leaving = false;
                }
            });
        });
        if modal.should_close() {
            self.leaving = false;
        }
        if save {
            self.save();
            self.leaving = false;
            self.leaving_saved = true;
        }
        if self.discard {
            ui.send_viewport_cmd(ViewportCommand::Close);
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        if self.device.is_lost() && self.handover.is_some() {
            // Nothing is drawn on what is lost.
            ui.send_viewport_cmd(ViewportCommand::Close);
            return;
        }
        self.milestones.begin_frame(ui);
        self.answered(ui);
        self.drops(ui);
        self.with_context(|registry, studio| registry.each(studio, |plugin, studio| plugin.update(studio)));
        self.desk.update(&mut self.notices);
        self.stager.update(self.desk.document.project(), &mut self.jobs, &mut self.notices);
        if let Some(garment) = &self.stager.stage.garment {
            self.selection.retain(|id| garment.panels.iter().any(|panel| panel.id == id));
        }
        let all = commands::all(&self.registry);
        let mut wanted = self.pressed(ui, &all);
        let blocked = self.blocked(&all);
        let title = self.title();
        let menu = Menu {
            commands: &all,
            can_run: &|wanted| self.can_run(wanted) && !blocked.contains(&wanted),
            undo: self.desk.document.undo_name(),
            redo: self.desk.document.redo_name(),
            recent: &self.desk.recent,
            title: &title,
            changed: self.desk.document.is_changed(),
        };
        let bar = egui::Panel::top("menu").show(ui, |ui| menu.show(ui)).inner;
        wanted = wanted.or(bar);
        egui::CentralPanel::no_frame().show(ui, |ui| self.show_panes(ui));
        wanted = wanted.or(self.palette.show(ui, &all));
        if let Some(wanted) = wanted {
            self.run(wanted, ui);
        }
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.selection.panels.clear();
        }
        toasts::show(ui, &self.notices);
        self.question(ui);
        self.leave(ui);
        let has_garment = self.viewport.as_ref().is_some_and(|viewport| viewport.scenes_drawn() > 0);
        self.milestones.end_frame(ui, has_garment);
        if self.device.is_lost_by_now() {
            // egui's renderer panics where it cannot upload what is to be painted: nothing is.
            ui.graphics_mut(|layers| drop(std::mem::take(layers)));
            ui.request_repaint();
        }
    }

    fn on_exit(&mut self) {
        if self.device.is_lost() && self.handover.is_some() {
            // The next window goes on.
            return;
        }
        if let Some(folder) = self.desk.settings_folder().map(Path::to_owned)
            && let Err(error) = settings::keep(&folder, &mut self.registry, &self.layout, &mut self.notices)
        {
            // Nobody is left to be told in the window.
            log::error!("{error}");
        }
        self.desk.finish();
    }
}

impl Drop for App {
    fn drop(&mut self) {
        let Some(handover) = self.handover.take().filter(|_| self.device.is_lost_by_now()) else { return };
        let blank = Desk::new(None, &mut Notices::default());
        handover.leave(Kept {
            desk: std::mem::replace(&mut self.desk, blank),
            selection: std::mem::take(&mut self.selection),
            registry: std::mem::take(&mut self.registry),
            layout: std::mem::replace(&mut self.layout, Layout::empty(egui::Id::unique("left"))),
            notices: std::mem::take(&mut self.notices),
            has_dialogs: self.has_dialogs,
        });
    }
}
