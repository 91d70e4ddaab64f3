//! How fast the window is: its start, its idling, a frame's own work, and how long opening a large garment holds it up.
//!
//! The release build is made first and opened in a display of its own (Xvfb), on whatever graphics there is (software
//! Vulkan where these figures come from); a frame's work is measured in this process, without a window, with 512,000
//! triangles in 40 panels. Prints the figures; ends with 1 where one is over its bar.

#![allow(clippy::print_stdout, reason = "a benchmark says what it measured")]

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};

use amc_studio::studio::{App, Studio};
use eframe::egui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use rustix::time::{ClockId, clock_gettime};
use studio_tests::display::{self, Display, Window};
use studio_tests::large_garment;
use studio_tests::timing::{is_wanted, median, milliseconds, timed};
use studio_tests::usage::Usage;

/// From the start of the process to the first frame that shows the bundled project's garment.
const FIRST_FRAME: Duration = Duration::from_millis(1500);
/// The interface's thread in one frame, in processor time.
const FRAME: Duration = Duration::from_millis(4);
/// The longest frame while a garment is opened.
const HELD_UP: Duration = Duration::from_millis(50);
/// Share of one core while nothing happens.
const IDLE: f64 = 0.005;

/// How long idling is watched.
const IDLING: Duration = Duration::from_secs(10);
/// After the garment was shown, until the last jobs have ended.
const SETTLING: Duration = Duration::from_secs(10);
/// How long anything may take before it counts as hung.
const PATIENCE: Duration = Duration::from_secs(600);

const STARTS: usize = 5;
const FRAMES: usize = 120;
/// 5 x 8 panels, 2 x 40 x 80 x 80 triangles.
const PRIMITIVES: usize = 5;
const ISLANDS: usize = 8;
const SIDE: usize = 80;
/// 10 x 10 panels, for the flat pattern.
const PIECES: usize = 10;

/// Where this process is to keep its caches; set for the second of two.
const INSIDE: &str = "--inside";

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    if std::env::args().any(|word| word == INSIDE) {
        return in_this_process();
    }
    let is_started_well = real_window(&release_build());
    // Caches are looked for where the environment says, which a process does not change for itself.
    let caches = tempfile::tempdir().expect("a temporary folder");
    let this = std::env::current_exe().expect("the system knows this program");
    let inside = Command::new(this).args(["--bench", INSIDE]).env("XDG_CACHE_HOME", caches.path()).status();
    let is_fluent = inside.expect("this program starts").success();
    ExitCode::from(u8::from(!(is_started_well && is_fluent)))
}

/// The program as it is handed out, but for what `dist` adds; `AMC_STUDIO` names another.
fn release_build() -> PathBuf {
    if std::env::var_os("AMC_STUDIO").is_none() {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let built = Command::new(cargo).args(["build", "--release", "-p", "amc-studio"]).status();
        assert!(built.is_ok_and(|status| status.success()), "the release build");
    }
    display::program()
}

fn real_window(program: &Path) -> bool {
    let display = Display::start();
    let home = tempfile::tempdir().expect("a temporary folder");
    let none: [&str; 0] = [];
    let start = || {
        let window = Window::open(program, &display, home.path(), none);
        let times = [window.shown("window", PATIENCE), window.shown("garment", PATIENCE)];
        (window, times)
    };
    // The first start bakes the fabric and computes the occlusion; then they are kept.
    let (window, [first, garment]) = start();
    println!(
        "very first start: window {:.0} ms, garment {:.0} ms",
        milliseconds(first),
        milliseconds(garment)
    );
    std::thread::sleep(SETTLING);
    drop(window);
    let times: Vec<[Duration; 2]> = (0..STARTS).map(|_| start().1).collect();
    let of = |which: usize| median(times.iter().map(|times| times[which]).collect());
    let is_soon = report("first frame, the window", of(0), FIRST_FRAME)
        & report("first frame with the garment", of(1), FIRST_FRAME);

    let (window, _) = start();
    std::thread::sleep(SETTLING);
    let before = Usage::of(window.id());
    std::thread::sleep(IDLING);
    let after = Usage::of(window.id());
    let share = (after.seconds - before.seconds) / IDLING.as_secs_f64();
    let woken = after.switches - before.switches;
    println!("idle for {IDLING:?}: {:.3} % of a core, bar {} %", share * 100.0, IDLE * 100.0);
    println!("idle: the interface's thread woken {woken} times, bar 0; memory {:.0} MB", after.megabytes);
    is_soon && share < IDLE && woken == 0
}

/// Prints a figure; whether it is within its bar.
fn report(what: &str, time: Duration, bar: Duration) -> bool {
    let verdict = if time <= bar { "" } else { ": MISSED" };
    println!("{what}: {:.1} ms, bar {} ms{verdict}", milliseconds(time), bar.as_millis());
    time <= bar
}

fn in_this_process() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("large.glb");
    let glb = large_garment::glb(PRIMITIVES, ISLANDS, SIDE);
    amc_core::file::save_bytes(&path, &glb).expect("the file is written");
    let mut harness = window(folder.path());
    let is_never_held_up = opening(&mut harness, &path);
    let is_quick = frames(&mut harness) & turning_one(&mut harness);
    let (path, glb) = (folder.path().join("pieces.glb"), large_garment::glb(PIECES, PIECES, 20));
    amc_core::file::save_bytes(&path, &glb).expect("the file is written");
    harness.state_mut().open(&path);
    settle(&mut harness, |_| {});
    let is_fluent = pattern(&mut harness);
    ExitCode::from(u8::from(!(is_never_held_up && is_quick && is_fluent)))
}

