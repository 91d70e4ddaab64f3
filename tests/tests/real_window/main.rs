//! A journey through the real program in a real window: opened by argument, driven by keyboard and mouse, seen in pixels.
//!
//! It needs Xvfb and is run by `tests/more`; `AMC_STUDIO` names the program where it is not the one that cargo built.

#![cfg(feature = "full")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod driver;

use std::path::{Path, PathBuf};
use std::time::Instant;

use amc_studio::studio::Studio;
use driver::{CONTROL, ENTER, ESCAPE, PATIENCE, Person, SHIFT, until};
use eframe::egui::{Pos2, Rect, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use studio_tests::display::{Display, SIZE, Window, program};

/// A garment that comes with the program, as a file like any other.
fn garment(folder: &Path) -> PathBuf {
    let file = folder.join("t-shirt.glb");
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/garments/t-shirt.glb");
    std::fs::copy(bundled, &file).unwrap();
    file
}

/// Where things are in a window of this size.
struct Places {
    view: Rect,
    /// The tab of the fabrics' pane, and the last fabric in it.
    fabrics: Pos2,
    fabric: Pos2,
    /// Where the pointer is on nothing.
    aside: Pos2,
}

/// As the same window without a display has them.
fn places(garment: &Path) -> Places {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::new().keeping_in(folder.path()).open([garment.to_owned()]);
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
    let fabrics = harness.get_all_by_label("Fabrics").next().unwrap().rect().center();
    harness.get_all_by_label("Fabrics").next().unwrap().click();
    settle(&mut harness);
    let fabric = harness.get_by_label_contains("Changeant").rect().center();
    // Within its edges, which may lie between pixels.
    let view = view.shrink(1.0);
    Places { view, fabrics, fabric, aside: pos2(width / 2.0, 12.0) }
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
    let Places { view, fabrics, fabric, aside } = places(&garment);
    let display = Display::start();
    let person = Person::at(&display.name);
    let mut window = Window::open(&program(), &display, home.path(), [&garment]);
    window.shown("garment", PATIENCE);
    person.focus();
    person.point(aside);
    person.press(&[], ESCAPE);
    let whole = person.sees("the garment", view, None);

    person.click(view.center());
    person.point(aside);
    let picked = person.sees("a panel that is outlined", view, Some(&whole));
    person.click(fabrics);
    person.click(fabric);
    person.point(aside);
    let dressed = person.sees("another fabric", view, Some(&picked));
    person.press(&[], u32::from(b'r'));
    let turned = person.sees("warp and weft swapped", view, Some(&dressed));
    person.press(&[CONTROL], u32::from(b'z'));
    person.sees_again("the swap undone", view, &dressed);
    person.press(&[CONTROL, SHIFT], u32::from(b'z'));
    person.sees_again("the swap done again", view, &turned);
    person.press(&[], u32::from(b'c'));
    let split = person.sees("the view split", view, Some(&turned));

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
    let left = person.sees("nothing selected", view, Some(&split));
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
