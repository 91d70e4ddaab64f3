//! How the camera sees the ball: which pixel shows which normal.
//!
//! A pinhole camera sees a ball inside a cone of half-angle A about the direction c of its centre, whose outline in
//! the picture is an ellipse. All of this is exact, at any distance. Pixel coordinates: (0, 0) is the picture's
//! top-left corner, x right, y down, pixel centres at +0.5.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::amc::Frame;
use crate::{Error, Result};

/// The camera: pinhole, square pixels, its axis through the picture's centre; or parallel lines of sight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lens {
    Orthographic,
    Pinhole {
        /// Focal length in pixels.
        focal: f64,
        /// Where the optical axis meets the picture.
        centre: DVec2,
    },
}

impl Lens {
    /// A lens of this horizontal field of view in radians; `None` is orthographic.
    pub(super) fn new(horizontal_fov: Option<f64>, width: u32, height: u32) -> Result<Self> {
        let Some(fov) = horizontal_fov else { return Ok(Self::Orthographic) };
        if !(fov > 0.0 && fov < PI) {
            return Err(Error::invalid(format!(
                "a horizontal field of view of {} degrees; it must lie between 0 and 180",
                fov.to_degrees()
            )));
        }
        let centre = DVec2::new(f64::from(width), f64::from(height)) / 2.0;
        Ok(Self::Pinhole { focal: centre.x / (fov / 2.0).tan(), centre })
    }
}

/// The unit direction, in view space, in which a pinhole camera sees a pixel.
pub(super) fn ray(focal: f64, centre: DVec2, pixel: DVec2) -> DVec3 {
    let at = pixel - centre;
    DVec3::new(at.x, -at.y, -focal) / (at.length_squared() + focal * focal).sqrt()
}

/// Where a ball stands before the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sight {
    /// Parallel lines of sight: the outline is a circle.
    Parallel { centre: DVec2, radius: f64 },
    /// A pinhole camera.
    Cone(Cone),
}

/// The cone in which a pinhole camera sees the ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cone {
    focal: f64,
    centre: DVec2,
    /// Takes the axes about c (x, y, and z from the ball to the camera) to view space: the least rotation of the
    /// optical axis to c.
    axes: DMat3,
    half_angle: f64,
}

/// What a table's normal looks like in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    /// Where in the picture.
    pub(super) pixel: DVec2,
    /// The ball's true normal there, about c.
    pub(super) normal: DVec3,
}

impl Cone {
    /// The cone about the unit direction `towards` (z < 0) of this half-angle in radians.
    pub(super) fn new(focal: f64, centre: DVec2, towards: DVec3, half_angle: f64) -> Self {
        let axes = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, -towards));
        Self { focal, centre, axes, half_angle }
    }

    /// The direction of the ball's centre.
    pub(super) fn towards(&self) -> DVec3 {
        -self.axes.z_axis
    }

    pub(super) fn half_angle(&self) -> f64 {
        self.half_angle
    }

    /// The same camera's cone about another direction.
    pub(super) fn with(&self, towards: DVec3, half_angle: f64) -> Self {
        Self::new(self.focal, self.centre, towards, half_angle)
    }

    /// A view-space direction along the axes about c.
    pub(super) fn local(&self, direction: DVec3) -> DVec3 {
        self.axes.transpose() * direction
    }

    /// A direction given along the axes about c, in view space.
    pub(super) fn carried(&self, local: DVec3) -> DVec3 {
        self.axes * local
    }

    /// The pixel at the angle `delta` off c, at an azimuth about c given by its cosine and sine. `None` behind the
    /// camera.
    fn pixel(&self, delta: f64, azimuth: DVec2) -> Option<DVec2> {
        let (sin, cos) = delta.sin_cos();
        let direction = self.axes * DVec3::new(sin * azimuth.x, sin * azimuth.y, -cos);
        (direction.z < -1e-6)
            .then(|| self.centre + DVec2::new(direction.x, -direction.y) * (self.focal / -direction.z))
    }

    /// The angle of a pixel off c.
    fn delta(&self, pixel: DVec2) -> f64 {
        let q = ray(self.focal, self.centre, pixel);
        let c = self.towards();
        q.cross(c).length().atan2(q.dot(c))
    }

    /// Pixels per radian across the outline at a pixel, along the direction away from c.
    pub(super) fn scale(&self, pixel: DVec2) -> f64 {
        let local = self.local(ray(self.focal, self.centre, pixel));
        let azimuth = DVec2::new(local.x, local.y).normalize_or(DVec2::X);
        let delta = self.delta(pixel);
        let step = 1e-5;
        match (self.pixel(delta + step, azimuth), self.pixel(delta - step, azimuth)) {
            (Some(out), Some(inn)) => out.distance(inn) / (2.0 * step),
            _ => self.focal,
        }
    }

    /// The outline's semi-axes in pixels: a cone of half-angle A about a direction b off the optical axis meets the
    /// picture in an ellipse of `f sin A cos A / (cos^2 b - sin^2 A)` and `f sin A / sqrt(cos^2 b - sin^2 A)`.
    fn mean_semi_axis(&self) -> f64 {
        let (sin, cos) = self.half_angle.sin_cos();
        let off_axis = self.towards().z;
        let open = (off_axis * off_axis - sin * sin).max(1e-12);
        self.focal * sin * (cos / open + 1.0 / open.sqrt()) / 2.0
    }
}

