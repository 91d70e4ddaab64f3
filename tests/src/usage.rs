//! What a process uses, from Linux' `/proc`.

/// What a process has used so far.
#[derive(Debug, Clone, Copy)]
pub struct Usage {
    /// Processor time of all its threads.
    pub seconds: f64,
    /// How often its first thread, the interface's, gave up the processor: once for each time it was woken.
    pub switches: u64,
    /// Resident memory.
    pub megabytes: f64,
}

impl Usage {
    /// Of a process that runs.
    ///
    /// # Panics
    /// There is no such process, or the system is not Linux.
    pub fn of(process: u32) -> Self {
        let read = |file: String| std::fs::read_to_string(file).expect("/proc, as Linux has it");
        let stat = read(format!("/proc/{process}/stat"));
        // Behind the name, which may hold anything: fields 14 and 15, in hundredths of a second.
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
        let ticks = |field: usize| fields[field - 3].parse::<f64>().expect("a number");
        let status = read(format!("/proc/{process}/task/{process}/status"));
        let of = |name: &str| {
            let line = status.lines().find_map(|line| line.strip_prefix(name)).expect("a known line");
            line.trim_start_matches(':').split_whitespace().next().and_then(|word| word.parse::<u64>().ok())
        };
        Self {
            seconds: (ticks(14) + ticks(15)) / 100.0,
            switches: of("voluntary_ctxt_switches").expect("a number"),
            megabytes: of("VmRSS").expect("a number") as f64 / 1024.0,
        }
    }
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests {
    use super::*;

    #[test]
    fn work_takes_processor_time_and_sleep_is_counted() {
        let before = Usage::of(std::process::id());
        let start = std::time::Instant::now();
        while start.elapsed().as_millis() < 100 {
            std::hint::spin_loop();
        }
        let after = Usage::of(std::process::id());
        // Beside others it may get less of the time than it took.
        assert!(after.seconds >= before.seconds + 0.01 && after.megabytes > 1.0);
    }
}
