//! Timing, for the benchmarks.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Whether to measure: `cargo bench` says `--bench`. `cargo test --all-targets` runs benchmarks too, unoptimised: there is
/// nothing to measure there.
pub fn is_wanted() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// How long some work takes; its result is made, whether it is used or not.
pub fn timed<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    let result = work();
    let time = start.elapsed();
    black_box(result);
    time
}

/// The time in the middle, the later one of two; nothing of nothing.
pub fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// In milliseconds, as benchmarks print it.
pub fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle_whatever_the_order() {
        let times = |all: &[u64]| all.iter().map(|&time| Duration::from_millis(time)).collect::<Vec<_>>();
        assert_eq!(milliseconds(median(times(&[9, 1, 5]))), 5.0);
        assert_eq!(milliseconds(median(times(&[9, 1, 5, 7]))), 7.0);
        assert_eq!(median(Vec::new()), Duration::ZERO);
    }

    #[test]
    fn work_is_done_once_and_takes_its_time() {
        let mut runs = 0;
        let time = timed(|| {
            runs += 1;
            std::thread::sleep(Duration::from_millis(5));
        });
        assert!(runs == 1 && time >= Duration::from_millis(5), "{runs} {time:?}");
    }
}
