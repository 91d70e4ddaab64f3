//! Whole builds of balls that a small renderer of our own draws, against what it knows to be true.

mod ball;
mod input;

use ball::{Camera, Lobes, Scene};
use glam::DVec2;
use tempfile::TempDir;

use super::{BuildOptions, Built, Turn, build};
use crate::Progress;
use crate::amc::{Frame, Symmetry};
use crate::view_space::Azimuth;

fn built(folder: &TempDir, options: &BuildOptions) -> Built {
    build(folder.path(), options, &Progress::none()).unwrap()
}

/// Signal to noise, dB, of looking up what random pixels of the ball show.
fn fidelity(scene: &Scene, built: &Built) -> f64 {
    let table = built.amc.to_linear();
    let mut squares = 0.0;
    let mut count = 0.0;
    for probe in scene.probes(4000, built.amc.frame) {
        let phi = built.amc.azimuth.of(probe.normal, probe.tangent);
        let colour = table.look_up(probe.normal.truncate(), phi);
        for (got, truth) in colour.into_iter().zip(probe.colour) {
            let encode = crate::color::srgb_from_linear;
            squares += f64::from(encode(got) - encode(truth as f32)).powi(2);
            count += 1.0;
        }
    }
    -10.0 * (squares / count).log10()
}

fn assert_fits(scene: &Scene, built: &Built, tolerance: f64) {
    let found = built.report.ball;
    let (at, radius) = scene.ball();
    let off = at.distance(DVec2::new(found.x, found.y));
    assert!(off < tolerance && (found.radius - radius).abs() < tolerance, "{found:?}, true {at} {radius}");
}

fn options() -> BuildOptions {
    BuildOptions { side: 64, ..BuildOptions::default() }
}

#[test]
fn an_orthographic_ball_comes_back_in_both_azimuths() {
    let scene = Scene { pictures: 48, ..Scene::new(Lobes::woven()) };
    let folder = scene.write();
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        let built = built(&folder, &BuildOptions { azimuth, ..options() });
        assert_fits(&scene, &built, 0.15);
        assert_eq!(built.report.symmetry, Symmetry::Two);
        let decibels = fidelity(&scene, &built);
        assert!(decibels > 38.0, "{azimuth:?}: {decibels}");
    }
}

#[test]
fn a_ball_near_and_off_the_axis_comes_back_in_both_frames() {
    let camera = Camera { fov_deg: 60.0, at: DVec2::new(190.0, 90.0), distance: 3.5 };
    let scene = Scene { camera: Some(camera), pictures: 48, turn: Turn::Cw, ..Scene::new(Lobes::woven()) };
    let folder = scene.write();
    for (frame, azimuth) in [
        (Frame::Half, Azimuth::Transported),
        (Frame::Full, Azimuth::Transported),
        (Frame::Half, Azimuth::Projected),
        (Frame::Full, Azimuth::Projected),
    ] {
        let horizontal_fov = Some(60f64.to_radians());
        let turn = Some(Turn::Cw);
        let built = built(&folder, &BuildOptions { frame, azimuth, horizontal_fov, turn, ..options() });
        assert_fits(&scene, &built, 0.2);
        let decibels = fidelity(&scene, &built);
        assert!(decibels > 36.0, "{frame:?} {azimuth:?}: {decibels}");
    }
}

#[test]
fn a_wrong_turn_direction_is_far_off() {
    let scene = Scene { pictures: 32, ..Scene::new(Lobes::woven()) };
    let folder = scene.write();
    let right = fidelity(&scene, &built(&folder, &options()));
    let wrong = fidelity(&scene, &built(&folder, &BuildOptions { turn: Some(Turn::Cw), ..options() }));
    assert!(wrong < right - 10.0, "{wrong} {right}");
}

#[test]
fn uneven_angles_of_a_session_are_used() {
    let scene = Scene { pictures: 60, uneven: true, turn: Turn::Cw, ..Scene::new(Lobes::woven()) };
    let built = built(&scene.write(), &options());
    assert_eq!(built.report.turn, Turn::Cw);
    let decibels = fidelity(&scene, &built);
    assert!(decibels > 36.0, "{decibels}");
}

#[test]
fn the_symmetry_is_right_for_few_and_many_noisy_pictures() {
    let cloths = [
        (Lobes::napped(), Symmetry::One, false),
        (Lobes::woven(), Symmetry::Two, false),
        (Lobes::triple(), Symmetry::Three, false),
        (Lobes::balanced(), Symmetry::Four, false),
        (Lobes::felt(), Symmetry::One, true),
    ];
    for (cloth, symmetry, isotropic) in cloths {
        for (pictures, noise) in [(8, 1.5), (15, 3.0), (37, 6.0), (50, 0.0)] {
            let scene = Scene { pictures, noise, ..Scene::small(cloth.clone()) };
            let built = built(&scene.write(), &BuildOptions { side: 32, ..BuildOptions::default() });
            let report = &built.report;
            assert_eq!(
                (report.symmetry, report.isotropic),
                (symmetry, isotropic),
                "{pictures} pictures, noise {noise}: {:?}",
                report.similarity
            );
        }
    }
}

#[test]
fn a_balanced_cloth_keeps_its_look_at_a_quarter_of_the_turn() {
    let scene = Scene { pictures: 128, ..Scene::small(Lobes::balanced()) };
    let folder = scene.write();
    let options = || BuildOptions { side: 32, ..options() };
    let whole = built(&folder, &BuildOptions { symmetry: Some(Symmetry::One), ..options() });
    let quarter = built(&folder, &options());
    assert_eq!((whole.report.slices, quarter.report.slices), (128, 32));
    let (whole, quarter) = (fidelity(&scene, &whole), fidelity(&scene, &quarter));
    assert!(quarter > whole - 1.0 && quarter > 36.0, "{whole} {quarter}");
}

#[test]
fn a_ball_is_found_against_any_background() {
    let scenes = [
        ("dark", Scene { background: 0.0, ..Scene::new(Lobes::woven()) }),
        ("bright", Scene { background: 0.9, ..Scene::new(Lobes::woven()) }),
        ("vignette and noise", Scene { vignette: 0.6, noise: 8.0, ..Scene::new(Lobes::woven()) }),
        ("cut", Scene { centre: DVec2::new(75.0, 110.0), ..Scene::new(Lobes::woven()) }),
        ("small", Scene { radius: 30.0, ..Scene::new(Lobes::balanced()) }),
        ("one side light", Scene { background: 0.05, side_light: true, ..Scene::new(Lobes::woven()) }),
    ];
    for (name, scene) in scenes {
        let folder = scene.write();
        let built = build(folder.path(), &options(), &Progress::none())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let found = built.report.ball;
        let (at, radius) = scene.ball();
        let off = at.distance(DVec2::new(found.x, found.y));
        assert!(off < 0.6 && (found.radius - radius).abs() < 0.6, "{name}: {found:?}, true {at} {radius}");
    }
}

#[test]
fn a_ball_that_fills_the_picture_is_found_by_its_coverage() {
    let scene = Scene {
        width: 96,
        height: 96,
        centre: DVec2::splat(48.0),
        radius: 48.0,
        alpha: true,
        ..Scene::new(Lobes::woven())
    };
    let built = built(&scene.write(), &BuildOptions { side: 96, ..BuildOptions::default() });
    assert_fits(&scene, &built, 0.05);
    assert!(built.report.coverage > 0.98, "{}", built.report.coverage);
}
