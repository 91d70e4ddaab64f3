//! The full build beside the rig's: size, start, memory, idling. `cargo run -p studio-tests --example builds [-- dist]`
//! builds both with the profile `release` (or `dist`, which takes long), opens each in a display of its own (Xvfb) and
//! prints a table. It needs Linux, Xvfb, and `strip`.

#![allow(clippy::print_stdout, reason = "an example says what it found")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use studio_tests::display::{Display, Window};
use studio_tests::timing::{median, milliseconds};
use studio_tests::usage::Usage;

const STARTS: usize = 5;
const PATIENCE: Duration = Duration::from_secs(120);
/// After the garment was shown, until the last jobs have ended.
const SETTLING: Duration = Duration::from_secs(6);
const IDLING: Duration = Duration::from_secs(10);

/// A build: what it is called, and how cargo is asked for it.
const BUILDS: [(&str, &[&str]); 2] =
    [("full", &[]), ("rig", &["--no-default-features", "--features", "rig"])];

fn main() {
    let profile = std::env::args().nth(1).unwrap_or_else(|| "release".to_owned());
    let folder = tempfile::tempdir().expect("a temporary folder");
    // First built, then measured: building disturbs.
    let programs = BUILDS.map(|(name, features)| (name, build(&profile, name, features, folder.path())));
    println!("| build | program, MB | window, ms | garment, ms | memory, MB | idle, % of a core |");
    println!("|---|---|---|---|---|---|");
    for (name, program) in &programs {
        measure(name, program, folder.path());
    }
}

/// The program without what debuggers read.
fn build(profile: &str, name: &str, features: &[&str], folder: &Path) -> PathBuf {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut build = Command::new(cargo);
    build.args(["build", "-p", "amc-studio", "--profile", profile]).args(features);
    assert!(build.status().is_ok_and(|status| status.success()), "the build '{name}'");
    let here = std::env::current_exe().expect("the system knows this program");
    let targets = here.ancestors().nth(3).expect("examples are built three folders down");
    let program = folder.join(name);
    let strip =
        Command::new("strip").arg("-o").arg(&program).arg(targets.join(profile).join("amc-studio")).status();
    assert!(strip.is_ok_and(|status| status.success()), "strip (Debian: the package binutils)");
    program
}

fn measure(name: &str, program: &Path, folder: &Path) {
    let size = std::fs::metadata(program).expect("it was built").len() as f64 / 1e6;
    let (display, home) = (Display::start(), folder.join(format!("home of {name}")));
    std::fs::create_dir(&home).expect("a folder can be made");
    let none: [&str; 0] = [];
    let start = || {
        let window = Window::open(program, &display, &home, none);
        let times = [window.shown("window", PATIENCE), window.shown("garment", PATIENCE)];
        (window, times)
    };
    // The first start bakes and computes what is kept.
    let first = start().0;
    std::thread::sleep(SETTLING);
    drop(first);
    let times: Vec<[Duration; 2]> = (0..STARTS).map(|_| start().1).collect();
    let [shown, garment] = [0, 1].map(|k| milliseconds(median(times.iter().map(|times| times[k]).collect())));
    let window = start().0;
    std::thread::sleep(SETTLING);
    let before = Usage::of(window.id());
    std::thread::sleep(IDLING);
    let after = Usage::of(window.id());
    let idle = (after.seconds - before.seconds) / IDLING.as_secs_f64() * 100.0;
    println!("| {name} | {size:.1} | {shown:.0} | {garment:.0} | {:.0} | {idle:.2} |", after.megabytes);
}
