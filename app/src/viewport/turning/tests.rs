use std::f64::consts::{FRAC_PI_2, PI};

use amc_core::render::View;
use glam::Vec3;
use studio_plugin::document::{Lens, NamedView};

use super::*;

fn assert_same(a: DQuat, b: DQuat) {
    assert!(a.angle_between(b) < 1e-5, "{a} {b}");
}

fn bounds() -> Bounds {
    Bounds { centre: DVec3::new(0.1, -0.2, 0.3), radius: 0.8 }
}

fn both_lenses() -> [ViewSettings; 2] {
    let perspective = Lens::Perspective { focal_length_mm: 35.0 };
    [ViewSettings::default(), ViewSettings { lens: perspective, ..ViewSettings::default() }]
}

#[test]
fn a_drag_across_the_ball_is_half_a_turn() {
    assert_same(arcball(Vec2::NEG_X, Vec2::X), DQuat::from_rotation_y(PI));
    assert_same(arcball(Vec2::Y, Vec2::NEG_Y), DQuat::from_rotation_x(PI));
    // Further out the ball is held at its outline: the pointer takes it around the line of sight.
    assert_same(arcball(Vec2::X * 5.0, Vec2::Y * 2.0), DQuat::from_rotation_z(FRAC_PI_2));
    // The outline of a narrow picture is its shorter side.
    let mut settings = ViewSettings::default();
    turn(&mut settings, DQuat::IDENTITY, Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0), 0.5);
    assert_same(settings.orientation(), DQuat::from_rotation_y(PI));
}

#[test]
fn a_grabbed_point_of_the_ball_stays_under_the_pointer() {
    let (from, to) = (Vec2::new(0.3, -0.2), Vec2::new(-0.5, 0.6));
    let held = arcball(from, to) * DVec3::new(0.3, -0.2, (1.0f64 - 0.13).sqrt());
    assert!((held.truncate() - to.as_dvec2()).length() < 1e-6);
    assert!(held.z > 0.0);
}

#[test]
fn a_drag_there_and_back_changes_nothing() {
    for turning in [TurningStyle::Arcball, TurningStyle::Turntable] {
        let mut settings = ViewSettings { turning, ..ViewSettings::default() };
        settings.set_angles(Angles { yaw: 30.0, pitch: 20.0, roll: 5.0 });
        let before = settings.orientation();
        let from = Vec2::new(0.1, 0.2);
        for to in [Vec2::new(0.9, 0.3), Vec2::new(-2.0, -1.0), from] {
            turn(&mut settings, before, from, to, 1.5);
        }
        assert_same(settings.orientation(), before);
        turn_by(&mut settings, 15.0, 0.0);
        assert!(settings.orientation().angle_between(before) > 0.2);
        turn_by(&mut settings, -15.0, 0.0);
        assert_same(settings.orientation(), before);
    }
}

#[test]
fn both_styles_turn_the_front_to_where_the_pointer_goes() {
    for turning in [TurningStyle::Arcball, TurningStyle::Turntable] {
        let dragged = |to: Vec2| {
            let mut settings = ViewSettings { turning, ..ViewSettings::default() };
            turn(&mut settings, DQuat::IDENTITY, Vec2::ZERO, to, 1.0);
            settings.orientation() * DVec3::Z
        };
        let keyed = |right, up| {
            let mut settings = ViewSettings { turning, ..ViewSettings::default() };
            turn_by(&mut settings, right, up);
            settings.orientation() * DVec3::Z
        };
        for front in [dragged(Vec2::new(0.2, 0.0)), keyed(15.0, 0.0)] {
            assert!(front.x > 0.1 && front.y.abs() < 1e-6, "{turning:?} {front}");
        }
        for front in [dragged(Vec2::new(0.0, 0.2)), keyed(0.0, 15.0)] {
            assert!(front.y > 0.1 && front.x.abs() < 1e-6, "{turning:?} {front}");
        }
    }
}

