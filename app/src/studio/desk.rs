//! The project at hand: its file, and what keeps the work safe.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::Result;
use studio_plugin::document::{Document, Project, Snapshot};
use studio_plugin::{Job, Jobs, Notices};

use super::texts::notices as words;
use crate::project::{
    self, Autosave, Claim, Disk, Missing, Opened, ProjectLock, Recoverable, System, Unknown, recent,
};
use crate::storage::Folders;

/// The document, where it belongs, and what watches over it.
#[derive(Debug)]
pub(super) struct Desk {
    pub(super) document: Document,
    /// Where the project is saved; none: nowhere yet.
    pub(super) file: Option<PathBuf>,
    /// What dead sessions left, until somebody has said what to do with it.
    pub(super) recoverable: Vec<Recoverable>,
    /// Files that the project uses and that are not there.
    pub(super) missing: Vec<Missing>,
    /// Projects opened or saved lately, the latest first.
    pub(super) recent: Vec<PathBuf>,
    disk: Arc<dyn Disk>,
    /// Where what is no project is kept; none: the system names no such folders.
    folders: Option<Folders>,
    unknown: Arc<Unknown>,
    lock: Option<ProjectLock>,
    autosave: Option<Autosave>,
    opening: Option<(PathBuf, Job<Opened>)>,
    recovering: Option<(Recoverable, Job<Opened>)>,
    saving: Option<(PathBuf, Snapshot, Job<()>)>,
}

impl Desk {
    /// With the default project. `folders`: where recovery files, locks and settings are kept.
    pub(super) fn new(folders: Option<Folders>, notices: &mut Notices) -> Self {
        let disk: Arc<dyn Disk> = Arc::new(System);
        let mut desk = Self {
            document: Document::new(Project::default()),
            file: None,
            recoverable: Vec::new(),
            missing: Vec::new(),
            recent: Vec::new(),
            disk,
            folders,
            unknown: Arc::default(),
            lock: None,
            autosave: None,
            opening: None,
            recovering: None,
            saving: None,
        };
        match desk.folders.clone() {
            Some(folders) => desk.watch(&folders, notices),
            None => notices.note(words::NO_FOLDERS),
        }
        desk
    }

    fn watch(&mut self, folders: &Folders, notices: &mut Notices) {
        match project::recoverable(self.disk.as_ref(), &folders.recovery) {
            Ok(found) => {
                found.notices.iter().for_each(|notice| notices.note(notice));
                self.recoverable = found.works;
            }
            Err(error) => notices.failed(error),
        }
        match Autosave::start(&folders.recovery, Arc::clone(&self.disk)) {
            Ok(autosave) => self.autosave = Some(autosave),
            Err(error) => notices.failed(words::not_kept(error)),
        }
        let recent = recent::list(self.disk.as_ref(), &folders.settings);
        recent.notice.iter().for_each(|notice| notices.note(notice));
        self.recent = recent.value;
    }

    /// Where settings are kept; none: nowhere.
    pub(super) fn settings_folder(&self) -> Option<&Path> {
        self.folders.as_ref().map(|folders| folders.settings.as_path())
    }

    /// Whether a project is being opened or saved.
    pub(super) fn is_busy(&self) -> bool {
        self.opening.is_some() || self.recovering.is_some() || self.saving.is_some()
    }

    /// Begins anew, with the default project.
    pub(super) fn begin(&mut self) {
        self.replace(Document::new(Project::default()), None, Unknown::default());
    }

    /// Starts to open a project.
    pub(super) fn open(&mut self, path: &Path, jobs: &mut Jobs) {
        let (disk, file) = (Arc::clone(&self.disk), path.to_owned());
        let name = words::opening(path.display());
        let job = jobs.start(name, move |progress| project::open(disk.as_ref(), &file, progress));
        self.opening = Some((path.to_owned(), job));
    }

    /// Starts to save the project to `path`, which is then where it belongs.
    pub(super) fn save(&mut self, path: &Path, jobs: &mut Jobs) {
        let snapshot = self.document.snapshot();
        let (disk, file) = (Arc::clone(&self.disk), path.to_owned());
        let (project, unknown) = (Arc::clone(&snapshot.project), Arc::clone(&self.unknown));
        let job = jobs.start(words::saving(path.display()), move |_| {
            project::save(disk.as_ref(), &file, &project, &unknown)
        });
        self.saving = Some((path.to_owned(), snapshot, job));
    }

    /// Starts to take back what a dead session left.
    pub(super) fn recover(&mut self, index: usize, jobs: &mut Jobs) {
        let work = self.recoverable.remove(index);
        let (disk, read) = (Arc::clone(&self.disk), work.read.clone());
        let folder = work.belongs_to.as_deref().and_then(Path::parent).map(Path::to_owned);
        let job = jobs.start(words::TAKING_BACK, move |progress| {
            Opened::recovered(disk.as_ref(), read, folder.as_deref(), progress)
        });
        self.recovering = Some((work, job));
    }

