//! Cameras: the exact one of a file, and the one fitted to the object.

use std::path::Path;

use glam::{DMat3, DMat4, DVec3, Mat4, Vec2, Vec3};
use serde::Deserialize;

use super::view::check_size;
use super::{Projection, View};
use crate::error::Place;
use crate::{Error, Result, file};

/// How far the columns of a camera's matrix may be from an orthonormal frame: files print few digits.
const RIGID_TOLERANCE: f64 = 1e-4;

/// The largest camera file, bytes.
const FILE_LIMIT: u64 = 1 << 20;

/// The nearest a perspective view shows, as a share of its far distance: nearer, 32-bit depth cannot tell surfaces
/// apart.
const NEAREST: f64 = 1e-3;

/// How the object is turned before the camera, radians: `p' = Rz(roll) Rx(pitch) Ry(yaw) p`, right-handed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Orientation {
    /// About y, first.
    pub yaw: f32,
    /// About x, second.
    pub pitch: f32,
    /// About z, last.
    pub roll: f32,
}

impl Orientation {
    /// The turn as a matrix.
    pub fn rotation(self) -> DMat3 {
        DMat3::from_rotation_z(self.roll.into())
            * DMat3::from_rotation_x(self.pitch.into())
            * DMat3::from_rotation_y(self.yaw.into())
    }
}

/// An exact camera: where the world stands before it, and its projection.
///
/// As JSON: `{"world_to_view": [16 numbers, column-major], "projection": {"orthographic": {"half_height": h}}}` or
/// `{"perspective": {"fov_y_deg": a}}`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// A rotation and a shift; metres.
    pub world_to_view: DMat4,
    /// How view space becomes the picture.
    pub projection: Projection,
}

/// The file, as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraFile {
    world_to_view: [f64; 16],
    projection: ProjectionFile,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum ProjectionFile {
    Orthographic { half_height: f32 },
    Perspective { fov_y_deg: f32 },
}

impl Camera {
    /// Reads a camera file.
    ///
    /// # Errors
    /// It cannot be read, or is no camera (see [`Camera::from_json`]); the error names the file.
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_json(&file::read(path, FILE_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// A camera from JSON.
    ///
    /// # Errors
    /// Not JSON, keys missing or unknown (with line and column); a matrix that is no rotation and shift; a projection
    /// without extent.
    pub fn from_json(json: &[u8]) -> Result<Self> {
        let file: CameraFile = serde_json::from_slice(json).map_err(json_error)?;
        let world_to_view = DMat4::from_cols_array(&file.world_to_view);
        check_rigid(&world_to_view).map_err(|error| error.at_element("world_to_view"))?;
        let projection = file.projection.checked().map_err(|error| error.at_element("projection"))?;
        Ok(Self { world_to_view, projection })
    }
}

impl ProjectionFile {
    fn checked(self) -> Result<Projection> {
        match self {
            Self::Orthographic { half_height } if half_height > 0.0 && half_height.is_finite() => {
                Ok(Projection::Orthographic { half_height })
            }
            Self::Orthographic { half_height } => {
                Err(Error::invalid(format!("half_height is {half_height}, but must be positive")))
            }
            Self::Perspective { fov_y_deg } if fov_y_deg > 0.0 && fov_y_deg < 180.0 => {
                Ok(Projection::Perspective { fov_y: fov_y_deg.to_radians() })
            }
            Self::Perspective { fov_y_deg } => {
                Err(Error::invalid(format!("fov_y_deg is {fov_y_deg}, but must lie between 0 and 180")))
            }
        }
    }
}

fn json_error(error: serde_json::Error) -> Error {
    let place = Place::LineColumn(error.line() as u64, error.column() as u64);
    // The message ends with the place, which is told already.
    let message = error.to_string();
    let what = message.rfind(" at line ").map_or(message.as_str(), |end| &message[..end]);
    let error = Error::malformed(format!("no camera: {what}"));
    if matches!(place, Place::LineColumn(0, _)) { error } else { error.at(place) }
}

/// Whether a matrix is a rotation and a shift.
fn check_rigid(matrix: &DMat4) -> Result<()> {
    let [x, y, z, shift] = [matrix.x_axis, matrix.y_axis, matrix.z_axis, matrix.w_axis];
    let last_row = [x.w, y.w, z.w, shift.w - 1.0];
    if !matrix.is_finite() || last_row.iter().any(|value| value.abs() > RIGID_TOLERANCE) {
        let what = "the last row of the matrix must be 0 0 0 1 (the 16 numbers are column by column)";
        return Err(Error::invalid(what));
    }
    let rotation = DMat3::from_cols(x.truncate(), y.truncate(), z.truncate());
    let error = rotation.transpose() * rotation - DMat3::IDENTITY;
    let worst = error.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    if worst > RIGID_TOLERANCE {
        return Err(Error::invalid(format!(
            "the matrix scales or shears (by {worst:.1e}); it must be a rotation and a shift"
        )));
    }
    if rotation.determinant() < 0.0 {
        return Err(Error::invalid("the matrix mirrors; it must be a rotation and a shift"));
    }
    Ok(())
}

/// The least box around points.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: DVec3,
    high: DVec3,
}

impl Extent {
    fn of(positions: impl Iterator<Item = DVec3>) -> Self {
        let nothing = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        positions.fold(nothing, |extent, p| Self { low: extent.low.min(p), high: extent.high.max(p) })
    }
}

/// What a view is fitted to: the sphere about the centre of the least box around the vertices that holds them all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Object space, metres.
    pub centre: DVec3,
    /// Metres.
    pub radius: f64,
}

