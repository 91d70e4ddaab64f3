//! Progress of long jobs on standard error, where that is a terminal.

use std::io::{IsTerminal as _, Write as _};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use amc_core::{Progress, Result, Step};

/// How often the line is drawn again.
const INTERVAL: Duration = Duration::from_millis(100);

/// Runs `job` with its progress shown as one line that is wiped at the end. The job is stopped by the terminal's own
/// interrupt, which is safe at every instant because saves are whole.
pub(super) fn with_progress<T>(job: impl FnOnce(&Progress<'_>) -> Result<T>) -> Result<T> {
    if !std::io::stderr().is_terminal() {
        return job(&Progress::none());
    }
    let drawn = Mutex::new(Instant::now());
    let report = |step: Step<'_>| {
        let Ok(mut drawn) = drawn.try_lock() else { return };
        if drawn.elapsed() >= INTERVAL {
            *drawn = Instant::now();
            write!(std::io::stderr(), "\r\x1b[K{}: {} of {}", step.stage, step.done, step.total).ok();
        }
    };
    let never = AtomicBool::new(false);
    let result = job(&Progress::new(&report, &never));
    write!(std::io::stderr(), "\r\x1b[K").ok();
    result
}
