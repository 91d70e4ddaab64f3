//! What is seen over the cloth, in the window: chosen, made in jobs, shown on the pattern and on the garment.

mod choice;
mod legend;
mod textures;

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::mesh::{Garment, Panel};
use egui::{Key, KeyboardShortcut, Modifiers};
use serde_json::Value;
use studio_plugin::document::Project;
use studio_plugin::{Command, Context, Cover, Job};

use self::textures::Textures;
use crate::grain;
use crate::seeing::{Asked, Cut, Seen, Settings, Show, seen};
use crate::texts;

/// What is shown, and what was made of it.
#[derive(Debug, Default)]
pub(crate) struct SeeingView {
    show: Option<Show>,
    /// What was shown before it was hidden.
    last: Option<Show>,
    settings: Settings,
    job: Option<Job<Seen>>,
    /// What was last asked for.
    asked: Option<Asked>,
    seen: Option<Arc<Seen>>,
    cover: Option<Arc<Cover>>,
    textures: Textures,
    /// What the legend says, of these panels.
    told: Option<(BTreeSet<String>, legend::Told)>,
}

/// Shows what was shown last, or hides it.
const TOGGLE: Command = Command {
    id: "show-toggle",
    name: texts::SHOW_TOGGLE,
    tooltip: texts::SHOW_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, Key::W)),
};

const fn showing(id: &'static str, name: &'static str) -> Command {
    Command { id, name, tooltip: texts::SHOW_TIP, shortcut: None }
}

/// In the order of [`Show::ALL`], after the first two.
const COMMANDS: [Command; 11] = [
    TOGGLE,
    showing("show-nothing", texts::SHOW_NOTHING),
    showing("show-arrows", texts::SHOW_ARROWS),
    showing("show-streamlines", texts::SHOW_STREAMLINES),
    showing("show-lines", texts::SHOW_LINES),
    showing("show-weave", texts::SHOW_WEAVE),
    showing("show-checker", texts::SHOW_CHECKER),
    showing("show-stretch-warp", texts::SHOW_WARP_STRETCH),
    showing("show-stretch-weft", texts::SHOW_WEFT_STRETCH),
    showing("show-shear", texts::SHOW_SHEAR),
    showing("show-gradient-yarn", texts::SHOW_GRADIENT_YARN),
];

impl SeeingView {
    pub(crate) fn commands() -> impl Iterator<Item = Command> {
        COMMANDS.into_iter()
    }

    /// Runs a command, if it is one of these.
    pub(crate) fn run(&mut self, command: &str) -> bool {
        match COMMANDS.iter().position(|known| known.id == command) {
            Some(0) if self.show.is_some() => self.choose(None),
            Some(0) => self.choose(self.last.or(Some(Show::Lines))),
            Some(1) => self.choose(None),
            Some(place) => self.choose(Show::ALL.get(place - 2).copied()),
            None => return false,
        }
        true
    }

    fn choose(&mut self, show: Option<Show>) {
        if self.show.is_some() {
            self.last = self.show;
        }
        self.show = show;
    }

    /// What is kept with the person's settings.
    pub(crate) fn kept(&self) -> Value {
        serde_json::to_value(self.settings).unwrap_or_default()
    }

    /// Takes it back.
    ///
    /// # Errors
    /// It makes no sense.
    pub(crate) fn restore(&mut self, kept: Value) -> amc_core::Result<()> {
        let settings: Settings =
            serde_json::from_value(kept).map_err(|error| amc_core::Error::malformed(error.to_string()))?;
        self.settings = Settings { weave: settings.weave.within_bounds(), ..settings };
        Ok(())
    }

    /// Asks for what is to be seen, where it is not yet; to be called when it is about to be shown.
    pub(crate) fn ask(&mut self, studio: &mut Context<'_>) {
        let directions = studio.stage.directions.as_ref();
        let wanted = self.show.zip(directions).map(|(show, directions)| Asked {
            garment: Arc::clone(&directions.garment),
            vectors: Arc::clone(&directions.vectors),
            cuts: cuts(&directions.garment, studio.document.project()),
            show,
            settings: self.settings,
        });
        let Some(wanted) = wanted else {
            if self.asked.is_some() {
                *self = Self { show: self.show, last: self.last, settings: self.settings, ..Self::default() };
            }
            return;
        };
        if self.asked.as_ref() == Some(&wanted) {
            return;
        }
        // A direction that is being turned is shown as often as there is time for it; another choice does not wait.
        let is_other_choice = self.asked.as_ref().is_none_or(|asked| {
            asked.show != wanted.show
                || asked.settings != wanted.settings
                || !Arc::ptr_eq(&asked.garment, &wanted.garment)
        });
        if self.job.is_some() && !is_other_choice {
            return;
        }
        self.asked = Some(wanted.clone());
        let before = self.seen.clone();
        let work = move |progress: &amc_core::Progress<'_>| seen(&wanted, before.as_deref(), progress);
        self.job = Some(studio.jobs.start(texts::DRAWING_CLOTH, work));
    }

    /// Takes in what was made.
    pub(crate) fn take(&mut self, studio: &mut Context<'_>) {
        let Some(result) = self.job.as_ref().and_then(Job::poll) else { return };
        self.job = None;
        match result {
            Ok(seen) => {
                if seen.panels.iter().all(Option::is_none) {
                    studio.notices.note(texts::NOTHING_TO_SHOW);
                }
                self.cover = Some(Arc::new(Cover {
                    garment: Arc::clone(&seen.garment),
                    panels: seen.panels.iter().map(|panel| Some(panel.as_ref()?.laid.clone())).collect(),
                }));
                self.textures.keep_only(&seen);
                self.seen = Some(Arc::new(seen));
                self.told = None;
            }
            Err(error) => {
                if error.kind() != amc_core::ErrorKind::Cancelled {
                    studio.notices.failed(error);
                }
                self.show = None;
            }
        }
    }

    /// What lies over the garment.
    pub(crate) fn cover(&self) -> Option<Arc<Cover>> {
        let has_pictures = |seen: &&Arc<Seen>| seen.panels.iter().any(Option::is_some);
        self.seen.as_ref().filter(has_pictures)?;
        self.cover.clone().filter(|_| self.show.is_some())
    }

    /// What is seen of this garment.
    fn seen_of(&self, garment: &Arc<Garment>) -> Option<&Arc<Seen>> {
        self.seen.as_ref().filter(|seen| self.show.is_some() && Arc::ptr_eq(&seen.garment, garment))
    }
}

/// How all panels are cut.
fn cuts(garment: &Garment, project: &Project) -> Vec<Cut> {
    let cut = |panel: &Panel| Cut {
        direction: grain::direction(panel, project),
        is_combed: project.comb(&panel.id).is_some(),
    };
    garment.panels.iter().map(cut).collect()
}