fn window(folder: &Path) -> Harness<'static, App> {
    let studio = Studio::new().keeping_in(folder);
    let [width, height] = display::SIZE.map(f32::from);
    let mut harness = Harness::builder()
        .with_size([width, height])
        .with_max_steps(8)
        .wgpu()
        .build_eframe(move |creation| studio.into_app(creation));
    settle(&mut harness, |_| {});
    harness
}

/// Frames at the pace of a screen, until all is loaded and drawn.
fn settle(harness: &mut Harness<'_, App>, mut each: impl FnMut(Duration)) {
    let start = Instant::now();
    let mut calm = 0;
    while calm < 3 {
        assert!(start.elapsed() < PATIENCE, "the garment is opened");
        each(timed(|| harness.step()));
        calm = if harness.state().is_settled() { calm + 1 } else { 0 };
        std::thread::sleep(Duration::from_millis(16));
    }
}

/// The longest frame while the large garment is opened, beside the jobs that open it.
fn opening(harness: &mut Harness<'_, App>, path: &Path) -> bool {
    let (start, mut times) = (Instant::now(), Vec::new());
    harness.state_mut().open(path);
    settle(harness, |time| times.push(time));
    let whole = start.elapsed();
    times.sort_unstable();
    let longest = times.last().copied().unwrap_or_default();
    println!("opening the garment: {:.1} s, {} frames", whole.as_secs_f64(), times.len());
    report("its longest frame", longest, HELD_UP)
}

/// Frames in which the garment turns under the mouse, the pointer passes over it, and directions change.
fn frames(harness: &mut Harness<'_, App>) -> bool {
    let view = harness.get_by_label("Garment").rect();
    let at = |frame: usize| view.center() + egui::vec2(0.8, 0.5) * frame as f32;
    let mut passing = Vec::new();
    for frame in 0..FRAMES {
        harness.hover_at(at(frame));
        passing.push(own_time(harness));
    }
    harness.drag_at(view.center());
    harness.step();
    let mut turning = Vec::new();
    for frame in 0..FRAMES {
        harness.hover_at(at(frame));
        turning.push(own_time(harness));
    }
    harness.drop_at(at(FRAMES));
    settle(harness, |_| {});
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    settle(harness, |_| {});
    let mut changing = Vec::new();
    for _ in 0..8 {
        harness.key_press(egui::Key::R);
        changing.push(own_time(harness));
        while !harness.state().is_settled() {
            changing.push(own_time(harness));
            std::thread::sleep(Duration::from_millis(2));
        }
    }
    let longest = changing.iter().max().copied().unwrap_or_default();
    println!("the longest frame when all directions change: {:.1} ms", milliseconds(longest));
    report("a frame while the pointer passes over the garment", median(passing), FRAME)
        & report("a frame while the garment turns", median(turning), FRAME)
}

/// Frames in which one of the 40 panels is turned by a key: it is drawn at once, without a job.
fn turning_one(harness: &mut Harness<'_, App>) -> bool {
    harness.key_press(egui::Key::Escape);
    settle(harness, |_| {});
    harness.get_by_label("Garment").click();
    settle(harness, |_| {});
    let turn = |harness: &mut Harness<'_, App>| {
        harness.key_press(egui::Key::CloseBracket);
        let time = own_time(harness);
        let is_turned = harness.state().document().undo_name().is_some_and(|name| name.contains("1 panel"));
        assert!(is_turned && harness.state().is_settled(), "one panel is turned within the frame");
        time
    };
    let times = (0..16).map(|_| turn(harness)).collect();
    report("a frame that turns one panel", median(times), FRAME)
}

/// Frames in which the pointer passes over the flat pattern of 100 panels.
fn pattern(harness: &mut Harness<'_, App>) -> bool {
    let pieces = harness
        .query_all_by(|node| node.label().is_some_and(|label| label.starts_with("Piece ")))
        .map(|node| node.rect())
        .collect::<Vec<_>>();
    assert_eq!(pieces.len(), PIECES * PIECES, "all pieces are in sight");
    let whole = pieces.iter().fold(pieces[0], |whole, rect| whole.union(*rect));
    let mut passing = Vec::new();
    for frame in 0..FRAMES {
        let share = frame as f32 / FRAMES as f32;
        harness.hover_at(whole.lerp_inside(egui::vec2(share, (7.0 * share).fract())));
        passing.push(own_time(harness));
    }
    report("a frame while the pointer passes over 100 flat pieces", median(passing), FRAME)
}

/// One frame's processor time on the interface's thread: the studio, egui, tessellation, and what the thread itself does
/// for the graphics device; not what the driver's threads do.
fn own_time(harness: &mut Harness<'_, App>) -> Duration {
    let start = clock_gettime(ClockId::ThreadCPUTime);
    harness.step();
    let (shapes, scale) = (harness.output().shapes.clone(), harness.output().pixels_per_point);
    std::hint::black_box(harness.ctx.tessellate(shapes, scale));
    let end = clock_gettime(ClockId::ThreadCPUTime);
    let nanoseconds = (end.tv_sec - start.tv_sec) * 1_000_000_000 + (end.tv_nsec - start.tv_nsec);
    Duration::from_nanos(u64::try_from(nanoseconds).unwrap_or_default())
}
