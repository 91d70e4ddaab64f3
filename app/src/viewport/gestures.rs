//! Mouse, touch and keys: what they do to the view, and what they ask for.

use eframe::egui::{self, Key, Modifiers, PointerButton};
use glam::{DQuat, Vec2};
use studio_plugin::document::{NamedView, ViewSettings};

use super::pixels::Pixels;
use super::turning;

/// Degrees that an arrow key turns.
const KEY_DEGREES: f64 = 15.0;
/// What a press of plus magnifies by.
const KEY_ZOOM: f32 = 1.25;
/// Points of scrolling that magnify e times.
const SCROLL_POINTS: f32 = 200.0;
/// The keys of the named views, in the order of [`NamedView::ALL`].
const VIEW_KEYS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];

/// A drag that is under way: what it does, and how things stood when it began.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Drag {
    Turn { start: DQuat, from: Vec2 },
    Roll { start: DQuat, from: Vec2 },
    Pan { start: Vec2, from: Vec2 },
    Box { from: egui::Pos2 },
}

/// What gestures ask for that is not the view's.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Asked {
    /// The selection, or all, should fill the picture.
    pub(super) frame_selection: bool,
    /// What is under this point should fill the picture.
    pub(super) frame_at: Option<egui::Pos2>,
    /// A box was drawn, from corner to corner.
    pub(super) boxed: Option<[egui::Pos2; 2]>,
    /// The box that is being drawn.
    pub(super) rubber_band: Option<egui::Rect>,
}

/// The gesture under way.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Gestures {
    drag: Option<Drag>,
}

impl Gestures {
    /// Whether the object is being moved or a box drawn.
    pub(super) fn is_under_way(&self) -> bool {
        self.drag.is_some()
    }

    /// Takes this frame's input. With `tool` the left button is somebody else's.
    pub(super) fn take(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        at: &Pixels,
        tool: bool,
        settings: &mut ViewSettings,
    ) -> Asked {
        let mut asked = Asked::default();
        match ui.input(|input| input.multi_touch()) {
            Some(touch) if at.rect.contains(touch.center_pos) => {
                self.drag = None;
                turning::pan(settings, settings.pan, Vec2::ZERO, at.shift(touch.translation_delta));
                turning::zoom(settings, at.place(touch.center_pos), touch.zoom_delta);
            }
            _ => {
                self.take_drag(ui, response, at, tool, settings, &mut asked);
                take_wheel(ui, response, at, settings);
            }
        }
        if !tool && response.double_clicked() {
            asked.frame_at = response.interact_pointer_pos();
        }
        take_keys(ui, response, settings, &mut asked);
        asked
    }

    fn take_drag(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        at: &Pixels,
        tool: bool,
        settings: &mut ViewSettings,
        asked: &mut Asked,
    ) {
        if response.drag_started() {
            response.request_focus();
            self.drag = begin(ui, response, at, tool, settings);
        }
        if let (Some(drag), Some(to)) = (self.drag, response.interact_pointer_pos()) {
            let place = at.place(to);
            match drag {
                Drag::Turn { start, from } => turning::turn(settings, start, from, place, at.aspect()),
                Drag::Roll { start, from } => turning::roll(settings, start, from, place),
                Drag::Pan { start, from } => turning::pan(settings, start, from, place),
                Drag::Box { from } if response.drag_stopped() => asked.boxed = Some([from, to]),
                Drag::Box { from } => asked.rubber_band = Some(egui::Rect::from_two_pos(from, to)),
            }
        }
        if !response.dragged() {
            self.drag = None;
        }
    }
}

/// The drag that begins, by its button and what is held with it.
fn begin(
    ui: &egui::Ui,
    response: &egui::Response,
    at: &Pixels,
    tool: bool,
    settings: &ViewSettings,
) -> Option<Drag> {
    let (origin, modifiers, is_box) =
        ui.input(|input| (input.pointer.press_origin(), input.modifiers, input.key_down(Key::B)));
    // A drag is known only some points after the press: it starts from where it was pressed.
    let from = origin.or(response.interact_pointer_pos())?;
    let (place, start) = (at.place(from), settings.orientation());
    let started = |button| response.drag_started_by(button);
    if started(PointerButton::Secondary) {
        return Some(Drag::Box { from });
    }
    if started(PointerButton::Middle) {
        return Some(Drag::Pan { start: settings.pan, from: place });
    }
    if tool || !started(PointerButton::Primary) {
        return None;
    }
    Some(if is_box {
        Drag::Box { from }
    } else if modifiers.shift {
        Drag::Pan { start: settings.pan, from: place }
    } else if modifiers.command || modifiers.ctrl || modifiers.alt {
        Drag::Roll { start, from: place }
    } else {
        Drag::Turn { start, from: place }
    })
}

/// Wheel, and pinch of a touch pad.
fn take_wheel(ui: &egui::Ui, response: &egui::Response, at: &Pixels, settings: &mut ViewSettings) {
    let Some(pointer) = response.hover_pos() else { return };
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    let factor = (scroll / SCROLL_POINTS).exp() * pinch;
    if factor != 1.0 {
        turning::zoom(settings, at.place(pointer), factor);
    }
}

fn take_keys(ui: &egui::Ui, response: &egui::Response, settings: &mut ViewSettings, asked: &mut Asked) {
    if !response.has_focus() {
        return;
    }
    // Arrows turn, they do not move the focus.
    let filter =
        egui::EventFilter { tab: false, escape: false, horizontal_arrows: true, vertical_arrows: true };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let presses = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)) as f64;
    let right = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
    let up = presses(Key::ArrowUp) - presses(Key::ArrowDown);
    if right != 0.0 || up != 0.0 {
        turning::turn_by(settings, right * KEY_DEGREES, up * KEY_DEGREES);
    }
    let zoom = presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus);
    if zoom != 0.0 {
        turning::zoom(settings, Vec2::ZERO, KEY_ZOOM.powf(zoom as f32));
    }
    for (key, named) in VIEW_KEYS.into_iter().zip(NamedView::ALL) {
        if presses(key) > 0.0 {
            settings.look(named);
        }
    }
    asked.frame_selection = presses(Key::F) > 0.0;
}
