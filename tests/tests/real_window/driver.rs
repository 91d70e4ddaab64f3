//! A person at a display: what they press, click and see.

use std::time::{Duration, Instant};

use eframe::egui::{Pos2, Rect};
use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{ConnectionExt as _, ImageFormat, InputFocus, MapState, Window};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// How long anything may take before it counts as hung.
pub(super) const PATIENCE: Duration = Duration::from_secs(120);

/// A person does not move the pointer and press within one frame, however slow the frame.
const PACE: Duration = Duration::from_millis(500);

/// What has not changed for so long is done: longer than a job takes that draws anew.
const STEADY: Duration = Duration::from_millis(1200);

/// X's numbers of events and keys.
const KEY_PRESS: u8 = 2;
const KEY_RELEASE: u8 = 3;
const BUTTON_PRESS: u8 = 4;
const BUTTON_RELEASE: u8 = 5;
const MOTION: u8 = 6;
pub(super) const CONTROL: u32 = 0xffe3;
pub(super) const SHIFT: u32 = 0xffe1;
pub(super) const ENTER: u32 = 0xff0d;
pub(super) const ESCAPE: u32 = 0xff1b;

/// A connection to a display.
pub(super) struct Person {
    display: RustConnection,
    root: Window,
    keycodes: Vec<(u32, u8)>,
}

/// What is seen in a part of the window.
#[derive(PartialEq, Eq, Clone)]
pub(super) struct Sight(Vec<u8>);

impl Person {
    pub(super) fn at(display: &str) -> Self {
        let (display, screen) = x11rb::connect(Some(display)).unwrap();
        let setup = display.setup();
        let root = setup.roots[screen].root;
        let (first, last) = (setup.min_keycode, setup.max_keycode);
        let mapping = display.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let per_key = usize::from(mapping.keysyms_per_keycode);
        let keysyms = mapping.keysyms.chunks(per_key).map(|keysyms| keysyms[0]);
        let keycodes = keysyms.zip(first..=last).collect();
        Self { display, root, keycodes }
    }

    /// Gives the keyboard to the program's window: there is no window manager.
    pub(super) fn focus(&self) {
        until("there is a window", || {
            let tree = self.display.query_tree(self.root).unwrap().reply().unwrap();
            let is_shown = |window: &Window| {
                let attributes = self.display.get_window_attributes(*window).unwrap().reply();
                let geometry = self.display.get_geometry(*window).unwrap().reply();
                attributes.is_ok_and(|it| it.map_state == MapState::VIEWABLE)
                    && geometry.is_ok_and(|it| it.width >= 640)
            };
            let window = tree.children.into_iter().find(is_shown);
            let focus =
                |window| self.display.set_input_focus(InputFocus::PARENT, window, x11rb::CURRENT_TIME);
            window.is_some_and(|window| focus(window).unwrap().check().is_ok())
        });
    }

    fn event(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        self.display.xtest_fake_input(kind, detail, x11rb::CURRENT_TIME, self.root, x, y, 0).unwrap();
        self.display.flush().unwrap();
        // Faster than this no person is, and the window draws a frame in between.
        std::thread::sleep(Duration::from_millis(30));
    }

    pub(super) fn press(&self, modifiers: &[u32], keysym: u32) {
        let code = |keysym| {
            self.keycodes.iter().find(|(known, _)| *known == keysym).expect("the keyboard has the key").1
        };
        let keys: Vec<u8> = modifiers.iter().copied().chain([keysym]).map(code).collect();
        keys.iter().for_each(|&key| self.event(KEY_PRESS, key, [0, 0]));
        keys.iter().rev().for_each(|&key| self.event(KEY_RELEASE, key, [0, 0]));
    }

    /// Moves the pointer, and gives the window time: all that comes within one frame is taken to be at one place.
    pub(super) fn point(&self, at: Pos2) {
        self.event(MOTION, 0, [at.x as i16, at.y as i16]);
        std::thread::sleep(PACE);
    }

    pub(super) fn click(&self, at: Pos2) {
        self.point(at);
        self.event(BUTTON_PRESS, 1, [0, 0]);
        self.event(BUTTON_RELEASE, 1, [0, 0]);
        // Still there while it is done.
        self.point(at);
    }

    fn look(&self, rect: Rect) -> Sight {
        let [x, y] = [rect.min.x, rect.min.y].map(|it| it.ceil() as i16);
        let [width, height] = [rect.width(), rect.height()].map(|it| it.floor() as u16);
        let image = self.display.get_image(ImageFormat::Z_PIXMAP, self.root, x, y, width, height, !0);
        Sight(image.unwrap().reply().unwrap().data)
    }

    /// What is seen once it has not changed for a while, and is not `before`.
    pub(super) fn sees(&self, what: &str, rect: Rect, before: Option<&Sight>) -> Sight {
        let (mut last, mut since) = (self.look(rect), Instant::now());
        until(what, || {
            let now = self.look(rect);
            if now != last {
                (last, since) = (now, Instant::now());
            }
            since.elapsed() > STEADY && before != Some(&last)
        });
        last
    }

    /// Waits until something else is seen than before.
    pub(super) fn sees_other(&self, what: &str, rect: Rect, before: &Sight) {
        until(what, || self.look(rect) != *before);
    }

    /// Waits until exactly this is seen.
    pub(super) fn sees_again(&self, what: &str, rect: Rect, expected: &Sight) {
        until(what, || self.look(rect) == *expected);
    }
}

/// Waits until it is so.
pub(super) fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < PATIENCE, "in vain waited for: {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}
