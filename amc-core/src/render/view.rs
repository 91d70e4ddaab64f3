//! From where a drawing is seen.

use glam::{Mat3, Mat4, Vec2, Vec3};

use crate::{Error, Result};

/// How view space becomes the picture. The picture's centre is the optical axis, unless [`View::shift`] says otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Parallel lines of sight.
    Orthographic {
        /// Half of the picture's height, metres.
        half_height: f32,
    },
    /// Through the origin of view space.
    Perspective {
        /// Vertical field of view, radians.
        fov_y: f32,
    },
}

/// A half line: where a line of sight meets the near plane, and where it goes from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts, metres.
    pub origin: Vec3,
    /// Unit.
    pub direction: Vec3,
}

/// A view: where the object stands before the camera, the projection, and the picture's size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Object space to view space: a rotation and a shift, no scale.
    pub object_to_view: Mat4,
    /// How view space becomes the picture.
    pub projection: Projection,
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Distances along -z between which things are drawn, metres. `near` is positive in perspective.
    pub near: f32,
    /// See `near`.
    pub far: f32,
    /// How far the optical axis stands from the picture's middle, pixels to the right and down. 0, but for parts of a
    /// larger picture ([`View::part`]).
    pub shift: Vec2,
}

/// A rectangle of a picture, pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Its first column.
    pub left: u32,
    /// Its first row from the top.
    pub top: u32,
    /// Its columns.
    pub width: u32,
    /// Its rows.
    pub height: u32,
}

impl View {
    /// The largest width and height of a picture that is drawn at once; larger ones are drawn in parts ([`View::part`]).
    pub const SIDE_LIMIT: u32 = 16_384;

    /// The most pixels of a picture that is drawn at once: 1 GiB of them.
    pub const PIXEL_LIMIT: u64 = 1 << 26;

    /// Whether a picture can be drawn from this view.
    ///
    /// # Errors
    /// The picture is empty or over a limit, a number is not finite, or the projection has no extent.
    pub fn check(&self) -> Result<()> {
        check_size(self.width, self.height)?;
        let positive = match self.projection {
            Projection::Orthographic { half_height } => half_height > 0.0 && half_height.is_finite(),
            Projection::Perspective { fov_y } => {
                fov_y > 0.0 && fov_y < std::f32::consts::PI && self.near > 0.0
            }
        };
        if !positive {
            return Err(Error::invalid(
                "the view has no extent: half height and near distance must be positive, the field of view within 0 to 180 degrees",
            ));
        }
        let in_order = self.far > self.near && (self.far - self.near).is_finite();
        if !in_order || !self.view_to_clip().is_finite() || !self.object_to_view.is_finite() {
            return Err(Error::invalid(
                "the view's numbers are not finite, or its far distance is not beyond its near one",
            ));
        }
        Ok(())
    }

    /// The view whose picture is a part of this one's, pixel for pixel: for pictures that are larger than can be drawn at
    /// once. `self` need not pass [`View::check`]; the part must. Parts at even columns and rows of 2x2 blocks of pixels
    /// take derivatives as the whole does.
    pub fn part(&self, part: Part) -> Self {
        let Part { left, top, width, height } = part;
        if part == (Part { left: 0, top: 0, width: self.width, height: self.height }) {
            return *self;
        }
        let share = f64::from(height) / f64::from(self.height);
        let projection = match self.projection {
            Projection::Orthographic { half_height } => {
                Projection::Orthographic { half_height: (f64::from(half_height) * share) as f32 }
            }
            Projection::Perspective { fov_y } => {
                let slope = (f64::from(fov_y) / 2.0).tan() * share;
                Projection::Perspective { fov_y: (2.0 * slope.atan()) as f32 }
            }
        };
        let middle = |whole: u32, start: u32, length: u32| {
            (f64::from(whole) / 2.0 - f64::from(start) - f64::from(length) / 2.0) as f32
        };
        let shift = Vec2::new(middle(self.width, left, width), middle(self.height, top, height)) + self.shift;
        Self { projection, width, height, shift, ..*self }
    }

    /// View space to clip space: x right, y up, depth 0 at `near` to 1 at `far` (wgpu's).
    pub fn view_to_clip(&self) -> Mat4 {
        let aspect = self.width as f32 / self.height as f32;
        let axis = self.shift * Vec2::new(2.0, -2.0) / self.size();
        match self.projection {
            Projection::Orthographic { half_height } => {
                let half_width = half_height * aspect;
                let depth = self.far - self.near;
                Mat4::from_cols_array(&[
                    1.0 / half_width,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    1.0 / half_height,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    -1.0 / depth,
                    0.0,
                    axis.x,
                    axis.y,
                    -self.near / depth,
                    1.0,
                ])
            }
            Projection::Perspective { fov_y } => {
                let f = 1.0 / (fov_y / 2.0).tan();
                let depth = self.far - self.near;
                Mat4::from_cols_array(&[
                    f / aspect,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    f,
                    0.0,
                    0.0,
                    -axis.x,
                    -axis.y,
                    -self.far / depth,
                    -1.0,
                    0.0,
                    0.0,
                    -self.near * self.far / depth,
                    0.0,
                ])
            }
        }
    }