impl Sight {
    /// The ball whose centre's line meets the picture at `at`, its outline's mean semi-axis `radius` pixels.
    pub(super) fn new(lens: Lens, at: DVec2, radius: f64) -> Result<Self> {
        if !(at.is_finite() && radius.is_finite() && radius > 0.0) {
            return Err(Error::invalid(format!(
                "a ball at {}, {} of radius {radius}; all three must be numbers, the radius above 0",
                at.x, at.y
            )));
        }
        let Lens::Pinhole { focal, centre } = lens else { return Ok(Self::Parallel { centre: at, radius }) };
        let towards = ray(focal, centre, at);
        let off_axis = (-towards.z).clamp(-1.0, 1.0).acos();
        // The semi-axis rises with the angle, without bound where the cone touches the picture's plane.
        let (mut low, mut high) = (0.0, FRAC_PI_2 - off_axis - 1e-6);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if Cone::new(focal, centre, towards, middle).mean_semi_axis() < radius {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(Self::Cone(Cone::new(focal, centre, towards, (low + high) / 2.0)))
    }

    /// Where the line to the ball's centre meets the picture, and the outline's mean semi-axis, in pixels.
    pub(super) fn ball(&self) -> (DVec2, f64) {
        match self {
            Self::Parallel { centre, radius } => (*centre, *radius),
            Self::Cone(cone) => (cone.pixel(0.0, DVec2::X).unwrap_or(cone.centre), cone.mean_semi_axis()),
        }
    }

    /// The half-angle of the cone, radians; 0 for parallel lines of sight.
    pub(super) fn half_angle(&self) -> f64 {
        match self {
            Self::Parallel { .. } => 0.0,
            Self::Cone(cone) => cone.half_angle,
        }
    }

    /// The share of what the camera sees of the ball, in the table, that lies within a picture of this size.
    pub(super) fn share_within(&self, frame: Frame, width: u32, height: u32) -> f64 {
        // As many places as tell a hundredth.
        const SIDE: u32 = 48;
        let at = |k: u32| f64::from(2 * k + 1) / f64::from(SIDE) - 1.0;
        let size = DVec2::new(f64::from(width), f64::from(height));
        let (mut seen, mut within) = (0u32, 0u32);
        for k in 0..SIDE * SIDE {
            if let Some(Seen { pixel, .. }) = self.seen(DVec2::new(at(k % SIDE), at(k / SIDE)), frame) {
                seen += 1;
                within += u32::from(pixel.cmpge(DVec2::ZERO).all() && pixel.cmple(size).all());
            }
        }
        f64::from(within) / f64::from(seen.max(1))
    }

    /// Where the table's normal `n_xy`, in `frame`, is seen; `None` where it never is: outside of the disc, or in
    /// the rim of A/2 that frame `half` leaves.
    pub(super) fn seen(&self, n_xy: DVec2, frame: Frame) -> Option<Seen> {
        let sin_theta = n_xy.length();
        if sin_theta >= 1.0 {
            return None;
        }
        let cone = match self {
            Self::Parallel { centre, radius } => {
                let normal = n_xy.extend((1.0 - sin_theta * sin_theta).sqrt());
                return Some(Seen { pixel: *centre + DVec2::new(n_xy.x, -n_xy.y) * *radius, normal });
            }
            Self::Cone(cone) => cone,
        };
        let azimuth = n_xy.try_normalize().unwrap_or(DVec2::X);
        let theta = sin_theta.asin();
        let sin_a = cone.half_angle.sin();
        let epsilon = match frame {
            Frame::Full => theta,
            Frame::Half => half_frame_epsilon(theta, sin_a)?,
        };
        let delta = (sin_a * epsilon.sin()).asin();
        let (sin, cos) = (epsilon - delta).sin_cos();
        Some(Seen { pixel: cone.pixel(delta, azimuth)?, normal: (azimuth * sin).extend(cos) })
    }

    /// How far inside of the outline a pixel coordinate lies, in pixels (negative: outside).
    pub(super) fn depth(&self, pixel: DVec2) -> f64 {
        match self {
            Self::Parallel { centre, radius } => radius - pixel.distance(*centre),
            Self::Cone(cone) => (cone.half_angle - cone.delta(pixel)) * cone.scale(pixel),
        }
    }

    /// The outline's point at an azimuth in radians about the ball, moved outwards by `offset` pixels, and the unit
    /// direction outwards there. `None` behind the camera.
    pub(super) fn outline(&self, azimuth: f64) -> Option<(DVec2, DVec2)> {
        let direction = DVec2::from_angle(azimuth);
        match self {
            Self::Parallel { centre, radius } => {
                let outwards = DVec2::new(direction.x, -direction.y);
                Some((*centre + outwards * *radius, outwards))
            }
            Self::Cone(cone) => {
                let at = cone.pixel(cone.half_angle, direction)?;
                let further = cone.pixel(cone.half_angle + 1e-5, direction)?;
                Some((at, (further - at).try_normalize()?))
            }
        }
    }
}

/// Solves `epsilon - delta/2 = theta` with `sin delta = sin A sin epsilon`, by Newton's method. `None` where epsilon
/// would be over 90 degrees.
fn half_frame_epsilon(theta: f64, sin_a: f64) -> Option<f64> {
    if theta > FRAC_PI_2 - sin_a.asin() / 2.0 {
        return None;
    }
    let mut epsilon = theta;
    for _ in 0..12 {
        let sin_delta = sin_a * epsilon.sin();
        let cos_delta = (1.0 - sin_delta * sin_delta).sqrt();
        let value = epsilon - sin_delta.asin() / 2.0 - theta;
        let slope = 1.0 - sin_a * epsilon.cos() / (2.0 * cos_delta);
        let step = value / slope;
        epsilon = (epsilon - step).min(FRAC_PI_2);
        if step.abs() < 1e-10 {
            break;
        }
    }
    Some(epsilon)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lens() -> Lens {
        Lens::new(Some(50f64.to_radians()), 800, 600).unwrap()
    }

    /// Shoots the pixel's ray at the ball itself.
    fn hit(cone: &Cone, pixel: DVec2) -> (DVec3, DVec3) {
        let ray = ray(cone.focal, cone.centre, pixel);
        // Distance 1, radius sin A.
        let centre = cone.towards();
        let along = ray.dot(centre);
        let t = along - (along * along - 1.0 + cone.half_angle.sin().powi(2)).sqrt();
        let normal = (ray * t - centre) / cone.half_angle.sin();
        (cone.axes.transpose() * normal, cone.axes.transpose() * -ray)
    }

    #[test]
    fn the_pixel_of_a_normal_shows_that_normal() {
        let Sight::Cone(cone) = Sight::new(lens(), DVec2::new(640.0, 130.0), 140.0).unwrap() else {
            panic!("a cone")
        };
        for k in 0..100 {
            let n_xy = DVec2::from_angle(f64::from(k)) * (f64::from(k) / 110.0);
            let n = n_xy.extend((1.0 - n_xy.length_squared()).sqrt());
            for frame in [Frame::Half, Frame::Full] {
                let Some(seen) = Sight::Cone(cone).seen(n_xy, frame) else { continue };
                let (normal, eye) = hit(&cone, seen.pixel);
                assert!(normal.distance(seen.normal) < 1e-6, "{k} {normal} {}", seen.normal);
                // The table's normal is the true one after the turn that takes the eye, or half-way to it, to +z.
                let a = if frame == Frame::Full { eye } else { (eye + DVec3::Z).normalize() };
                let turned = DQuat::from_rotation_arc(a, DVec3::Z) * normal;
                assert!(turned.distance(n) < 1e-6, "{k} {frame:?} {turned} {n}");
            }
        }
    }

    #[test]
    fn a_ball_comes_back_from_its_outline() {
        for (at, radius) in [(DVec2::new(400.0, 300.0), 80.0), (DVec2::new(700.0, 50.0), 200.0)] {
            let sight = Sight::new(lens(), at, radius).unwrap();
            let (back, radius_back) = sight.ball();
            assert!(back.distance(at) < 1e-6 && (radius_back - radius).abs() < 1e-6);
            // The semi-axes by brute force: the outline's widest and narrowest extent through its middle.
            let points: Vec<DVec2> =
                (0..3600).map(|k| sight.outline(f64::from(k).to_radians() / 10.0).unwrap().0).collect();
            // The points are not even along the ellipse, so its middle is found from the extremes.
            let low = points.iter().copied().reduce(DVec2::min).unwrap();
            let high = points.iter().copied().reduce(DVec2::max).unwrap();
            let centre = (low + high) / 2.0;
            let widest = points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
            let narrowest = points.iter().map(|p| p.distance(centre)).fold(f64::MAX, f64::min);
            assert!(((widest + narrowest) / 2.0 - radius).abs() < 0.01, "{widest} {narrowest} {radius}");
        }
    }

    #[test]
    fn depth_is_measured_from_the_outline() {
        let sight = Sight::new(lens(), DVec2::new(600.0, 200.0), 150.0).unwrap();
        for k in 0..24 {
            let (at, outwards) = sight.outline(f64::from(k) / 4.0).unwrap();
            assert!((sight.depth(at - outwards * 2.0) - 2.0).abs() < 0.02);
            assert!((sight.depth(at + outwards * 2.0) + 2.0).abs() < 0.02);
        }
    }

    #[test]
    fn absurd_lenses_and_balls_are_refused() {
        assert!(Lens::new(Some(0.0), 10, 10).is_err());
        assert!(Lens::new(Some(f64::NAN), 10, 10).is_err());
        assert!(Sight::new(lens(), DVec2::new(f64::NAN, 1.0), 4.0).is_err());
        assert!(Sight::new(lens(), DVec2::ONE, 0.0).is_err());
    }
}
