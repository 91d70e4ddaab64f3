//! The trait of plugins, and what they declare.

use std::path::Path;
use std::sync::Arc;

use serde_json::Value;

use crate::{Command, Context, Cover, Hand, ShadingChoice, ViewportView};

/// Where a pane is put until the person puts it elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Beside the viewport, on the left.
    Left,
    /// Beside the viewport, on the right.
    Right,
    /// Next to the viewport, nearly as large: what is looked at together with the garment.
    Beside,
    /// Below the viewport.
    Bottom,
}

/// A dockable part of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pane {
    /// Stable, and unique within its plugin: layouts are kept by it.
    pub id: &'static str,
    /// The text of its tab.
    pub title: &'static str,
    /// Where it is put at first.
    pub place: Place,
}

/// Files that a plugin takes in, by dialog or dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Importer {
    /// What they are: "Garments".
    pub name: &'static str,
    /// Ends of their names, without a dot, in lower case: `amc.ktx2`.
    pub suffixes: &'static [&'static str],
}

/// A part of the studio that can be added or left out. Every method but the first two has a default.
///
/// State that belongs to the project goes into it by [`crate::document::Edit::SetPluginState`], and so can be undone; state
/// that belongs to the person is kept by [`Plugin::settings`].
///
/// No method may take longer than a share of a frame: long work goes to [`Context::jobs`]. One that panics switches its
/// plugin off, with a notice; the rest of the studio goes on.
pub trait Plugin {
    /// Stable, unique among plugins: lower case, words joined by `-`.
    fn id(&self) -> &'static str;

    /// For people.
    fn name(&self) -> &'static str;

    /// What it can be asked for.
    fn commands(&self) -> Vec<Command> {
        Vec::new()
    }

    /// Whether a command can be run now; it is greyed out where not.
    fn can_run(&self, _command: &str, _studio: &Context<'_>) -> bool {
        true
    }

    /// Runs a command of [`Plugin::commands`].
    fn run(&mut self, _command: &str, _studio: &mut Context<'_>) {}

    /// Its tools: commands that choose what the left button does in the viewport, until another tool is chosen or Escape
    /// puts it away.
    fn tools(&self) -> Vec<Command> {
        Vec::new()
    }

    /// Called in every frame while a tool of [`Plugin::tools`] is chosen.
    fn use_tool(&mut self, _tool: &str, _hand: &Hand<'_>, _studio: &mut Context<'_>) {}

    /// Paints over the garment; called in every frame that is drawn.
    fn overlay(&mut self, _painter: &egui::Painter, _view: &ViewportView<'_>, _studio: &mut Context<'_>) {}

    /// What lies over the cloth; asked for in every frame. Of several plugins' the first one's is shown.
    fn cover(&self) -> Option<Arc<Cover>> {
        None
    }

    /// Its shading modes.
    fn shading_modes(&self) -> Vec<ShadingChoice> {
        Vec::new()
    }

    /// Its panes.
    fn panes(&self) -> Vec<Pane> {
        Vec::new()
    }

    /// Draws a pane of [`Plugin::panes`].
    fn show(&mut self, _pane: &str, _ui: &mut egui::Ui, _studio: &mut Context<'_>) {}

    /// What it takes in.
    fn importers(&self) -> Vec<Importer> {
        Vec::new()
    }

    /// Takes in a file with one of the suffixes of [`Plugin::importers`].
    fn import(&mut self, _file: &Path, _studio: &mut Context<'_>) {}

    /// The person has chosen the file that was asked for by [`Context::ask_where`] or [`Context::ask_which`]; `what` is the question's id. It need not
    /// be there yet; the dialog has asked whether one that is may be replaced.
    fn chosen(&mut self, _what: &str, _file: &Path, _studio: &mut Context<'_>) {}

    /// Called once a frame, before anything is drawn: to take in what jobs have made.
    fn update(&mut self, _studio: &mut Context<'_>) {}

    /// What is to be kept with the person's settings.
    fn settings(&self) -> Option<Value> {
        None
    }

    /// Takes back what [`Plugin::settings`] gave, perhaps in another version.
    ///
    /// # Errors
    /// It makes no sense; the plugin then goes on with its defaults.
    fn restore(&mut self, _settings: Value) -> amc_core::Result<()> {
        Ok(())
    }
}