    fn recovered(&mut self, work: Recoverable, opened: Opened, notices: &mut Notices) {
        opened.notices.iter().for_each(|notice| notices.note(notice));
        let file = work.belongs_to.clone();
        let mut document = Document::new(opened.project);
        document.mark_unsaved();
        self.replace(document, file.clone(), opened.unknown);
        self.missing = opened.missing;
        if let Some(autosave) = &self.autosave {
            autosave.adopt(work, file.as_deref());
        }
        notices.done(words::TAKEN_BACK);
    }

    /// Throws away what a dead session left.
    pub(super) fn discard(&mut self, index: usize, notices: &mut Notices) {
        if let Err(error) = self.recoverable.remove(index).discard(self.disk.as_ref()) {
            notices.failed(error);
        }
    }

    /// Uses `new` wherever the missing `old` was used, and looks beside it for the other missing files.
    pub(super) fn locate(&mut self, old: &Path, new: &Path, notices: &mut Notices) {
        let edits = match project::locate(self.disk.as_ref(), &self.missing, old, new) {
            Ok(edits) => edits,
            Err(error) => return notices.failed(error),
        };
        for edit in edits {
            if let Err(error) = self.document.submit(edit, None) {
                notices.failed(error);
            }
        }
        let used: Vec<PathBuf> =
            self.document.project().assets().filter_map(|asset| asset.path()).map(Path::to_owned).collect();
        self.missing
            .retain(|missing| missing.asset.path().is_some_and(|path| used.iter().any(|it| it == path)));
    }

    /// Takes in what was opened and saved, and tells the autosave of changes. To be called once a frame.
    pub(super) fn update(&mut self, notices: &mut Notices) {
        if let Some((path, result)) =
            self.opening.as_ref().and_then(|(path, job)| Some((path.clone(), job.poll()?)))
        {
            self.opening = None;
            match result {
                Ok(opened) => self.opened(path, opened, notices),
                Err(error) => notices.failed(error),
            }
        }
        if let Some(result) = self.recovering.as_ref().and_then(|(_, job)| job.poll())
            && let Some((work, _)) = self.recovering.take()
        {
            match result {
                Ok(opened) => self.recovered(work, opened, notices),
                Err(error) => {
                    notices.failed(error);
                    self.recoverable.push(work);
                }
            }
        }
        let saved = self
            .saving
            .as_ref()
            .and_then(|(path, snapshot, job)| Some((path.clone(), snapshot.clone(), job.poll()?)));
        if let Some((path, snapshot, result)) = saved {
            self.saving = None;
            match result {
                Ok(()) => {
                    self.document.mark_snapshot_saved(&snapshot);
                    notices.done(words::saved(path.display()));
                    self.belongs_to(Some(path), notices);
                }
                Err(error) => notices.failed(error),
            }
        }
        if let Some(autosave) = &mut self.autosave {
            autosave.follow(&self.document, &self.unknown, self.file.as_deref());
            if let Some(trouble) = autosave.trouble() {
                notices.failed(trouble);
            }
        }
    }

    /// Ends cleanly: whatever is unsaved is not wanted.
    pub(super) fn finish(&mut self) {
        if let Some(autosave) = self.autosave.take() {
            autosave.finish();
        }
    }

    fn opened(&mut self, path: PathBuf, opened: Opened, notices: &mut Notices) {
        opened.notices.iter().for_each(|notice| notices.note(notice));
        let mut document = Document::new(opened.project);
        document.mark_saved();
        if opened.is_changed {
            document.mark_unsaved();
        }
        self.replace(document, None, opened.unknown);
        self.missing = opened.missing;
        self.belongs_to(Some(path), notices);
    }

    fn replace(&mut self, document: Document, file: Option<PathBuf>, unknown: Unknown) {
        self.document = document;
        self.file = file;
        self.unknown = Arc::new(unknown);
        self.lock = None;
        self.missing.clear();
    }

    /// Claims the project's file, and remembers it.
    fn belongs_to(&mut self, file: Option<PathBuf>, notices: &mut Notices) {
        let same = self.lock.is_some() && self.file == file;
        self.file = file;
        let (Some(file), Some(folders)) = (&self.file, &self.folders) else { return };
        if !same {
            // Let go first: it may be the same file by another name.
            self.lock = None;
            match ProjectLock::claim(&folders.locks, file) {
                Ok(Claim::Ours(lock)) => self.lock = Some(lock),
                Ok(Claim::Theirs { process }) => notices.failed(words::already_open(file.display(), process)),
                Err(error) => notices.note(words::not_told(error)),
            }
        }
        let remembered: Result<()> = recent::add(self.disk.as_ref(), &folders.settings, file);
        if let Err(error) = remembered {
            notices.failed(error);
        }
        self.recent = recent::list(self.disk.as_ref(), &folders.settings).value;
    }
}
