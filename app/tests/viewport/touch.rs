//! Fingers, as a touch screen reports them: each as a touch, the first one as a pointer too.

use egui::{Event, TouchDeviceId, TouchId, TouchPhase};

use super::*;

/// Puts fingers down, moves or lifts them.
fn touch(harness: &mut Harness<'_, Window>, phase: TouchPhase, fingers: &[Pos2]) {
    for (number, &pos) in (0u64..).zip(fingers) {
        let (device_id, id) = (TouchDeviceId(1), TouchId(number));
        harness.event(Event::Touch { device_id, id, phase, pos, force: None });
        if number > 0 {
            continue;
        }
        harness.event(Event::PointerMoved(pos));
        if phase != TouchPhase::Move {
            let (button, pressed) = (PointerButton::Primary, phase == TouchPhase::Start);
            harness.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
        }
    }
    harness.step();
}

/// Fingers that go from places to places.
fn gesture<const N: usize>(harness: &mut Harness<'_, Window>, from: [Pos2; N], to: [Pos2; N]) {
    const STEPS: usize = 8;
    touch(harness, TouchPhase::Start, &from);
    for step in 0..=STEPS {
        let share = step as f32 / STEPS as f32;
        let at: Vec<Pos2> = from.iter().zip(to).map(|(from, to)| from.lerp(to, share)).collect();
        touch(harness, TouchPhase::Move, &at);
    }
    touch(harness, TouchPhase::End, &to);
    harness.run_steps(2);
}

#[test]
fn one_finger_turns_as_the_mouse_does() {
    let (way, to) = (pos2(100.0, 80.0), pos2(150.0, 80.0));
    let (mut by_mouse, _) = window(Some(drawing()), 1.0);
    by_mouse.run();
    drag(&mut by_mouse, &[way, to], PointerButton::Primary, Modifiers::NONE);
    let (mut by_finger, _) = window(Some(drawing()), 1.0);
    by_finger.run();
    gesture(&mut by_finger, [way], [to]);
    let turned = |harness: &Harness<'_, Window>| harness.state().settings.orientation();
    assert!(turned(&by_finger).angle_between(DQuat::IDENTITY) > 0.2);
    assert!(turned(&by_finger).angle_between(turned(&by_mouse)) < 1e-6);
}

#[test]
fn two_fingers_move_and_zoom_and_do_not_turn() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    harness.run();
    // Apart: zoom by the ratio of the distances, about the middle between them.
    gesture(&mut harness, [pos2(80.0, 80.0), pos2(120.0, 80.0)], [pos2(60.0, 80.0), pos2(140.0, 80.0)]);
    let settings = harness.state().settings.clone();
    assert!((settings.zoom - 2.0).abs() < 0.05, "{}", settings.zoom);
    assert!(settings.pan.length() < 0.05, "{}", settings.pan);
    // Along together: a fifth of the height, two fifths of a half height, to the right and down.
    gesture(&mut harness, [pos2(80.0, 80.0), pos2(120.0, 80.0)], [pos2(96.0, 112.0), pos2(136.0, 112.0)]);
    let moved = harness.state().settings.pan - settings.pan;
    assert!((moved - glam::Vec2::new(0.2, -0.4)).length() < 0.03, "{moved}");
    assert!((harness.state().settings.zoom - settings.zoom).abs() < 0.05);
    assert!(harness.state().settings.orientation().angle_between(DQuat::IDENTITY) < 1e-6);
    assert!(harness.state().clicks.is_empty() && harness.state().boxes.is_empty());
}
