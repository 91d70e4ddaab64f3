//! The window: the host that every plugin lives in.

mod app;
mod commands;
mod desk;
mod device_loss;
mod dock;
mod files;
mod help;
mod menu;
mod milestones;
mod other_garment;
mod palette;
mod panes;
mod path_field;
mod questions;
mod settings;
mod settings_page;
mod shortcuts;
mod stager;
mod texts;
mod theme;
mod thumbnail;
mod toasts;
mod welcome;

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;

use amc_core::{Error, Result};
use eframe::egui;
use studio_plugin::{Plugin, Registry};

use crate::storage::Folders;

use device_loss::{Handover, Patience};

pub use app::App;
pub use milestones::Milestone;

/// A studio to be: the built-in plugins, and whatever is added.
///
/// ```no_run
/// # struct Mine;
/// # impl studio_plugin::Plugin for Mine {
/// #     fn id(&self) -> &'static str { "mine" }
/// #     fn name(&self) -> &'static str { "Mine" }
/// # }
/// amc_studio::studio::Studio::new().with_plugin(Mine).run()
/// # .unwrap()
/// ```
pub struct Studio {
    plugins: Registry,
    files: Vec<PathBuf>,
    folders: Option<Folders>,
    has_dialogs: bool,
    tell: Option<Box<dyn FnMut(Milestone)>>,
}

/// How a window came to its end before a person closed it.
#[derive(Debug)]
pub(crate) enum Ended {
    /// It could not be opened: why.
    NotOpened(Error),
    /// It was open, and could not be opened again.
    Lost(Error),
}

impl std::fmt::Debug for Studio {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Studio")
            .field("plugins", &self.plugins)
            .field("files", &self.files)
            .finish_non_exhaustive()
    }
}

impl Default for Studio {
    fn default() -> Self {
        Self::new()
    }
}

impl Studio {
    /// With the built-in plugins, opening the bundled garment.
    pub fn new() -> Self {
        let mut plugins = Registry::default();
        panes::register(&mut plugins);
        Self {
            plugins,
            files: Vec::new(),
            folders: Folders::of_the_person(),
            has_dialogs: files::system_has_dialogs(),
            tell: None,
        }
    }

    /// With one plugin more.
    #[must_use]
    pub fn with_plugin(mut self, plugin: impl Plugin + 'static) -> Self {
        self.plugins.register(plugin);
        self
    }

    /// Opening these files: projects, meshes, fabrics.
    #[must_use]
    pub fn open(mut self, files: impl IntoIterator<Item = PathBuf>) -> Self {
        self.files.extend(files);
        self
    }

    /// Keeping recovery files, locks and settings in `folder`, not where the system has them.
    #[must_use]
    pub fn keeping_in(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folders = Some(Folders::in_folder(&folder.into()));
        self
    }

    /// Asking for files by a path to be typed, not by the system's dialogs.
    #[must_use]
    pub fn without_dialogs(mut self) -> Self {
        self.has_dialogs = false;
        self
    }

    /// Telling when something was first shown.
    #[must_use]
    pub fn telling(mut self, tell: impl FnMut(Milestone) + 'static) -> Self {
        self.tell = Some(Box::new(tell));
        self
    }

    /// Opens the window, until it is closed. If its graphics device is lost it is opened again on another one, with the
    /// same document.
    ///
    /// # Errors
    /// [`amc_core::ErrorKind::Device`]: there is no display, or no graphics adapter; or devices are lost time and again.
    pub fn run(self) -> Result<()> {
        self.run_windows().map_err(|ended| match ended {
            Ended::NotOpened(why) => {
                let what = format!("no window can be opened: {why}; commands such as 'render' need none");
                Error::device(what).because(why)
            }
            Ended::Lost(error) => error,
        })
    }

    pub(crate) fn run_windows(self) -> Result<(), Ended> {
        let handover = Handover::default();
        let mut first = Some(self);
        let mut patience = Patience::new();
        loop {
            let (studio, left) = (first.take(), handover.clone());
            let create = move |creation: &eframe::CreationContext<'_>| -> Option<App> {
                let app = match studio {
                    Some(studio) => studio.into_app(creation),
                    None => App::resume(left.take()?, creation),
                };
                Some(app.leaving_to(left))
            };
            let outcome = catch_unwind(AssertUnwindSafe(|| open_window(create)));
            match (outcome, handover.take()) {
                (outcome, Some(kept)) => {
                    let why = outcome.ok().and_then(Result::err);
                    if !patience.allows_another() {
                        return Err(Ended::Lost(given_up(why)));
                    }
                    handover.leave(kept);
                }
                (Ok(Ok(())), None) => return Ok(()),
                (Ok(Err(error)), None) => return Err(Ended::NotOpened(no_window(error))),
                (Err(panic), None) => resume_unwind(panic),
            }
        }
    }

    /// The application itself, for a window that somebody else opens.
    pub fn into_app(self, creation: &eframe::CreationContext<'_>) -> App {
        App::new(self, creation)
    }
}

/// The program's icon. A window does without, if it cannot be decoded.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../../assets/desktop/amc-studio.png"))
        .unwrap_or_default()
}

/// One window, until it is closed.
fn open_window(
    create: impl FnOnce(&eframe::CreationContext<'_>) -> Option<App> + 'static,
) -> eframe::Result<()> {
    let viewport = egui::ViewportBuilder::default()
        .with_title(texts::PROGRAM)
        .with_app_id("amc-studio")
        .with_icon(icon())
        .with_inner_size([1440.0, 900.0])
        .with_min_inner_size([640.0, 420.0]);
    // Dithering would change the colours that are judged.
    let options = eframe::NativeOptions { viewport, dithering: false, ..Default::default() };
    let create: eframe::AppCreator<'static> = Box::new(move |creation| match create(creation) {
        Some(app) => Ok(Box::new(app)),
        None => Err("nothing was left to open".into()),
    });
    eframe::run_native(texts::PROGRAM, options, create)
}

fn no_window(error: eframe::Error) -> Error {
    use eframe::egui_wgpu::WgpuError;
    let what = match &error {
        eframe::Error::Wgpu(WgpuError::RequestAdapterError(_) | WgpuError::CreateSurfaceError(_)) => {
            "there is no graphics adapter; install a graphics driver (in software: Mesa)".to_owned()
        }
        error => error.to_string(),
    };
    Error::device(what)
}

fn given_up(why: Option<eframe::Error>) -> Error {
    let why = why.map_or_else(String::new, |why| format!(" ({})", no_window(why)));
    Error::device(format!(
        "the graphics device was lost time and again{why}; unsaved work is kept and offered at the next start; \
         another driver may help, or WGPU_BACKEND=gl"
    ))
}
