//! A journey through the real program in a real window: opened by argument, driven by keyboard and mouse, seen in pixels.
//!
//! It needs Xvfb and is run by `tests/more`; `AMC_STUDIO` names the program where it is not the one that cargo built, and
//! `AMC_STUDIO_WITHOUT_EDITOR` is set where that has no tangent-field editor.

#![cfg(feature = "full")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod driver;

use std::path::{Path, PathBuf};
use std::time::Instant;

use amc_studio::studio::Studio;
use driver::{CONTROL, ENTER, ESCAPE, PATIENCE, Person, SHIFT, Sight, until};
use eframe::egui::{Pos2, Rect, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use studio_plugin::Plugin;
use studio_tests::display::{Display, SIZE, Window, program};

/// A garment that comes with the program, as a file like any other.
fn garment(folder: &Path) -> PathBuf {
    let file = folder.join("t-shirt.glb");
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/garments/t-shirt.glb");
    std::fs::copy(bundled, &file).unwrap();
    file
}

/// Stands in the editor's place where the program has none: two plugins of one name are one.
struct NoEditor;

impl Plugin for NoEditor {
    fn id(&self) -> &'static str {
        "tangent-editor"
    }

    fn name(&self) -> &'static str {
        "No editor"
    }
}

/// Where things are in a window of this size.
struct Places {
    view: Rect,
    /// Where jobs are listed, and the tab of that.
    jobs: Rect,
    jobs_tab: Pos2,
    /// What closes the cards of the first steps.
    close: Pos2,
    /// The tab of the fabrics' pane, and the last fabric in it.
    fabrics: Pos2,
    fabric: Pos2,
    /// Where the pointer is on nothing.
    aside: Pos2,
}

/// As the same window without a display has them.
fn places(garment: &Path) -> Places {
    let folder = tempfile::tempdir().unwrap();
    let mut studio = Studio::new().keeping_in(folder.path()).open([garment.to_owned()]);
    if std::env::var_os("AMC_STUDIO_WITHOUT_EDITOR").is_some() {
        studio = studio.with_plugin(NoEditor);
    }
    let [width, height] = SIZE.map(f32::from);
    let mut harness = Harness::builder()
        .with_size([width, height])
        .with_max_steps(100)
        .wgpu()
        .build_eframe(move |creation| studio.into_app(creation));
    let settle = |harness: &mut Harness<'_, _>| {
        let start = Instant::now();
        harness.step();
        while !amc_studio::studio::App::is_settled(harness.state()) {
            assert!(start.elapsed() < PATIENCE, "still not settled");
            std::thread::sleep(std::time::Duration::from_millis(5));
            harness.step();
        }
        harness.run_steps(2);
    };
    settle(&mut harness);
    let view = harness.get_by_label("Garment").rect();
    let jobs_tab = harness.get_by_label("Jobs").rect().center();
    let close = harness.get_by_label("Close").rect().center();
    let fabrics = harness.get_all_by_label("Fabrics").next().unwrap().rect().center();
    harness.get_all_by_label("Fabrics").next().unwrap().click();
    settle(&mut harness);
    let fabric = harness.get_by_label_contains("Changeant").rect().center();
    // Within its edges, which may lie between pixels.
    let view = view.shrink(1.0);
    let jobs = Rect::from_min_max(view.left_bottom() + vec2(0.0, 40.0), pos2(view.max.x, height - 8.0));
    let aside = pos2(width / 2.0, 12.0);
    Places { view, jobs, jobs_tab, close, fabrics, fabric, aside }
}

#[test]
fn without_a_graphics_adapter_it_says_so_and_draws_on_the_processor() {
    let home = tempfile::tempdir().unwrap();
    let display = Display::start();
    let output = std::process::Command::new(program())
        .current_dir(home.path())
        .env("HOME", home.path())
        .env("DISPLAY", &display.name)
        .env_remove("WAYLAND_DISPLAY")
        .env("VK_DRIVER_FILES", "/none.json")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json")
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with("No window can be opened: there is no graphics adapter; install"), "{said}");
    assert!(home.path().join("amc-studio.png").exists());
}

#[test]
fn a_garment_is_dressed_saved_and_seen_again() {
    let home = tempfile::tempdir().unwrap();
    let garment = garment(home.path());
    let Places { view, jobs, jobs_tab, close, fabrics, fabric, aside } = places(&garment);
    let display = Display::start();
    let person = Person::at(&display.name);
    let mut window = Window::open(&program(), &display, home.path(), [&garment]);
    window.shown("garment", PATIENCE);
    person.focus();
    person.click(close);
    person.click(jobs_tab);
    person.point(aside);
    person.press(&[], ESCAPE);
    let idle = person.sees("no job", jobs, None);
    let whole = person.sees("the garment", view, None);
    let sees = |what: &str, before: &Sight| {
        person.sees_other(what, view, before);
        person.sees_again("the end of all jobs", jobs, &idle);
        person.sees(what, view, Some(before))
    };

    person.click(view.center());
    person.point(aside);
    let picked = sees("a panel that is outlined", &whole);
    person.click(fabrics);
    person.click(fabric);
    person.point(aside);
    let dressed = sees("another fabric", &picked);
    person.press(&[], u32::from(b'r'));
    let turned = sees("warp and weft swapped", &dressed);
    person.press(&[CONTROL], u32::from(b'z'));
    person.sees_again("the swap undone", view, &dressed);
    person.press(&[CONTROL, SHIFT], u32::from(b'z'));
    person.sees_again("the swap done again", view, &turned);
    person.press(&[], u32::from(b'c'));
    let split = sees("the view split", &turned);

    // There are no dialogs here: a path is offered, and taken as it is.
    person.press(&[CONTROL], u32::from(b's'));
    person.sees_other("the question for a path", view, &split);
    person.point(aside);
    person.press(&[], ENTER);
    let project = || {
        let mut files = std::fs::read_dir(home.path()).unwrap().flatten().map(|entry| entry.path());
        files.find(|path| path.extension().is_some_and(|suffix| suffix == "amcproj"))
    };
    until("the project's file", || project().is_some());
    person.sees_again("the view as it was before the question", view, &split);
    person.press(&[CONTROL, SHIFT], u32::from(b'a'));
    let left = sees("nothing selected", &split);
    person.press(&[CONTROL], u32::from(b'q'));
    until("the program's end", || window.ended().is_some());
    assert!(window.ended().unwrap().success());

    let mut again = Window::open(&program(), &display, home.path(), project());
    again.shown("garment", PATIENCE);
    person.focus();
    person.point(aside);
    person.sees_again("the same picture", view, &left);
    person.press(&[CONTROL], u32::from(b'q'));
    until("the program's end", || again.ended().is_some());
    assert!(again.ended().unwrap().success());
}
