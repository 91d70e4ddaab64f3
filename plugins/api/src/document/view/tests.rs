use amc_core::render::{Mode, Orientation};
use glam::DVec3;

use super::*;
use crate::Stage;

fn corners() -> Vec<Vec3> {
    let bit = |k: u32, b: u32| f32::from((k >> b & 1) as u8);
    (0..8).map(|k| Vec3::new(1.0 + 0.7 * bit(k, 0), -1.0 + 1.9 * bit(k, 1), 0.3 * bit(k, 2))).collect()
}

fn bounds() -> Bounds {
    Bounds::of(&corners()).unwrap()
}

fn perspective(focal_length_mm: f32) -> ViewSettings {
    ViewSettings { lens: Lens::Perspective { focal_length_mm }, ..ViewSettings::default() }
}

#[test]
fn the_defaults_are_the_command_lines_fitted_camera() {
    for (width, height) in [(1024, 1024), (640, 480), (333, 777)] {
        let fitted = View::fitted(&corners(), Orientation::default(), width, height).unwrap();
        assert_eq!(ViewSettings::default().view(bounds(), width, height), fitted);
    }
    assert_eq!(ViewSettings::default().shading(), Shading::default());
}

#[test]
fn angles_turn_as_the_command_lines_do() {
    let mut settings = ViewSettings::default();
    settings.set_angles(Angles { yaw: 30.0, pitch: -20.0, roll: 75.0 });
    let [yaw, pitch, roll] = [30.0f32, -20.0, 75.0].map(f32::to_radians);
    let fitted = View::fitted(&corners(), Orientation { yaw, pitch, roll }, 640, 480).unwrap();
    let view = settings.view(bounds(), 640, 480);
    assert!(view.object_to_view.abs_diff_eq(fitted.object_to_view, 1e-6));
    assert_eq!(view.projection, fitted.projection);
}

#[test]
fn angles_come_back_as_they_were_given() {
    let mut settings = ViewSettings::default();
    for yaw in [-170.0, -90.0, 0.0, 12.5, 179.0] {
        for pitch in [-80.0, 0.0, 33.0, 89.0] {
            for roll in [-135.0, 0.0, 90.0] {
                settings.set_angles(Angles { yaw, pitch, roll });
                let found = settings.angles();
                let off = [found.yaw - yaw, found.pitch - pitch, found.roll - roll];
                assert!(off.iter().all(|off| off.abs() < 1e-6), "{yaw} {pitch} {roll}: {found:?}");
            }
        }
    }
    // Where yaw and roll are the same turn, any split between them will do, if the turn is the same.
    for pitch in [-90.0, 90.0] {
        settings.set_angles(Angles { yaw: 25.0, pitch, roll: 40.0 });
        let before = settings.orientation();
        settings.set_angles(settings.angles());
        assert!(before.angle_between(settings.orientation()) < 1e-6);
    }
}

#[test]
fn named_views_show_the_side_they_are_named_after() {
    let towards_viewer = |named| {
        let mut settings = ViewSettings { zoom: 3.0, pan: Vec2::ONE, ..ViewSettings::default() };
        settings.look(named);
        assert_eq!((settings.zoom, settings.pan), (1.0, Vec2::ZERO));
        (settings.orientation().inverse() * DVec3::Z).round()
    };
    let sides = [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y];
    assert_eq!(NamedView::ALL.map(towards_viewer), sides);
}

/// The picture's place of a point of object space: (0, 0) the middle, 1 the half height.
fn seen(view: &View, point: DVec3) -> Vec2 {
    let clip = view.view_to_clip() * view.object_to_view * point.as_vec3().extend(1.0);
    clip.truncate().truncate() / clip.w * Vec2::new(view.width as f32 / view.height as f32, 1.0)
}

#[test]
fn pan_and_zoom_are_measured_in_the_picture() {
    let sideways = DVec3::new(0.0, 0.4, 0.0);
    for settings in [ViewSettings::default(), perspective(50.0)] {
        let plain = seen(&settings.view(bounds(), 640, 480), bounds().centre + sideways);
        let moved = ViewSettings { pan: Vec2::new(0.25, -0.5), zoom: 2.5, ..settings };
        let view = moved.view(bounds(), 640, 480);
        assert!((seen(&view, bounds().centre) - Vec2::new(0.25, -0.5)).length() < 1e-6);
        let apart = seen(&view, bounds().centre + sideways) - Vec2::new(0.25, -0.5);
        assert!((apart - plain * 2.5).length() < 1e-5, "{apart} {plain}");
    }
}

