//! From where pictures are taken.

use std::sync::Arc;

use amc_core::Result;
use amc_core::render::{Bounds, Camera, Orientation, View};
use glam::{DQuat, Vec3};
use studio_plugin::document::{NamedView, ViewSettings};

use super::Size;

/// From where pictures of a garment are taken.
#[derive(Debug, Clone)]
pub(crate) enum Stand {
    /// As the window looks at it.
    Settings {
        settings: Box<ViewSettings>,
        /// The whole garment's.
        bounds: Bounds,
    },
    /// With an exact camera; the garment is turned about its file's origin.
    Camera {
        camera: Camera,
        orientation: Orientation,
        /// The garment's vertices, object space, metres.
        positions: Arc<Vec<Vec3>>,
    },
}

impl Stand {
    /// The view, for a picture of any size: it is to be drawn in parts where it is too large.
    pub(super) fn view(&self, size: Size) -> Result<View> {
        let Size { width, height } = size;
        match self {
            Self::Settings { settings, bounds } => Ok(settings.view(*bounds, width, height)),
            Self::Camera { camera, orientation, positions } => {
                // An exact camera fits nothing: its view is the same for every size, but for the size.
                let view = View::with_camera(camera, *orientation, positions, 1, 1)?;
                Ok(View { width, height, ..view })
            }
        }
    }

    /// With the garment turned as a named view says, and fitted where that is possible.
    pub(super) fn named(&self, named: NamedView) -> Self {
        let mut stand = self.clone();
        match &mut stand {
            Self::Settings { settings, .. } => settings.look(named),
            Self::Camera { orientation, .. } => {
                let angles = named.angles();
                let radians = |degrees: f64| degrees.to_radians() as f32;
                *orientation = Orientation {
                    yaw: radians(angles.yaw),
                    pitch: radians(angles.pitch),
                    roll: radians(angles.roll),
                };
            }
        }
        stand
    }

    /// With the garment turned further about its own vertical axis, by a share of a whole turn.
    pub(super) fn turned(&self, share: f64) -> Self {
        let angle = share * std::f64::consts::TAU;
        let mut stand = self.clone();
        match &mut stand {
            Self::Settings { settings, .. } => {
                settings.set_orientation(settings.orientation() * DQuat::from_rotation_y(angle));
            }
            Self::Camera { orientation, .. } => orientation.yaw += angle as f32,
        }
        stand
    }
}
