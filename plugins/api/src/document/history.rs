//! A project with its history.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use amc_core::Result;

use super::{Edit, Project, ViewSettings};

/// One act of the person that makes many edits: a drag, a word typed. They are one step of the undo.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Gesture(u64);

impl Gesture {
    /// A new one, unlike all others.
    pub fn begin() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// The project as it was at one moment, for work on another thread.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// The project.
    pub project: Arc<Project>,
    state: u64,
}

/// A project that changes only through [`Edit`]s, with undo and redo.
///
/// There is no limit on the number of steps, but one on their memory: [`Document::HISTORY_BYTES`]. The oldest steps go
/// first, and the newest always stays.
///
/// How the garment is looked at is saved with the project, but turning it is no step, is not undone, and is not counted
/// as a change that must be saved.
#[derive(Debug)]
pub struct Document {
    /// With the view as it is now; those in the history hold outdated ones.
    project: Arc<Project>,
    /// What the first step started from.
    origin: State,
    steps: VecDeque<Step>,
    /// How many of the steps are done.
    position: usize,
    /// What all that is kept takes, bytes.
    bytes: usize,
    limit: usize,
    open: Option<OpenGesture>,
    revision: u64,
    /// The state that is in the file; none: none is.
    saved: Option<u64>,
}

/// A project at one place of the history.
#[derive(Debug, Clone)]
struct State {
    project: Arc<Project>,
    /// No two states of a process have the same, so that a save that ends late marks no other document.
    id: u64,
    bytes: usize,
}

/// What was done, and what it led to.
#[derive(Debug)]
struct Step {
    name: String,
    after: State,
}

/// The gesture that goes on.
#[derive(Debug, Clone, Copy)]
struct OpenGesture {
    gesture: Gesture,
    /// Whether the last step is its.
    has_step: bool,
    /// The first panel's angle at its start, radians, where it turns panels.
    start: Option<f32>,
}

impl Document {
    /// The most memory that the history may take, bytes: 64 MiB. A project of 40 panels takes about 10 KB a step.
    pub const HISTORY_BYTES: usize = 64 << 20;

    /// A document without history, as if just saved. [`Document::mark_unsaved`] says otherwise.
    pub fn new(project: Project) -> Self {
        let project = Arc::new(project);
        let id = next_number();
        let origin = State { bytes: project.bytes(), project: project.clone(), id };
        Self {
            project,
            bytes: origin.bytes,
            origin,
            steps: VecDeque::new(),
            position: 0,
            limit: Self::HISTORY_BYTES,
            open: None,
            revision: id,
            saved: Some(id),
        }
    }

    /// The same with another limit on the memory of its history.
    #[cfg(test)]
    pub(super) fn with_limit(self, limit: usize) -> Self {
        Self { limit, ..self }
    }

