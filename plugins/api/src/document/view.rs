//! How the garment is looked at.

use amc_core::color::LINEAR_FROM_SRGB8;
use amc_core::render::{Bounds, Cyclic, Mode, Perspective, Projection, Shading, View};
use amc_core::{Error, Result};
use glam::{DMat3, DQuat, EulerRot, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::Comparison;

/// Half of the height of the film that focal lengths refer to, 36 x 24 mm.
const HALF_FRAME_MM: f64 = 12.0;

/// The nearest a perspective view shows, as a share of its far distance.
const NEAREST: f64 = 1e-3;

/// How view space becomes the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lens {
    /// Parallel lines of sight.
    #[default]
    Orthographic,
    /// A camera as far away as fits the object into the picture.
    Perspective {
        /// Millimetres, for a frame of 36 x 24 mm whose shorter side is the picture's. 12 to 1200.
        focal_length_mm: f32,
    },
}

/// How a drag turns the object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TurningStyle {
    /// As a ball that is held where it was grabbed.
    #[default]
    Arcball,
    /// About its own vertical axis, and towards the viewer or away: it stays upright.
    Turntable,
}

/// A view that has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NamedView {
    /// As the garment stands in its file: +z towards the viewer.
    Front,
    /// From behind.
    Back,
    /// The wearer's left side, +x, towards the viewer.
    Left,
    /// The wearer's right side.
    Right,
    /// From above: +y towards the viewer.
    Top,
    /// From below.
    Bottom,
}

impl NamedView {
    /// All of them, in the order of their keys, 1 to 6.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// How the object is turned in it.
    pub fn angles(self) -> Angles {
        let (yaw, pitch) = match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (180.0, 0.0),
            Self::Left => (-90.0, 0.0),
            Self::Right => (90.0, 0.0),
            Self::Top => (0.0, 90.0),
            Self::Bottom => (0.0, -90.0),
        };
        Angles { yaw, pitch, roll: 0.0 }
    }
}

/// How the object is turned, degrees: about y, then about x, then about z, each right-handed (the command line's `--yaw`,
/// `--pitch` and `--roll`).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Angles {
    /// About y, first.
    pub yaw: f64,
    /// About x, second.
    pub pitch: f64,
    /// About z, last.
    pub roll: f64,
}

/// How the garment is looked at: saved with the project, but no step of its undo.
///
/// The object turns; the camera and the light stay, for an AMC holds the look under one fixed lighting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewSettings {
    orientation: DQuat,
    /// Where the object's centre stands in the picture, from its middle to the right and up, in half heights of the
    /// picture.
    pub pan: Vec2,
    /// How much larger than fitted the object is, [`ViewSettings::LEAST_ZOOM`] to [`ViewSettings::MOST_ZOOM`]. In
    /// perspective it crops the picture: the camera does not move.
    pub zoom: f32,
    /// How view space becomes the picture.
    pub lens: Lens,
    /// The id of the shading mode ([`crate::ShadingChoice`]).
    pub mode: String,
    /// How the azimuth gets from vertices to fragments.
    pub cyclic: Cyclic,
    /// How normals and tangents are turned for perspective.
    pub perspective: Perspective,
    /// Whether ambient occlusion darkens the folds.
    pub occlusion: bool,
    /// sRGB-encoded; none: the window's own colour, and transparent in pictures that are saved.
    pub background: Option<[u8; 3]>,
    /// How a drag turns the object.
    pub turning: TurningStyle,
    /// Degrees per second about the object's vertical axis, right-handed; none: it stands still.
    pub auto_turn: Option<f32>,
    /// The other half of a split view; none: the view is not split.
    pub compared: Option<Comparison>,
}

impl Default for ViewSettings {
    fn default() -> Self {
        let Shading { cyclic, perspective, occlusion, .. } = Shading::default();
        Self {
            orientation: DQuat::IDENTITY,
            pan: Vec2::ZERO,
            zoom: 1.0,
            lens: Lens::default(),
            mode: "amc".to_owned(),
            cyclic,
            perspective,
            occlusion,
            background: None,
            turning: TurningStyle::default(),
            auto_turn: None,
            compared: None,
        }
    }
}

impl ViewSettings {
    /// The least zoom.
    pub const LEAST_ZOOM: f32 = 0.02;
    /// The most zoom.
    pub const MOST_ZOOM: f32 = 200.0;
    /// How far the object's centre may stand from the picture's middle, half heights.
    pub const MOST_PAN: f32 = 1e4;
    /// Shortest and longest focal length, millimetres.
    pub const FOCAL_LENGTHS_MM: [f32; 2] = [12.0, 1200.0];
    /// The fastest turn of its own, degrees per second.
    pub const MOST_AUTO_TURN: f32 = 3600.0;

    /// How the object is turned: object space to view space. A unit quaternion.
    pub fn orientation(&self) -> DQuat {
        self.orientation
    }

    /// Turns the object; `orientation` is made a unit quaternion. One that cannot be is not taken.
    pub fn set_orientation(&mut self, orientation: DQuat) {
        let unit = orientation.normalize();
        if unit.is_finite() {
            self.orientation = unit;
        }
    }

