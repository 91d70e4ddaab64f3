//! Unsaved work, kept on the disk by a thread of its own.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use amc_core::{Error, Result};
use studio_plugin::document::{Document, Project};

use super::recovery::Session;
use super::{Disk, Recoverable, Unknown};

/// Keeps the unsaved work of one window in a recovery file.
///
/// Its calls never wait for the disk. Work is kept at once, and after that at most once in [`Autosave::INTERVAL`]; so a
/// crash loses the work of that time and of one write, never more. When it is dropped without [`Autosave::finish`], what is
/// unsaved stays on the disk and is offered again.
pub struct Autosave {
    shared: Arc<Shared>,
    /// What it was told last: revision, whether there is something to save.
    followed: Option<(u64, bool)>,
    thread: Option<JoinHandle<()>>,
}

impl fmt::Debug for Autosave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Autosave").finish_non_exhaustive()
    }
}

#[derive(Debug, Default)]
struct Shared {
    wanted: Mutex<Wanted>,
    changed: Condvar,
}

/// What the thread is to do, and what came of it.
#[derive(Debug, Default)]
struct Wanted {
    /// The latest work; what it takes the place of need not be kept any more.
    next: Next,
    adopted: Vec<Recoverable>,
    must_end: bool,
    trouble: Option<Error>,
    kept: Option<Arc<Project>>,
}

#[derive(Debug, Default)]
enum Next {
    #[default]
    Nothing,
    Keep(Work),
    Forget,
}

#[derive(Debug)]
struct Work {
    project: Arc<Project>,
    unknown: Arc<Unknown>,
    belongs_to: Option<PathBuf>,
}

impl Shared {
    /// Nobody panics while holding it, so what it guards is whole.
    fn lock(&self) -> MutexGuard<'_, Wanted> {
        self.wanted.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Autosave {
    /// The shortest time between two writes.
    pub const INTERVAL: Duration = Duration::from_secs(5);

    /// Starts to watch over one window; `folder` is where recovery files are kept, the same for all windows.
    ///
    /// # Errors
    /// The folder cannot be made or written, locks do not work there, or no thread can be had: the person is to be told
    /// that unsaved work is not kept.
    pub fn start(folder: &Path, disk: Arc<dyn Disk>) -> Result<Self> {
        Self::start_every(Self::INTERVAL, folder, disk)
    }

    /// The same with another shortest time between two writes.
    ///
    /// # Errors
    /// As [`Autosave::start`].
    pub fn start_every(interval: Duration, folder: &Path, disk: Arc<dyn Disk>) -> Result<Self> {
        let session = Session::begin(folder)?;
        let shared = Arc::new(Shared::default());
        let keeper = Keeper { session, disk, interval, shared: Arc::clone(&shared) };
        let thread = std::thread::Builder::new()
            .name("autosave".to_owned())
            .spawn(move || keeper.run())
            .map_err(|error| Error::io("cannot start the thread that keeps unsaved work", error))?;
        Ok(Self { shared, followed: None, thread: Some(thread) })
    }

    /// Keeps `document`, or forgets it where there is nothing to save. To be called once a frame: it does something only
    /// when something has changed. `belongs_to` is the file it was opened from or saved to.
    pub fn follow(&mut self, document: &Document, unknown: &Arc<Unknown>, belongs_to: Option<&Path>) {
        let now = Some((document.revision(), document.is_changed()));
        if self.followed == now {
            return;
        }
        self.followed = now;
        match document.is_changed() {
            true => self.keep(document.snapshot().project, Arc::clone(unknown), belongs_to),
            false => self.forget(),
        }
    }

    /// Says that `project` is not saved. `belongs_to` is the file it was opened from or saved to.
    pub fn keep(&self, project: Arc<Project>, unknown: Arc<Unknown>, belongs_to: Option<&Path>) {
        let belongs_to = belongs_to.map(Path::to_owned);
        self.tell(|wanted| wanted.next = Next::Keep(Work { project, unknown, belongs_to }));
    }

    /// Says that nothing is unsaved: it was saved, or undone, or discarded. Not to be called when a save has failed.
    pub fn forget(&self) {
        self.tell(|wanted| wanted.next = Next::Forget);
    }

    /// Takes over recovered work that is open in this window now: what the dead session left is removed once this session
    /// has kept the same, or has forgotten it.
    pub fn adopt(&self, recoverable: Recoverable, belongs_to: Option<&Path>) {
        let project = Arc::new(recoverable.read.project.clone());
        let unknown = Arc::new(recoverable.read.unknown.clone());
        let belongs_to = belongs_to.map(Path::to_owned);
        self.tell(|wanted| {
            wanted.next = Next::Keep(Work { project, unknown, belongs_to });
            wanted.adopted.push(recoverable);
        });
    }

    /// What went wrong since it was last asked: unsaved work is not kept on the disk. It is tried again all the same.
    pub fn trouble(&self) -> Option<Error> {
        self.shared.lock().trouble.take()
    }

    /// What is on the disk now; none: nothing.
    pub fn kept(&self) -> Option<Arc<Project>> {
        self.shared.lock().kept.clone()
    }

    /// Ends cleanly: all is saved or discarded, and nothing stays. Waits for the disk.
    pub fn finish(mut self) {
        self.forget();
        self.end();
    }

    fn tell(&self, change: impl FnOnce(&mut Wanted)) {
        change(&mut self.shared.lock());
        self.shared.changed.notify_one();
    }

    fn end(&mut self) {
        self.tell(|wanted| wanted.must_end = true);
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            log::error!("the thread that keeps unsaved work has failed");
        }
    }
}

