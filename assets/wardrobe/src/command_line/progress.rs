//! What the commands say while they work, on standard error.

use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use amc_core::{Progress, Step};

/// A line for a person.
#[allow(clippy::print_stderr, reason = "progress and errors")]
pub(super) fn say(line: &str) {
    eprintln!("{line}");
}

/// Does `work`, saying the stages it comes to and when.
pub(super) fn with_progress<T>(work: impl FnOnce(&Progress<'_>) -> T) -> T {
    let started = Instant::now();
    let cancelled = AtomicBool::new(false);
    let last = Mutex::new(String::new());
    let report = |step: Step<'_>| {
        if let Ok(mut last) = last.lock()
            && *last != step.stage
        {
            step.stage.clone_into(&mut last);
            say(&format!("{:6.1} s  {}", started.elapsed().as_secs_f64(), step.stage));
        }
    };
    work(&Progress::new(&report, &cancelled))
}