impl Bounds {
    /// Of positions in object space, metres.
    ///
    /// # Errors
    /// No positions, all of them at one point, or not finite.
    pub fn of(positions: &[Vec3]) -> Result<Self> {
        check_positions(positions)?;
        let Extent { low, high } = Extent::of(positions.iter().map(|p| p.as_dvec3()));
        let centre = (low + high) / 2.0;
        let squares = positions.iter().map(|p| p.as_dvec3().distance_squared(centre));
        let radius = squares.fold(0.0, f64::max).sqrt();
        if (radius as f32) < f32::MIN_POSITIVE {
            return Err(Error::invalid("all vertices stand at one point: there is nothing to see"));
        }
        Ok(Self { centre, radius })
    }
}

fn check_positions(positions: &[Vec3]) -> Result<()> {
    if positions.is_empty() {
        return Err(Error::invalid("nothing to look at: the mesh has no vertices"));
    }
    match positions.iter().position(|p| !p.is_finite()) {
        Some(index) => {
            Err(Error::invalid("the position is not finite").at_element(format!("vertex {index}")))
        }
        None => Ok(()),
    }
}

impl View {
    /// The view in which the object is centred on its bounding box, turned, and seen in parallel lines of sight; half the
    /// picture's height is the largest distance of a vertex from that centre, divided by min(1, width/height).
    /// `positions` in object space, metres.
    ///
    /// # Errors
    /// No vertices, all of them at one point, or not finite; a picture that is empty or over the limits of [`View`].
    pub fn fitted(positions: &[Vec3], orientation: Orientation, width: u32, height: u32) -> Result<Self> {
        check_size(width, height)?;
        let view = Self::around(Bounds::of(positions)?, orientation.rotation(), width, height);
        view.check()?;
        Ok(view)
    }

    /// As [`View::fitted`], around `bounds` and turned by `rotation`; not checked.
    pub fn around(bounds: Bounds, rotation: DMat3, width: u32, height: u32) -> Self {
        let Bounds { centre, radius } = bounds;
        let half_height = radius / (f64::from(width) / f64::from(height)).min(1.0);
        Self {
            object_to_view: (DMat4::from_mat3(rotation) * DMat4::from_translation(-centre)).as_mat4(),
            projection: Projection::Orthographic { half_height: half_height as f32 },
            width,
            height,
            near: (radius * -1.01) as f32,
            far: (radius * 1.01) as f32,
            shift: Vec2::ZERO,
        }
    }

    /// The view of an exact camera: the object as it is in its file, turned about the file's origin. `positions` in object
    /// space, metres: near and far are set so that all of it is drawn, save what lies behind the eye or, in perspective,
    /// nearer than a thousandth of the farthest.
    ///
    /// # Errors
    /// No vertices, or not finite; a picture that is empty or over the limits of [`View`]; a camera that is not rigid.
    pub fn with_camera(
        camera: &Camera,
        orientation: Orientation,
        positions: &[Vec3],
        width: u32,
        height: u32,
    ) -> Result<Self> {
        check_size(width, height)?;
        check_positions(positions)?;
        check_rigid(&camera.world_to_view)?;
        let object_to_view = camera.world_to_view * DMat4::from_mat3(orientation.rotation());
        let seen = Extent::of(positions.iter().map(|p| object_to_view.transform_point3(p.as_dvec3())));
        let (near, far) = depths(camera.projection, -seen.high.z, -seen.low.z);
        let object_to_view: Mat4 = object_to_view.as_mat4();
        let projection = camera.projection;
        let view = Self { object_to_view, projection, width, height, near, far, shift: Vec2::ZERO };
        view.check()?;
        Ok(view)
    }
}