#[test]
fn a_perspective_view_fits_the_sphere_and_has_the_lenss_angle() {
    for (width, height) in [(600, 400), (400, 600), (500, 500)] {
        let view = perspective(36.0).view(bounds(), width, height);
        let Projection::Perspective { fov_y } = view.projection else { panic!("perspective") };
        let shorter = (width as f32 / height as f32).min(1.0);
        // Half of 24 mm at 36 mm: a third.
        assert!(((fov_y / 2.0).tan() * shorter - 1.0 / 3.0).abs() < 1e-6);
        // The sphere's outline touches the shorter side: the sine of half the angle is radius over distance.
        let distance = -view.object_to_view.transform_point3(bounds().centre.as_vec3()).z;
        assert!((bounds().radius as f32 / distance - (1.0f32 / 3.0).atan().sin()).abs() < 1e-6);
        assert!(view.near > 0.0 && view.near < distance - bounds().radius as f32);
        view.check().unwrap();
    }
    let widest = ViewSettings { zoom: ViewSettings::LEAST_ZOOM, ..perspective(12.0) };
    widest.view(bounds(), 4000, 10).check().unwrap();
}

#[test]
fn missing_keys_get_their_defaults_and_all_comes_back() {
    let read: ViewSettings = serde_json::from_str(r#"{"zoom": 2.0, "unknown": 1}"#).unwrap();
    assert_eq!(read, ViewSettings { zoom: 2.0, ..ViewSettings::default() });
    let mut settings = ViewSettings {
        pan: Vec2::new(0.5, -1.0),
        mode: "uv".into(),
        cyclic: Cyclic::Fragment,
        perspective: Perspective::Paper,
        occlusion: false,
        background: Some([1, 2, 255]),
        turning: TurningStyle::Turntable,
        auto_turn: Some(-12.0),
        ..perspective(85.0)
    };
    settings.set_angles(Angles { yaw: 10.0, pitch: 20.0, roll: 30.0 });
    let json = serde_json::to_string(&settings).unwrap();
    let mut read: ViewSettings = serde_json::from_str(&json).unwrap();
    assert!(read.orientation().abs_diff_eq(settings.orientation(), 1e-15));
    read.orientation = settings.orientation;
    assert_eq!(read, settings);
    settings.check().unwrap();
    assert_eq!(Stage::default().shading(&settings).mode, Mode::Uv);
}

#[test]
fn hostile_values_are_named() {
    let says = |json: &str| {
        let settings: ViewSettings = serde_json::from_str(json).unwrap();
        settings.check().unwrap_err().to_string()
    };
    assert!(says(r#"{"orientation": [0, 0, 0, 0]}"#).contains("view, orientation"));
    assert!(says(r#"{"orientation": [1e300, 0, 0, 1]}"#).contains("view, orientation"));
    assert!(says(r#"{"pan": [0, -1e9]}"#).contains("view, pan: -1000000000"));
    assert!(says(r#"{"zoom": 0}"#).contains("view, zoom: 0 is not between 0.02 and 200"));
    assert!(says(r#"{"zoom": -1}"#).contains("view, zoom"));
    assert!(says(r#"{"lens": {"perspective": {"focal_length_mm": 0}}}"#).contains("view, focal length"));
    assert!(says(r#"{"auto_turn": 1e9}"#).contains("view, auto turn"));
    let nan = ViewSettings { zoom: f32::NAN, ..ViewSettings::default() };
    assert!(nan.check().is_err());
}

#[test]
fn the_orientation_stays_a_unit_quaternion() {
    let mut settings = ViewSettings::default();
    settings.set_orientation(DQuat::from_xyzw(0.0, 3.0, 0.0, 4.0));
    let unit = settings.orientation();
    assert!(unit.abs_diff_eq(DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8), 1e-12));
    for refused in [DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0)] {
        settings.set_orientation(refused);
        assert_eq!(settings.orientation(), unit);
    }
    settings.set_angles(Angles { yaw: f64::INFINITY, ..Angles::default() });
    assert_eq!(settings.orientation(), unit);
}
