//! Bad input: each fault has its own message.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::super::{BuildOptions, build};
use super::ball::{Lobes, Scene};
use crate::{ErrorKind, Progress, Result, Step};

fn small() -> tempfile::TempDir {
    Scene { pictures: 8, ..Scene::small(Lobes::woven()) }.write()
}

fn attempt(folder: &Path) -> Result<super::Built> {
    build(folder, &BuildOptions { side: 16, ..BuildOptions::default() }, &Progress::none())
}

fn grey(folder: &Path, name: &str, width: u32, height: u32, value: impl Fn(u32) -> u8) {
    let mut bytes = Vec::new();
    let encoder = png::Encoder::new(&mut bytes, width, height);
    let samples: Vec<u8> = (0..width * height).map(value).collect();
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    crate::file::save_bytes(&folder.join(name), &bytes).unwrap();
}

#[test]
fn pictures_without_a_ball() {
    let noise = |k: u32| (k.wrapping_mul(2_654_435_761) >> 24) as u8;
    let fills: [(&str, &dyn Fn(u32) -> u8); 4] = [
        ("blank", &|_| 90),
        ("noise", &noise),
        ("stripes", &|k| if k % 120 / 10 % 2 == 0 { 200 } else { 40 }),
        ("ramp", &|k| (k % 120) as u8),
    ];
    for (name, fill) in fills {
        let folder = tempfile::tempdir().unwrap();
        for k in 0..8 {
            grey(folder.path(), &format!("{k}.png"), 120, 100, fill);
        }
        let Err(error) = attempt(folder.path()) else { panic!("a ball in {name}") };
        assert!(error.to_string().contains("no ball was found"), "{name}: {error}");
    }
}

#[test]
fn pictures_of_two_sizes_name_both_files() {
    let folder = small();
    grey(folder.path(), "picture3.png", 64, 48, |_| 0);
    let message = attempt(folder.path()).unwrap_err().to_string();
    assert!(
        message.contains("picture3.png: 64 x 48") && message.contains("picture0.png has 100 x 96"),
        "{message}"
    );
}

#[test]
fn a_broken_picture_is_named() {
    let folder = small();
    crate::file::save_bytes(&folder.path().join("picture5.png"), b"\x89PNG\r\n\x1a\nbroken").unwrap();
    let message = attempt(folder.path()).unwrap_err().to_string();
    assert!(message.contains("picture5.png: ") && message.contains("broken PNG"), "{message}");
}

#[test]
fn a_file_that_is_no_picture_is_left_out_and_said() {
    let folder = small();
    crate::file::save_bytes(&folder.path().join("notes.txt"), b"lamp moved?").unwrap();
    let built = attempt(folder.path()).unwrap();
    assert_eq!(built.report.pictures, 8);
    assert!(built.report.notices.iter().any(|notice| notice.contains("notes.txt")));
    assert_eq!(built.amc.metadata.capture["pictures"], 8);
}

#[test]
fn too_few_pictures_and_missing_ones() {
    let folder = small();
    std::fs::remove_file(folder.path().join("picture7.png")).unwrap();
    assert!(attempt(folder.path()).unwrap_err().to_string().contains("7 pictures; at least 8"));
    let error = attempt(&folder.path().join("nowhere")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    let session: Vec<String> =
        (0..8).map(|k| format!(r#"{{"file": "picture{k}.png", "angle_deg": {}}}"#, k * 45)).collect();
    let session = format!(r#"{{"version": 1, "pictures": [{}]}}"#, session.join(","));
    crate::file::save_bytes(&folder.path().join("session.json"), session.as_bytes()).unwrap();
    assert!(attempt(folder.path()).unwrap_err().to_string().contains("picture7.png"));
}

#[test]
fn options_that_make_no_sense() {
    let folder = small();
    let options = BuildOptions { side: 16, ..BuildOptions::default() };
    let attempt =
        |options: BuildOptions| build(folder.path(), &options, &Progress::none()).unwrap_err().to_string();
    assert!(attempt(BuildOptions { side: 0, ..options.clone() }).contains("0 x 0"));
    assert!(attempt(BuildOptions { slices: Some(9999), ..options.clone() }).contains("9999"));
    assert!(attempt(BuildOptions { threshold: f64::NAN, ..options.clone() }).contains("threshold"));
    assert!(attempt(BuildOptions { horizontal_fov: Some(4.0), ..options.clone() }).contains("field of view"));
    assert!(
        attempt(BuildOptions { sphere: Some((-500.0, 9.0, 20.0)), ..options.clone() }).contains("outside")
    );
    assert!(attempt(BuildOptions { sphere: Some((50.0, 50.0, -1.0)), ..options }).contains("radius"));
}

#[test]
fn a_ball_may_leave_the_pictures_by_less_than_half() {
    let folder = small();
    // The pictures have 100 x 96 pixels.
    let attempt = |sphere: (f64, f64, f64)| {
        let options = BuildOptions { side: 16, sphere: Some(sphere), ..BuildOptions::default() };
        build(folder.path(), &options, &Progress::none())
    };
    for (x, y, radius) in [(48.0, 48.0, 48.0), (4.0, 48.0, 30.0), (50.0, 48.0, 62.0)] {
        assert!(attempt((x, y, radius)).is_ok(), "{x} {y} {radius}");
    }
    // A circle beyond a line at a fifth of its radius from the middle; nearly all of one; a square much smaller than the ball.
    for (sphere, outside) in
        [((-6.0, 48.0, 30.0), 62.6), ((-28.0, 48.0, 30.0), 99.0), ((50.0, 48.0, 5000.0), 100.0)]
    {
        let message = attempt(sphere).unwrap_err().to_string();
        let told = message.rsplit(": ").next().unwrap().split(' ').next().unwrap();
        assert!((told.parse::<f64>().unwrap() - outside).abs() < 1.5, "{outside}: {message}");
    }
}

#[test]
fn a_cancelled_build_stops() {
    let folder = small();
    let cancelled = AtomicBool::new(false);
    let stop = |step: Step<'_>| cancelled.store(step.done >= 3, std::sync::atomic::Ordering::Relaxed);
    let options = BuildOptions { side: 16, ..BuildOptions::default() };
    let error = build(folder.path(), &options, &Progress::new(&stop, &cancelled)).unwrap_err();
    assert!(error.is_cancelled());
}
