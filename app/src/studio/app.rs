//! The application: what is open, and one frame of it.

mod actions;
mod asking;
mod panes;

use std::path::Path;

use amc_core::render::gpu::Gpu;
use eframe::egui::{self, Key, Modifiers, ViewportCommand};
use studio_plugin::document::Document;
use studio_plugin::{Context, Jobs, Notices, Registry, Request, Selection};

use super::commands::{self, Offered};
use super::desk::Desk;
use super::device_loss::{Handover, Kept, Watch};
use super::dock::{self, Layout};
use super::files::{self, Dialog, Opened, Purpose};
use super::help::Help;
use super::menu::Menu;
use super::milestones::Milestones;
use super::other_garment::OtherGarment;
use super::palette::Palette;
use super::settings::{self, Preferences};
use super::settings_page::SettingsPage;
use super::stager::Stager;
use super::theme::{self, Tokens};
use super::welcome::Chosen;
use super::{Studio, texts, toasts};
use crate::viewport::Viewport;

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
    preferences: Preferences,
    settings_page: SettingsPage,
    help: Help,
    palette: Palette,
    /// The plugin and its tool in the person's hand.
    tool: Option<(&'static str, &'static str)>,
    /// What was chosen on the cards of the first steps in this frame.
    chosen_step: Option<Chosen>,
    dialog: Option<Dialog>,
    /// A garment that is to take the place of the one at hand.
    other_garment: Option<OtherGarment>,
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
        let (layout, preferences) = desk
            .settings_folder()
            .map(|folder| settings::restore(folder, &mut registry, &mut notices))
            .unwrap_or_default();
        let layout = layout.unwrap_or_else(|| dock::initial(&registry));
        let selection = Selection::default();
        let kept = Kept { desk, selection, registry, layout, preferences, notices, has_dialogs };
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
        let Kept { desk, selection, registry, layout, preferences, notices, has_dialogs } = kept;
        preferences.apply(&creation.egui_ctx);
        Self {
            desk,
            selection,
            jobs: Jobs::new(move || context.request_repaint()),
            notices,
            layout,
            stager: Stager::new(&registry),
            registry,
            gpu: render_state.map(|state| Gpu { device: state.device.clone(), queue: state.queue.clone() }),
            viewport: render_state.map(Viewport::new),
            preferences,
            settings_page: SettingsPage::default(),
            help: Help::default(),
            palette: Palette::default(),
            tool: None,
            chosen_step: None,
            dialog: None,
            other_garment: None,
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
        let is_read = self.other_garment.as_ref().is_none_or(|garment| !garment.is_being_read());
        self.jobs.is_idle() && !self.desk.is_busy() && !self.stager.is_busy() && is_read
    }

    /// Takes in what has happened since the last frame; gives the commands there are.
    fn begin_frame(&mut self, ui: &egui::Ui) -> Vec<Offered> {
        self.answered(ui);
        self.drops(ui);
        self.with_context(|registry, studio| registry.each(studio, |plugin, studio| plugin.update(studio)));
        self.desk.update(&mut self.notices);
        self.read_garment();
        self.stager.update(self.desk.document.project(), &mut self.jobs, &mut self.notices);
        self.stager.cover(self.registry.cover(&mut self.notices));
        if let Some(garment) = &self.stager.stage.garment {
            self.selection.retain(|id| garment.panels.iter().any(|panel| panel.id == id));
        }
        let mut all = commands::all(&self.registry);
        self.preferences.shortcuts.apply(&mut all);
        all
    }

    /// Every pane that there is: the plugin's id, and the pane's.
    pub fn panes(&self) -> Vec<(&'static str, &'static str)> {
        let plugins = self.registry.plugins().iter().map(|it| it.plugin());
        plugins.flat_map(|it| it.panes().into_iter().map(|pane| (it.id(), pane.id))).collect()
    }

    /// One frame with nothing but a pane of [`App::panes`].
    pub fn show_alone(&mut self, ui: &mut egui::Ui, (plugin, pane): (&'static str, &'static str)) {
        let all = self.begin_frame(ui);
        if let Some(wanted) = self.pressed(ui, &all) {
            self.run(wanted, ui);
        }
        let frame = dock::pane_frame(Tokens::of(ui));
        egui::CentralPanel::default().frame(frame).show(ui, |ui| self.show_pane(ui, plugin, pane));
    }

    /// Opens a file as one that was dropped.
    pub fn open(&mut self, file: &Path) {
        match files::opened(file) {
            Opened::Project(path) => self.desk.open(&path, &mut self.jobs),
            Opened::Garment(asset) => self.open_garment(asset),
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
            self.notices.failed(texts::files::nothing_opens(&name));
            return;
        };
        self.with_context(|registry, studio| {
            registry.plugins_mut()[index].call(studio, |plugin, studio| plugin.import(file, studio));
        });
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
        )
        .holding(self.tool);
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
            Request::Tool(plugin, tool) => self.take(plugin, tool),
            Request::Copy(text) => self.context.copy_text(text),
            Request::AskWhere(plugin, ask) => self.ask(Purpose::Where(plugin, ask)),
            Request::AskWhich(plugin, ask) => self.ask(Purpose::Which(plugin, ask)),
        }
    }

    /// Puts a tool into the person's hand; the one that is there already is put away.
    fn take(&mut self, plugin: &'static str, tool: &'static str) {
        self.tool = if self.tool == Some((plugin, tool)) { None } else { Some((plugin, tool)) };
    }

    fn title(&self) -> String {
        let name = self.desk.file.as_ref().and_then(|file| file.file_name());
        name.map_or_else(|| texts::UNNAMED.to_owned(), |name| name.to_string_lossy().into_owned())
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
        let all = self.begin_frame(ui);
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
        if let Some(chosen) = self.chosen_step.take() {
            self.take_step(chosen, ui);
        }
        wanted = wanted.or(self.palette.show(ui, &all));
        self.show_settings(ui, &all);
        self.help.show(ui);
        if let Some(wanted) = wanted {
            self.run(wanted, ui);
        }
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            match self.tool.take() {
                Some(_) => {}
                None => self.selection.panels.clear(),
            }
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
            && let Err(error) = settings::keep(
                &folder,
                &mut self.registry,
                (&self.layout, &self.preferences),
                &mut self.notices,
            )
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
            preferences: std::mem::take(&mut self.preferences),
            notices: std::mem::take(&mut self.notices),
            has_dialogs: self.has_dialogs,
        });
    }
}