impl Drop for Autosave {
    fn drop(&mut self) {
        self.end();
    }
}

/// The thread's own.
struct Keeper {
    session: Session,
    disk: Arc<dyn Disk>,
    interval: Duration,
    shared: Arc<Shared>,
}

impl Keeper {
    fn run(self) {
        let mut last = None;
        loop {
            let (next, adopted, must_end) = self.wait(last);
            if matches!(next, Next::Keep(_)) {
                last = Some(Instant::now());
            }
            self.act(next, adopted);
            if must_end {
                break;
            }
        }
        if let Err(error) = self.session.end(&*self.disk) {
            log::warn!("a lock stays in the recovery folder: {error}");
        }
    }

    /// Waits until there is something to do: to forget or to end at once, to keep when the last time is long enough ago.
    fn wait(&self, last: Option<Instant>) -> (Next, Vec<Recoverable>, bool) {
        let mut wanted = self.shared.lock();
        loop {
            let left =
                last.map_or(Duration::ZERO, |last: Instant| self.interval.saturating_sub(last.elapsed()));
            let is_due = match wanted.next {
                Next::Nothing => false,
                Next::Keep(_) => left.is_zero(),
                Next::Forget => true,
            };
            if is_due || wanted.must_end {
                let next = std::mem::take(&mut wanted.next);
                return (next, std::mem::take(&mut wanted.adopted), wanted.must_end);
            }
            let changed = &self.shared.changed;
            wanted = match wanted.next {
                Next::Keep(_) => changed.wait_timeout(wanted, left).unwrap_or_else(PoisonError::into_inner).0,
                _ => changed.wait(wanted).unwrap_or_else(PoisonError::into_inner),
            };
        }
    }

    fn act(&self, next: Next, adopted: Vec<Recoverable>) {
        let disk = &*self.disk;
        let done = match &next {
            Next::Nothing => return,
            Next::Keep(Work { project, unknown, belongs_to }) => {
                self.session.keep(disk, project, unknown, belongs_to.as_deref())
            }
            Next::Forget => self.session.forget(disk),
        };
        let (discarded, still_adopted) = match &done {
            Ok(()) => (adopted.into_iter().try_for_each(|recoverable| recoverable.discard(disk)), Vec::new()),
            Err(_) => (Ok(()), adopted),
        };
        let mut wanted = self.shared.lock();
        wanted.adopted.extend(still_adopted);
        let trouble = match (done, next) {
            (Ok(()), Next::Keep(work)) => {
                wanted.kept = Some(work.project);
                discarded.err()
            }
            (Ok(()), _) => {
                wanted.kept = None;
                discarded.err()
            }
            (Err(error), Next::Keep(work)) => {
                // To be tried again, unless there is something newer.
                if matches!(wanted.next, Next::Nothing) {
                    wanted.next = Next::Keep(work);
                }
                let what = format!("unsaved work is not kept on the disk, save it yourself: {error}");
                Some(Error::new(error.kind(), what).because(error))
            }
            (Err(error), _) => Some(error),
        };
        wanted.trouble = trouble.or(wanted.trouble.take());
    }
}
