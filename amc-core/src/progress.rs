//! Progress and cancelling of long work.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::{Error, Result};

/// How far a long job has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step<'a> {
    /// What is being done, in plain words: "reading pictures".
    pub stage: &'a str,
    /// How many of `total` are done.
    pub done: usize,
    /// How many there are.
    pub total: usize,
}

/// What a long job reports to and is stopped through. Shared between threads.
#[derive(Clone, Copy)]
pub struct Progress<'a> {
    report: Option<&'a (dyn Fn(Step<'_>) + Sync)>,
    cancelled: Option<&'a AtomicBool>,
}

impl std::fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Progress").field("cancelled", &self.is_cancelled()).finish_non_exhaustive()
    }
}

impl<'a> Progress<'a> {
    /// Reports to `report`; stops soon after `cancelled` turns true.
    pub fn new(report: &'a (dyn Fn(Step<'_>) + Sync), cancelled: &'a AtomicBool) -> Self {
        Self { report: Some(report), cancelled: Some(cancelled) }
    }

    /// Reports to nobody and is never stopped.
    pub fn none() -> Progress<'static> {
        Progress { report: None, cancelled: None }
    }

    /// Tells that `done` of `total` are done.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Cancelled`] when somebody asked to stop.
    pub fn step(&self, stage: &str, done: usize, total: usize) -> Result<()> {
        if self.is_cancelled() {
            return Err(Error::cancelled());
        }
        if let Some(report) = self.report {
            report(Step { stage, done, total });
        }
        Ok(())
    }

    /// Whether somebody asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}