/// The near and far distance for an object between two depths along the line of sight.
fn depths(projection: Projection, nearest: f64, farthest: f64) -> (f32, f32) {
    // A margin, so that rounding clips nothing; for a flat object facing the camera there must be some depth at all.
    let margin = (farthest - nearest).max(farthest.abs() * 1e-3).max(1e-6) * 0.01;
    match projection {
        Projection::Orthographic { .. } => ((nearest - margin) as f32, (farthest + margin) as f32),
        Projection::Perspective { .. } => {
            // All of it behind the eye: any view in front of the eye is as empty.
            let far = if farthest > 0.0 { farthest + margin } else { 1.0 };
            let near = (nearest - margin).max(far * NEAREST);
            (near as f32, far as f32)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

    const IDENTITY: &str = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,-5,1]";

    fn camera(matrix: &str, projection: &str) -> Result<Camera> {
        Camera::from_json(
            format!("{{\"world_to_view\": {matrix},\n \"projection\": {projection}}}").as_bytes(),
        )
    }

    #[test]
    fn a_camera_file_is_read_column_by_column() {
        let camera = camera(IDENTITY, r#"{"perspective": {"fov_y_deg": 90}}"#).unwrap();
        assert_eq!(camera.world_to_view.transform_point3(DVec3::ZERO), DVec3::new(0.0, 0.0, -5.0));
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        assert!((fov_y - FRAC_PI_2).abs() < 1e-6);
    }

    #[test]
    fn faults_in_a_camera_file_are_named_with_their_place() {
        let orthographic = r#"{"orthographic": {"half_height": 1}}"#;
        let message = |matrix: &str, projection: &str| camera(matrix, projection).unwrap_err().to_string();
        assert!(message("[1,2]", orthographic).contains("line 1, column"));
        assert!(message(IDENTITY, r#"{"orthographic": {"half_hight": 1}}"#).contains("line 2, column"));
        assert!(message(IDENTITY, r#"{"orthographic": {"half_height": 0}}"#).contains("half_height is 0"));
        assert!(message(IDENTITY, r#"{"perspective": {"fov_y_deg": 180}}"#).contains("fov_y_deg is 180"));
        assert!(message("[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]", orthographic).contains("scales"));
        assert!(message("[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", orthographic).contains("mirrors"));
        assert!(message("[1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1]", orthographic).contains("last row"));
        assert!(Camera::from_json(b"").unwrap_err().to_string().contains("no camera"));
    }

    fn box_corners() -> Vec<Vec3> {
        let bit = |k: u32, b: u32| f32::from((k >> b & 1) as u8);
        (0..8).map(|k| Vec3::new(1.0 + 2.0 * bit(k, 0), -1.0 + 4.0 * bit(k, 1), 4.0 * bit(k, 2))).collect()
    }

    #[test]
    fn the_fitted_view_holds_the_object_at_every_orientation_and_shape_of_picture() {
        // Half the diagonal of a 2 x 4 x 4 box is 3.
        for (width, height, half_height) in [(100, 50, 3.0), (50, 100, 6.0), (64, 64, 3.0)] {
            for turn in 0..8 {
                let turn = turn as f32 * FRAC_PI_4;
                let orientation = Orientation { yaw: turn, pitch: turn / 3.0, roll: turn / 2.0 };
                let view = View::fitted(&box_corners(), orientation, width, height).unwrap();
                let Projection::Orthographic { half_height: found } = view.projection else {
                    panic!("parallel")
                };
                assert!((found - half_height).abs() < 1e-5);
                for corner in box_corners() {
                    let clip = view.view_to_clip() * view.object_to_view * corner.extend(1.0);
                    assert!(clip.x.abs() <= 1.0 && clip.y.abs() <= 1.0 && (0.0..=1.0).contains(&clip.z));
                }
            }
        }
    }

    #[test]
    fn yaw_comes_first_then_pitch_then_roll_each_right_handed() {
        let turned =
            |yaw: f32, pitch: f32, roll: f32, p: DVec3| Orientation { yaw, pitch, roll }.rotation() * p;
        let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-6, "{a} {b}");
        close(turned(FRAC_PI_2, 0.0, 0.0, DVec3::Z), DVec3::X);
        close(turned(0.0, FRAC_PI_2, 0.0, DVec3::Y), DVec3::Z);
        close(turned(0.0, 0.0, FRAC_PI_2, DVec3::X), DVec3::Y);
        // x goes to -z by yaw, from there to y by pitch, from there to -x by roll.
        close(turned(FRAC_PI_2, FRAC_PI_2, FRAC_PI_2, DVec3::X), -DVec3::X);
    }

    #[test]
    fn depths_hold_the_object_and_stay_in_front_of_the_eye() {
        let camera = camera(IDENTITY, r#"{"perspective": {"fov_y_deg": 45}}"#).unwrap();
        let view = |shift: f32| {
            let positions: Vec<Vec3> = box_corners().iter().map(|p| *p + Vec3::Z * shift).collect();
            View::with_camera(&camera, Orientation::default(), &positions, 10, 10).unwrap()
        };
        let before = view(-2.0);
        assert!(before.near < 3.0 && before.near > 2.5 && before.far > 7.0 && before.far < 7.5);
        let around = view(3.0);
        assert!(around.near > 0.0 && around.near < 0.01 && around.far > 2.0);
        assert!(view(50.0).near > 0.0);
    }

    #[test]
    fn what_cannot_be_looked_at_is_refused() {
        let fitted = |positions: &[Vec3], width| {
            View::fitted(positions, Orientation::default(), width, 10).unwrap_err().to_string()
        };
        assert!(fitted(&[], 10).contains("no vertices"));
        assert!(fitted(&[Vec3::ONE; 3], 10).contains("one point"));
        assert!(fitted(&[Vec3::ONE, Vec3::NAN], 10).contains("vertex 1"));
        assert!(fitted(&box_corners(), 0).contains("0 x 10"));
        assert!(fitted(&box_corners(), 16_385).contains("16385"));
    }
}
