//! Work that takes longer than a frame: on threads of its own, with progress and cancel.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex};

use amc_core::{Error, Progress, Result};

/// Starts jobs and knows those that run.
pub struct Jobs {
    running: Vec<Arc<Shared>>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl std::fmt::Debug for Jobs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Jobs").field("running", &self.running.len()).finish_non_exhaustive()
    }
}

/// A job somebody waits for. Dropped, it is cancelled: nobody wants its result any more.
#[derive(Debug)]
pub struct Job<T> {
    shared: Arc<Shared>,
    result: Receiver<Result<T>>,
}

/// A running job as a person sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobView {
    /// What is being done: "Opening shirt.glb".
    pub name: String,
    /// Which part of it.
    pub stage: String,
    /// How far that part is, 0 to 1; none: not known.
    pub share: Option<f32>,
}

#[derive(Debug)]
struct Shared {
    name: String,
    cancelled: AtomicBool,
    ended: AtomicBool,
    step: Mutex<(String, usize, usize)>,
}

impl Jobs {
    /// `wake` is called, from any thread, whenever there is something new to show.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { running: Vec::new(), wake: Arc::new(wake) }
    }

    /// Starts `work` on a thread called `name`. A panic in it is caught and becomes the job's error.
    pub fn start<T: Send + 'static>(
        &mut self,
        name: impl Into<String>,
        work: impl FnOnce(&Progress<'_>) -> Result<T> + Send + 'static,
    ) -> Job<T> {
        let shared = Arc::new(Shared {
            name: name.into(),
            cancelled: AtomicBool::new(false),
            ended: AtomicBool::new(false),
            step: Mutex::default(),
        });
        let (send, result) = sync_channel(1);
        let (inside, wake) = (Arc::clone(&shared), Arc::clone(&self.wake));
        let refused = send.clone();
        let run = move || {
            let report = |step: amc_core::Step<'_>| {
                if let Ok(mut current) = inside.step.lock() {
                    let new_stage = current.0 != step.stage;
                    let percent = |done: usize| done * 100 / step.total.max(1);
                    let shown = new_stage || percent(current.1) != percent(step.done);
                    if new_stage {
                        step.stage.clone_into(&mut current.0);
                    }
                    (current.1, current.2) = (step.done, step.total);
                    if shown {
                        wake();
                    }
                }
            };
            let progress = Progress::new(&report, &inside.cancelled);
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&progress)))
                .unwrap_or_else(|panic| Err(broke_off(&inside.name, panic.as_ref())));
            // The receiver is gone where nobody wants the result.
            send.send(outcome).ok();
            inside.ended.store(true, Ordering::Release);
            wake();
        };
        let thread = std::thread::Builder::new().name(shared.name.clone()).spawn(run);
        if let Err(error) = thread {
            refused.send(Err(Error::io("cannot start a thread", error))).ok();
            shared.ended.store(true, Ordering::Release);
        }
        self.running.retain(|job| !job.ended.load(Ordering::Acquire));
        self.running.push(Arc::clone(&shared));
        Job { shared, result }
    }

    /// The jobs that run, oldest first.
    pub fn views(&self) -> Vec<JobView> {
        self.alive().map(|job| job.view()).collect()
    }

    /// Whether none runs.
    pub fn is_idle(&self) -> bool {
        self.alive().next().is_none()
    }

    /// Cancels the `index`-th of [`Jobs::views`].
    pub fn cancel(&self, index: usize) {
        if let Some(job) = self.alive().nth(index) {
            job.cancelled.store(true, Ordering::Relaxed);
        }
    }

    fn alive(&self) -> impl Iterator<Item = &Arc<Shared>> {
        self.running.iter().filter(|job| !job.ended.load(Ordering::Acquire))
    }
}

impl Shared {
    fn view(&self) -> JobView {
        let (stage, done, total) = self.step.lock().map_or_else(|_| Default::default(), |step| step.clone());
        JobView {
            name: self.name.clone(),
            stage,
            share: (total > 0).then(|| (done as f32 / total as f32).clamp(0.0, 1.0)),
        }
    }
}

impl<T> Job<T> {
    /// Its result, once, when it is there.
    pub fn poll(&self) -> Option<Result<T>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            // It ended and its result was taken.
            Err(TryRecvError::Disconnected) => None,
        }
    }

    /// Asks it to stop; its result is then [`amc_core::ErrorKind::Cancelled`].
    pub fn cancel(&self) {
        self.shared.cancelled.store(true, Ordering::Relaxed);
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn broke_off(name: &str, panic: &(dyn std::any::Any + Send)) -> Error {
    let why = panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "of a fault in the program".to_owned());
    Error::invalid(format!("'{name}' broke off: {why}; please report it"))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    /// Jobs, and what is told when there is something new.
    fn jobs() -> (Jobs, Receiver<()>) {
        let (send, woken) = channel();
        (Jobs::new(move || send.send(()).unwrap_or_default()), woken)
    }

    fn wait<T>(job: &Job<T>, woken: &Receiver<()>) -> Result<T> {
        loop {
            if let Some(result) = job.poll() {
                return result;
            }
            woken.recv_timeout(std::time::Duration::from_secs(60)).unwrap();
        }
    }

    #[test]
    fn a_job_reports_and_ends() {
        let (mut jobs, woken) = jobs();
        let (go, wait_for_go) = channel::<()>();
        let job = jobs.start("counting", move |progress| {
            progress.step("first half", 1, 2)?;
            wait_for_go.recv().unwrap();
            Ok(7)
        });
        woken.recv().unwrap();
        let expected = JobView { name: "counting".into(), stage: "first half".into(), share: Some(0.5) };
        assert_eq!(jobs.views(), [expected]);
        go.send(()).unwrap();
        assert_eq!(wait(&job, &woken).unwrap(), 7);
        assert!(job.poll().is_none());
        // It ends a moment after its result is there.
        while !jobs.is_idle() {
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_job_is_cancelled_by_hand_and_when_nobody_waits() {
        for by_hand in [true, false] {
            let (mut jobs, woken) = jobs();
            let (tell, told) = channel();
            let job: Job<()> = jobs.start("waiting", move |progress| {
                loop {
                    if let Err(error) = progress.step("waiting", 0, 1) {
                        tell.send(error.kind()).unwrap();
                        return Err(error);
                    }
                    std::thread::yield_now();
                }
            });
            if by_hand {
                jobs.cancel(0);
                assert_eq!(wait(&job, &woken).unwrap_err().kind(), amc_core::ErrorKind::Cancelled);
            } else {
                drop(job);
            }
            let kind = told.recv_timeout(std::time::Duration::from_secs(60)).unwrap();
            assert_eq!(kind, amc_core::ErrorKind::Cancelled);
        }
    }

    #[test]
    fn a_panic_is_an_error_that_names_the_job() {
        let (mut jobs, woken) = jobs();
        let job: Job<()> = jobs.start("dividing", |_| panic!("by zero"));
        let message = wait(&job, &woken).unwrap_err().to_string();
        assert!(message.contains("'dividing'") && message.contains("by zero"), "{message}");
    }
}