#[test]
fn a_turntable_stays_upright_and_a_spin_is_about_the_objects_own_axis() {
    let mut settings = ViewSettings { turning: TurningStyle::Turntable, ..ViewSettings::default() };
    for step in 0..50 {
        let start = settings.orientation();
        turn(&mut settings, start, Vec2::ZERO, Vec2::new(0.37, 0.21 * (step as f32).sin()), 1.0);
        let up = settings.orientation() * DVec3::Y;
        assert!(up.x.abs() < 1e-6 && up.y > 0.0, "{up}");
    }
    let start = settings.orientation();
    turn(&mut settings, start, Vec2::ZERO, Vec2::new(0.0, -9.0), 1.0);
    assert!((settings.angles().pitch - MOST_TIP_DEGREES).abs() < 1e-6);

    settings.set_angles(Angles { yaw: 10.0, pitch: 40.0, roll: 20.0 });
    let up = settings.orientation() * DVec3::Y;
    spin(&mut settings, 33.0);
    assert!((settings.orientation() * DVec3::Y - up).length() < 1e-9);
    assert!((settings.angles().yaw - 43.0).abs() < 1e-6);
}

#[test]
fn a_roll_follows_the_pointer_around_the_middle() {
    let mut settings = ViewSettings::default();
    roll(&mut settings, DQuat::IDENTITY, Vec2::new(0.5, 0.0), Vec2::new(0.0, 2.0));
    assert!((settings.angles().roll - 90.0).abs() < 1e-4);
    roll(&mut settings, DQuat::IDENTITY, Vec2::ZERO, Vec2::X);
    assert_same(settings.orientation(), DQuat::IDENTITY);
}

/// The place of a point of object space.
fn seen(view: &View, point: DVec3) -> Vec2 {
    let clip = view.view_to_clip() * view.object_to_view * point.as_vec3().extend(1.0);
    clip.truncate().truncate() / clip.w * Vec2::new(view.width as f32 / view.height as f32, 1.0)
}

#[test]
fn zooming_keeps_what_is_under_the_pointer() {
    for mut settings in both_lenses() {
        settings.pan = Vec2::new(0.2, 0.1);
        // In the plane of the object's centre, which the identity leaves facing the viewer.
        let point = bounds().centre + DVec3::new(0.3, -0.1, 0.0);
        let place = seen(&settings.view(bounds(), 640, 480), point);
        for factor in [1.3, 0.2, 9.0] {
            zoom(&mut settings, place, factor);
            assert!((seen(&settings.view(bounds(), 640, 480), point) - place).length() < 1e-5);
        }
        let zoomed = settings.zoom;
        assert!((zoomed - 1.3 * 0.2 * 9.0).abs() < 1e-5);
        zoom(&mut settings, place, 1e9);
        assert_eq!(settings.zoom, ViewSettings::MOST_ZOOM);
        assert!((seen(&settings.view(bounds(), 640, 480), point) - place).length() < 1e-3);
        zoom(&mut settings, place, f32::NAN);
        zoom(&mut settings, place, 0.0);
        settings.check().unwrap();
    }
}

#[test]
fn panning_takes_the_object_along() {
    for mut settings in both_lenses() {
        pan(&mut settings, Vec2::new(0.1, 0.0), Vec2::new(0.5, 0.5), Vec2::new(0.7, 0.2));
        let place = seen(&settings.view(bounds(), 640, 480), bounds().centre);
        assert!((place - Vec2::new(0.3, -0.3)).length() < 1e-6);
        pan(&mut settings, Vec2::ZERO, Vec2::ZERO, Vec2::new(f32::NAN, 0.0));
        settings.check().unwrap();
    }
}

#[test]
fn a_framed_sphere_fills_its_share_of_the_shorter_side() {
    let target = Bounds { centre: DVec3::new(0.4, 0.1, 0.6), radius: 0.15 };
    for mut settings in both_lenses() {
        for (width, height) in [(640u32, 480u32), (480, 640)] {
            settings.look(NamedView::Left);
            frame(&mut settings, bounds(), target, width, height);
            let view = settings.view(bounds(), width, height);
            assert!(seen(&view, target.centre).length() < 1e-5);
            // The outline of the sphere along x: the farthest of its points in the picture.
            let around = (0..3600).map(|k| {
                let (sin, cos) = (f64::from(k) * PI / 1800.0).sin_cos();
                let offset = view.rotation().transpose() * Vec3::new(cos as f32, 0.0, sin as f32);
                seen(&view, target.centre + offset.as_dvec3() * target.radius).x
            });
            let reach = around.fold(0.0, f32::max) / ball_radius(width as f32 / height as f32);
            assert!((reach - FRAMED as f32).abs() < 1e-3, "{reach}");
        }
    }
}