    /// How the object is turned, in degrees: yaw and roll -180 to 180, pitch -90 to 90.
    pub fn angles(&self) -> Angles {
        let (roll, pitch, yaw) = self.orientation.to_euler(EulerRot::ZXY);
        // No minus before a zero.
        let [yaw, pitch, roll] = [yaw, pitch, roll].map(|angle| angle.to_degrees() + 0.0);
        Angles { yaw, pitch, roll }
    }

    /// Turns the object. Angles that are not finite are not taken.
    pub fn set_angles(&mut self, Angles { yaw, pitch, roll }: Angles) {
        let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_radians);
        self.set_orientation(DQuat::from_euler(EulerRot::ZXY, roll, pitch, yaw));
    }

    /// Turns the object as `named` says, and fits it into the picture.
    pub fn look(&mut self, named: NamedView) {
        self.set_angles(named.angles());
        self.fit();
    }

    /// Fits the whole object into the picture.
    pub fn fit(&mut self) {
        (self.pan, self.zoom) = (Vec2::ZERO, 1.0);
    }

    /// Whether all of it makes sense.
    ///
    /// # Errors
    /// A number that is not finite or out of its range; the error names it.
    pub fn check(&self) -> Result<()> {
        let within = |what: &str, value: f32, [low, high]: [f32; 2]| {
            if (low..=high).contains(&value) {
                return Ok(());
            }
            let fault = format!("{value} is not between {low} and {high}");
            Err(Error::invalid(fault).at_element(format!("view, {what}")))
        };
        if (self.orientation.length() - 1.0).abs() > 1e-3 || !self.orientation.is_finite() {
            let fault = "no turn: the four numbers must make a unit quaternion";
            return Err(Error::invalid(fault).at_element("view, orientation"));
        }
        within("pan", self.pan.x, [-Self::MOST_PAN, Self::MOST_PAN])?;
        within("pan", self.pan.y, [-Self::MOST_PAN, Self::MOST_PAN])?;
        within("zoom", self.zoom, [Self::LEAST_ZOOM, Self::MOST_ZOOM])?;
        if let Lens::Perspective { focal_length_mm } = self.lens {
            within("focal length", focal_length_mm, Self::FOCAL_LENGTHS_MM)?;
        }
        let turned = self.compared.as_ref().map_or(0.0, |compared| compared.turned_deg);
        within("compared, turned_deg", turned, [-360.0, 360.0])?;
        within("auto turn", self.auto_turn.unwrap_or(0.0), [-Self::MOST_AUTO_TURN, Self::MOST_AUTO_TURN])
    }

    /// The view of an object of these bounds in a picture of `width` x `height` pixels. With the settings' defaults it is
    /// [`View::fitted`].
    pub fn view(&self, bounds: Bounds, width: u32, height: u32) -> View {
        let mut view = View::around(bounds, DMat3::from_quat(self.orientation), width, height);
        let half_height = self.half_height(bounds, width, height);
        let mut distance = 0.0;
        view.projection = match self.lens {
            Lens::Orthographic => Projection::Orthographic { half_height: half_height as f32 },
            Lens::Perspective { focal_length_mm } => {
                distance = self.distance(bounds, focal_length_mm);
                let (nearest, farthest) = (distance - 1.01 * bounds.radius, distance + 1.01 * bounds.radius);
                (view.near, view.far) = (nearest.max(farthest * NEAREST) as f32, farthest as f32);
                Projection::Perspective { fov_y: (2.0 * (half_height / distance).atan()) as f32 }
            }
        };
        let shift = self.pan * half_height as f32;
        view.object_to_view.w_axis += Vec3::new(shift.x, shift.y, -distance as f32).extend(0.0);
        view
    }

    /// Half of the picture's height in the plane of the object's centre, metres.
    pub fn half_height(&self, bounds: Bounds, width: u32, height: u32) -> f64 {
        let shorter_side = (f64::from(width) / f64::from(height)).min(1.0);
        let fitted = match self.lens {
            Lens::Orthographic => bounds.radius,
            Lens::Perspective { focal_length_mm } => {
                self.distance(bounds, focal_length_mm) * HALF_FRAME_MM / f64::from(focal_length_mm)
            }
        };
        fitted / shorter_side / f64::from(self.zoom)
    }

    /// From the eye to the object's centre, metres: the sphere of its bounds touches the frame's longer sides.
    fn distance(&self, bounds: Bounds, focal_length_mm: f32) -> f64 {
        let tangent = HALF_FRAME_MM / f64::from(focal_length_mm);
        bounds.radius * (1.0 + tangent.powi(-2)).sqrt()
    }

    /// How the garment is shaded, but for the mode, which is [`Mode::Amc`]: [`crate::Stage::shading`] knows all modes.
    pub fn shading(&self) -> Shading {
        let linear = |encoded: u8| LINEAR_FROM_SRGB8[usize::from(encoded)];
        Shading {
            mode: Mode::Amc,
            cyclic: self.cyclic,
            perspective: self.perspective,
            occlusion: self.occlusion,
            background: self.background.map(|colour| colour.map(linear)),
            ..Shading::default()
        }
    }
}

#[cfg(test)]
mod tests;