    /// The line of sight through the picture's point `at`, in object space. `at` in pixels from the top-left corner of the
    /// picture: pixel centres are at +0.5.
    pub fn ray(&self, at: Vec2) -> Ray {
        let size = self.size();
        let slope = ((at - self.shift) * 2.0 - size) / size.y * Vec2::new(1.0, -1.0);
        let (origin, direction) = match self.projection {
            Projection::Orthographic { half_height } => {
                ((slope * half_height).extend(-self.near), Vec3::NEG_Z)
            }
            Projection::Perspective { fov_y } => {
                let towards = (slope * (fov_y / 2.0).tan()).extend(-1.0);
                (towards * self.near, towards.normalize_or(Vec3::NEG_Z))
            }
        };
        // The inverse of a rotation is its transpose.
        let to_object = self.rotation().transpose();
        let shift = self.object_to_view.w_axis.truncate();
        Ray { origin: to_object * (origin - shift), direction: to_object * direction }
    }

    /// The unit vector from a point of view space towards the eye.
    pub fn towards_eye(&self, p: Vec3) -> Vec3 {
        match self.projection {
            Projection::Orthographic { .. } => Vec3::Z,
            Projection::Perspective { .. } => (-p).try_normalize().unwrap_or(Vec3::Z),
        }
    }

    /// Columns and rows.
    fn size(&self) -> Vec2 {
        Vec2::new(self.width as f32, self.height as f32)
    }

    /// Turns directions from object space to view space.
    pub fn rotation(&self) -> Mat3 {
        Mat3::from_mat4(self.object_to_view)
    }
}

/// Whether a picture of this size can be drawn.
pub(super) fn check_size(width: u32, height: u32) -> Result<()> {
    let sides = 1..=View::SIDE_LIMIT;
    let pixels = u64::from(width) * u64::from(height);
    if sides.contains(&width) && sides.contains(&height) && pixels <= View::PIXEL_LIMIT {
        return Ok(());
    }
    Err(Error::too_large(format!(
        "a picture of {width} x {height} pixels; each side must hold 1 to {}, and all {} at most",
        View::SIDE_LIMIT,
        View::PIXEL_LIMIT
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_runs_through_everything_that_is_drawn_at_its_pixel() {
        let object_to_view = Mat4::from_translation(Vec3::new(0.3, -0.2, -4.0))
            * Mat4::from_rotation_y(0.7)
            * Mat4::from_rotation_x(-0.4);
        for projection in
            [Projection::Orthographic { half_height: 1.5 }, Projection::Perspective { fov_y: 0.9 }]
        {
            let shift = Vec2::new(-13.0, 41.5);
            let view =
                View { object_to_view, projection, width: 320, height: 200, near: 2.0, far: 6.0, shift };
            for at in [Vec2::new(0.5, 0.5), Vec2::new(160.0, 100.0), Vec2::new(301.0, 27.0)] {
                let ray = view.ray(at);
                for distance in [0.0, 0.5, 3.0] {
                    let point = ray.origin + ray.direction * distance;
                    let clip = view.view_to_clip() * view.object_to_view * point.extend(1.0);
                    let on_picture = clip.truncate() / clip.w;
                    let seen = (on_picture.truncate() * Vec2::new(0.5, -0.5) + 0.5) * Vec2::new(320.0, 200.0);
                    assert!((seen - at).length() < 2e-3, "{projection:?} {at} {seen}");
                    assert!(distance > 0.0 || on_picture.z.abs() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn a_point_is_seen_at_the_same_place_in_the_whole_and_in_a_part() {
        let object_to_view = Mat4::from_translation(Vec3::new(0.1, 0.2, -4.0)) * Mat4::from_rotation_y(0.7);
        for projection in
            [Projection::Orthographic { half_height: 1.5 }, Projection::Perspective { fov_y: 0.9 }]
        {
            let shift = Vec2::new(3.0, -5.0);
            let whole =
                View { object_to_view, projection, width: 640, height: 400, near: 2.0, far: 6.0, shift };
            let part = whole.part(Part { left: 416, top: 18, width: 200, height: 62 });
            // A part of a part is a part of the whole.
            let inner = part.part(Part { left: 30, top: 2, width: 100, height: 58 });
            let seen = |view: &View, point: Vec3| {
                let clip = view.view_to_clip() * view.object_to_view * point.extend(1.0);
                let place = clip.truncate() / clip.w;
                ((place.truncate() * Vec2::new(0.5, -0.5) + 0.5) * view.size()).extend(place.z)
            };
            for point in [Vec3::ZERO, Vec3::new(0.7, -0.4, 0.2), Vec3::new(-1.0, 1.0, -0.5)] {
                let (on_whole, on_part) = (seen(&whole, point), seen(&part, point));
                assert!((on_part + Vec3::new(416.0, 18.0, 0.0) - on_whole).length() < 2e-3, "{projection:?}");
                let on_inner = seen(&inner, point) + Vec3::new(446.0, 20.0, 0.0);
                assert!((on_inner - on_whole).length() < 2e-3, "{projection:?}");
            }
        }
    }
}
