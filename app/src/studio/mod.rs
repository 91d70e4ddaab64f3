//! The window: the host that every plugin lives in.

mod app;
mod commands;
mod desk;
mod dock;
mod files;
mod help;
mod menu;
mod palette;
mod panes;
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

use std::path::PathBuf;

use amc_core::{Error, Result};
use eframe::egui;
use studio_plugin::{Plugin, Registry};

use crate::storage::Folders;

pub use app::App;

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
#[derive(Debug)]
pub struct Studio {
    plugins: Registry,
    files: Vec<PathBuf>,
    folders: Option<Folders>,
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
        Self { plugins, files: Vec::new(), folders: Folders::of_the_person() }
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

    /// Opens the window, until it is closed.
    ///
    /// # Errors
    /// [`amc_core::ErrorKind::Device`]: there is no display, or no graphics adapter.
    pub fn run(self) -> Result<()> {
        let viewport = egui::ViewportBuilder::default()
            .with_title(texts::PROGRAM)
            .with_app_id("amc-studio")
            .with_icon(icon())
            .with_inner_size([1440.0, 900.0])
            .with_min_inner_size([640.0, 420.0]);
        // Dithering would change the colours that are judged.
        let options = eframe::NativeOptions { viewport, dithering: false, ..Default::default() };
        let made = eframe::run_native(
            texts::PROGRAM,
            options,
            Box::new(|creation| Ok(Box::new(self.into_app(creation)))),
        );
        made.map_err(|error| {
            Error::device(format!("no window can be opened: {error}; commands such as 'render' need none"))
        })
    }

    /// The application itself, for a window that somebody else opens.
    pub fn into_app(self, creation: &eframe::CreationContext<'_>) -> App {
        App::new(self.plugins, self.files, self.folders, creation)
    }
}

/// The program's icon. A window does without, if it cannot be decoded.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../../assets/desktop/amc-studio.png"))
        .unwrap_or_default()
}
