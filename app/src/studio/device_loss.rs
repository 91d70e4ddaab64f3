//! What goes on when the graphics device is lost: the window is opened anew on another, with the same document.
//!
//! eframe keeps its device for as long as its window, so the window goes with it: it paints nothing more, and closes. Should
//! the device go between a frame's last look at it and its painting, egui's renderer panics; what is kept is therefore
//! handed over when the application is dropped, whichever way.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use eframe::{egui, wgpu};
use studio_plugin::{Notices, Registry, Selection};

use super::desk::Desk;
use super::dock::Layout;
use super::settings::Preferences;

/// A device that lasted for less than this is no better than none.
const SHORT: Duration = Duration::from_secs(10);

/// So many windows in a row on devices that do not last, then it is given up.
const MOST: u32 = 3;

/// Between two tries: a driver that resets takes its time.
const PAUSE: Duration = Duration::from_millis(500);

/// What outlives a window.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) desk: Desk,
    pub(super) selection: Selection,
    pub(super) registry: Registry,
    pub(super) layout: Layout,
    pub(super) preferences: Preferences,
    pub(super) notices: Notices,
    pub(super) has_dialogs: bool,
}

/// Where a window leaves it for the next one.
#[derive(Debug, Clone, Default)]
pub(super) struct Handover(Arc<Mutex<Option<Kept>>>);

impl Handover {
    pub(super) fn leave(&self, kept: Kept) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }

    pub(super) fn take(&self) -> Option<Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Knows whether a device is lost.
#[derive(Debug, Default)]
pub(super) struct Watch {
    lost: Arc<AtomicBool>,
    device: Option<wgpu::Device>,
}

impl Watch {
    /// Over `device`. When it is lost, `context` is woken; faults that nothing else catches are logged, where the default
    /// is to panic.
    pub(super) fn over(device: &wgpu::Device, context: &egui::Context) -> Self {
        let watch = Self { lost: Arc::default(), device: Some(device.clone()) };
        let (lost, context) = (Arc::clone(&watch.lost), context.clone());
        device.set_device_lost_callback(move |reason, message| {
            log::warn!("the graphics device is lost ({reason:?}): {message}");
            lost.store(true, Ordering::Release);
            context.request_repaint();
        });
        let lost = Arc::clone(&watch.lost);
        device.on_uncaptured_error(Arc::new(move |error| {
            // Of a lost device everything fails, and it has been said.
            if !lost.load(Ordering::Acquire) {
                log::error!("graphics device: {error}");
            }
        }));
        watch
    }

    pub(super) fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Acquire)
    }

    /// The same, asking the device: a frame may fail before the loss is told.
    pub(super) fn is_lost_by_now(&self) -> bool {
        if let Some(device) = &self.device {
            // What is lost may refuse; the callback has been called all the same.
            device.poll(wgpu::PollType::Poll).ok();
        }
        self.is_lost()
    }
}

/// How often devices were lost soon after the window was opened.
#[derive(Debug)]
pub(super) struct Patience {
    opened: Instant,
    losses: u32,
}

impl Patience {
    pub(super) fn new() -> Self {
        Self { opened: Instant::now(), losses: 0 }
    }

    /// After a loss: waits a moment, unless it is to be given up.
    pub(super) fn allows_another(&mut self) -> bool {
        self.losses = if self.opened.elapsed() < SHORT { self.losses + 1 } else { 1 };
        if self.losses > MOST {
            return false;
        }
        std::thread::sleep(PAUSE);
        self.opened = Instant::now();
        true
    }
}