    /// The project as it is now.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// The project as it is now, to be kept: costs next to nothing.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot { project: self.project.clone(), state: self.state().id }
    }

    /// Does `edit`. Edits of one gesture that follow each other are one step. One that changes nothing makes no step.
    ///
    /// # Errors
    /// The edit speaks of what is not there, or would break what must be true of a project ([`Project::check`]); then
    /// nothing has changed.
    pub fn submit(&mut self, edit: Edit, gesture: Option<Gesture>) -> Result<()> {
        let goes_on = self.open.filter(|open| Some(open.gesture) == gesture);
        let start = goes_on.map_or_else(|| edit.turned_from(), |open| open.start);
        let name = edit.name_in_drag(&self.project, start);
        let mut project = Project::clone(&self.project);
        edit.apply(&mut project)?;
        project.check()?;
        let has_step = goes_on.is_some_and(|open| open.has_step);
        self.open = gesture.map(|gesture| OpenGesture { gesture, has_step, start });
        if project == *self.project {
            return Ok(());
        }
        self.forget_undone();
        if has_step {
            self.forget_last();
        }
        // A drag that came back to where it began leaves no step.
        let is_back = has_step && is_same_but_view(&project, &self.state().project);
        if !is_back {
            self.push(name, Arc::new(project));
        }
        if let Some(open) = &mut self.open {
            open.has_step = !is_back;
        }
        self.show_state();
        Ok(())
    }

    /// Undoes the last step; its name. None: there is none.
    pub fn undo(&mut self) -> Option<String> {
        let name = self.undo_name()?.to_owned();
        self.go_to(self.position - 1);
        Some(name)
    }

    /// Does the next undone step again; its name. None: there is none.
    pub fn redo(&mut self) -> Option<String> {
        let name = self.redo_name()?.to_owned();
        self.go_to(self.position + 1);
        Some(name)
    }

    /// The name of the step that an undo would undo.
    pub fn undo_name(&self) -> Option<&str> {
        let step = self.steps.get(self.position.checked_sub(1)?)?;
        Some(&step.name)
    }

    /// The name of the step that a redo would do.
    pub fn redo_name(&self) -> Option<&str> {
        self.steps.get(self.position).map(|step| step.name.as_str())
    }

    /// The names of all steps that are kept, oldest first; those from [`Document::position`] on are undone.
    pub fn steps(&self) -> impl Iterator<Item = &str> {
        self.steps.iter().map(|step| step.name.as_str())
    }

    /// How many of the kept steps are done.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Undoes or redoes until `position` steps are done, or all there are.
    pub fn go_to(&mut self, position: usize) {
        let position = position.min(self.steps.len());
        self.open = None;
        if position != self.position {
            self.position = position;
            self.show_state();
        }
    }

    /// Rises with every change of the project but the view's. No two documents of a process ever have the same.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Looks at the garment in another way. No step, no unsaved change, no new revision; saved with the project. One that
    /// makes no sense ([`ViewSettings::check`]) is not taken.
    pub fn set_view(&mut self, view: ViewSettings) {
        match view.check() {
            Ok(()) => self.replace_view(view),
            Err(error) => log::warn!("the view is not taken: {error}"),
        }
    }

    fn replace_view(&mut self, view: ViewSettings) {
        if self.project.view != view {
            Arc::make_mut(&mut self.project).view = view;
        }
    }

    /// Whether there is something to save.
    pub fn is_changed(&self) -> bool {
        self.saved != Some(self.state().id)
    }

    /// Says that the project as it is now is in its file.
    pub fn mark_saved(&mut self) {
        self.saved = Some(self.state().id);
    }

    /// Says that `snapshot` is in its file; what was done since is still to be saved.
    pub fn mark_snapshot_saved(&mut self, snapshot: &Snapshot) {
        self.saved = Some(snapshot.state);
    }

    /// Says that the project is in no file: a new one with content, one that was recovered or brought from an older
    /// version.
    pub fn mark_unsaved(&mut self) {
        self.saved = None;
    }

    /// About how much memory the history takes, bytes.
    pub fn history_bytes(&self) -> usize {
        self.bytes
    }

    fn state(&self) -> &State {
        match self.position.checked_sub(1).and_then(|last| self.steps.get(last)) {
            Some(step) => &step.after,
            None => &self.origin,
        }
    }

    /// Makes the state at the position what is shown, in the view of now.
    fn show_state(&mut self) {
        let view = self.project.view.clone();
        self.project = self.state().project.clone();
        self.replace_view(view);
        self.revision = next_number();
    }

    fn push(&mut self, name: String, project: Arc<Project>) {
        let bytes = project.bytes() + size_of::<Step>() + name.len();
        self.bytes += bytes;
        self.steps.push_back(Step { name, after: State { project, id: next_number(), bytes } });
        self.position = self.steps.len();
        while self.bytes > self.limit && self.steps.len() > 1 {
            let Some(oldest) = self.steps.pop_front() else { break };
            self.bytes -= self.origin.bytes;
            self.origin = oldest.after;
            self.position -= 1;
        }
    }

    fn forget_undone(&mut self) {
        while self.steps.len() > self.position {
            self.forget_last();
        }
    }

    fn forget_last(&mut self) {
        if let Some(step) = self.steps.pop_back() {
            self.bytes -= step.after.bytes;
            self.position = self.position.min(self.steps.len());
        }
    }
}

/// Larger than all before it in this process.
fn next_number() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

fn is_same_but_view(a: &Project, b: &Project) -> bool {
    let Project { garment, unit, fabrics, panels, arrangement, groups, colourways, plugins, view: _, notes } =
        a;
    (garment, unit, fabrics, panels, plugins, notes)
        == (&b.garment, &b.unit, &b.fabrics, &b.panels, &b.plugins, &b.notes)
        && (arrangement, groups, colourways) == (&b.arrangement, &b.groups, &b.colourways)
}
