//! A small renderer of a cloth-covered ball under distant lights.

use std::f64::consts::{PI, TAU};
use std::io::Write as _;

use glam::{DQuat, DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::super::Turn;
use crate::amc::Frame;
use crate::color::srgb_from_linear;

/// A cloth: a diffuse ground and shiny lobes about half vectors, each along a direction in the tangent plane.
#[derive(Clone)]
pub(super) struct Lobes {
    /// Angle from the tangent, how far the lobe leans along it, width along and across.
    lobes: Vec<(f64, f64, f64, f64)>,
    colour: [f64; 3],
}

impl Lobes {
    fn new(lobes: &[(f64, f64, f64, f64)]) -> Self {
        Self { lobes: lobes.to_vec(), colour: [0.9, 0.55, 0.35] }
    }

    /// R = 1: the nap leans.
    pub(super) fn napped() -> Self {
        Self::new(&[(0.3, 0.35, 0.25, 0.5)])
    }

    /// R = 2.
    pub(super) fn woven() -> Self {
        Self::new(&[(0.0, 0.0, 0.2, 0.6)])
    }

    /// R = 3.
    pub(super) fn triple() -> Self {
        let lobe = |k: f64| (0.2 + k * TAU / 3.0, 0.4, 0.22, 0.3);
        Self::new(&[lobe(0.0), lobe(1.0), lobe(2.0)])
    }

    /// R = 4.
    pub(super) fn balanced() -> Self {
        Self::new(&[(0.1, 0.0, 0.2, 0.6), (0.1 + PI / 2.0, 0.0, 0.2, 0.6)])
    }

    /// Isotropic.
    pub(super) fn felt() -> Self {
        Self::new(&[(0.0, 0.0, 0.4, 0.4)])
    }

    fn shade(&self, n: DVec3, t: DVec3, eye: DVec3, lights: &[(DVec3, f64)]) -> [f64; 3] {
        let b = n.cross(t);
        let mut colour = [0.0; 3];
        for &(light, strength) in lights {
            let lit = n.dot(light).max(0.0) * strength;
            let h = (light + eye).normalize();
            let mut shine = 0.0;
            for &(angle, lean, along, across) in &self.lobes {
                let (u, v) = (t * angle.cos() + b * angle.sin(), b * angle.cos() - t * angle.sin());
                let z = h.dot(n).max(0.05);
                let (x, y) = ((h.dot(u) / z - lean) / along, (h.dot(v) / z) / across);
                shine += (-x * x - y * y).exp();
            }
            for (sum, ground) in colour.iter_mut().zip(self.colour) {
                *sum += lit * (0.25 * ground + 0.5 * shine);
            }
        }
        colour
    }
}

/// A pinhole camera: its field of view, where the ball's centre is seen, and its distance in radii.
#[derive(Clone, Copy)]
pub(super) struct Camera {
    pub(super) fov_deg: f64,
    pub(super) at: DVec2,
    pub(super) distance: f64,
}

/// What is drawn.
pub(super) struct Scene {
    pub(super) cloth: Lobes,
    pub(super) pictures: usize,
    pub(super) width: u32,
    pub(super) height: u32,
    /// None: orthographic, at `centre` and `radius`.
    pub(super) camera: Option<Camera>,
    pub(super) centre: DVec2,
    pub(super) radius: f64,
    pub(super) turn: Turn,
    pub(super) uneven: bool,
    pub(super) side_light: bool,
    /// Linear.
    pub(super) background: f64,
    /// How much darker the corners are.
    pub(super) vignette: f64,
    /// Standard deviation, of 255.
    pub(super) noise: f64,
    pub(super) alpha: bool,
}

/// What one point of the ball shows, in a table's frame.
pub(super) struct Probe {
    pub(super) normal: Vec3,
    pub(super) tangent: Vec3,
    pub(super) colour: [f64; 3],
}

impl Scene {
    pub(super) fn new(cloth: Lobes) -> Self {
        Self {
            cloth,
            pictures: 24,
            width: 260,
            height: 220,
            camera: None,
            centre: DVec2::new(134.3, 107.8),
            radius: 88.6,
            turn: Turn::Ccw,
            uneven: false,
            side_light: false,
            background: 0.18,
            vignette: 0.0,
            noise: 0.0,
            alpha: false,
        }
    }

    pub(super) fn small(cloth: Lobes) -> Self {
        Self { width: 100, height: 96, centre: DVec2::new(51.2, 47.6), radius: 40.3, ..Self::new(cloth) }
    }

    fn lights(&self) -> Vec<(DVec3, f64)> {
        if self.side_light {
            return vec![(DVec3::new(-0.8, 0.3, 0.45).normalize(), 1.0)];
        }
        vec![
            (DVec3::new(0.5, 0.6, 0.8).normalize(), 0.7),
            (DVec3::new(-0.7, 0.1, 0.6).normalize(), 0.4),
            (DVec3::new(0.1, -0.7, 0.9).normalize(), 0.3),
        ]
    }

    fn angle(&self, picture: usize) -> f64 {
        let even = TAU * picture as f64 / self.pictures as f64;
        if self.uneven { even + 0.03 * (picture as f64 * 2.3).sin() + 0.01 } else { even }
    }

    fn focal(&self, camera: &Camera) -> f64 {
        f64::from(self.width) / 2.0 / (camera.fov_deg.to_radians() / 2.0).tan()
    }

    /// The direction in which a pixel is seen.
    fn ray(&self, camera: &Camera, pixel: DVec2) -> DVec3 {
        let focal = self.focal(camera);
        DVec3::new(pixel.x - f64::from(self.width) / 2.0, f64::from(self.height) / 2.0 - pixel.y, -focal)
            .normalize()
    }

    /// Turns the axes about the ball to view space.
    fn axes(&self) -> DQuat {
        match &self.camera {
            None => DQuat::IDENTITY,
            Some(camera) => DQuat::from_rotation_arc(DVec3::Z, -self.ray(camera, camera.at)),
        }
    }

    /// The normal that a pixel shows and the direction to the eye, both in the axes about the ball.
    fn hit(&self, pixel: DVec2) -> Option<(DVec3, DVec3)> {
        let Some(camera) = &self.camera else {
            let at = (pixel - self.centre) / self.radius;
            let z = 1.0 - at.length_squared();
            return (z > 0.0).then(|| (DVec3::new(at.x, -at.y, z.sqrt()), DVec3::Z));
        };
        let (ray, centre) = (self.ray(camera, pixel), self.ray(camera, camera.at) * camera.distance);
        let along = ray.dot(centre);
        let square = along * along - centre.length_squared() + 1.0;
        (square > 0.0).then(|| {
            let back = self.axes().inverse();
            (back * (ray * (along - square.sqrt()) - centre), back * -ray)
        })
    }

    /// The tangent at a normal with the ball turned by `angle` counter-clockwise: constant in the projection.
    fn tangent(normal: DVec3, angle: f64) -> DVec3 {
        let (sin, cos) = angle.sin_cos();
        DVec3::new(cos * normal.z, sin * normal.z, -(normal.x * cos + normal.y * sin)).normalize_or(DVec3::X)
    }

    /// The lights, in the axes about the ball.
    fn lights_about(&self) -> Vec<(DVec3, f64)> {
        let back = self.axes().inverse();
        self.lights().into_iter().map(|(light, strength)| (back * light, strength)).collect()
    }

    /// Where the line to the ball's centre meets the picture, and its outline's mean semi-axis.
    pub(super) fn ball(&self) -> (DVec2, f64) {
        let Some(camera) = &self.camera else { return (self.centre, self.radius) };
        // Half the area's width and height would do on the axis; off it, the ellipse's area is pi a b and its
        // long axis points away from the picture's middle.
        let focal = self.focal(camera);
        let off_axis = self.ray(camera, camera.at).z.abs().acos();
        let half = (1.0 / camera.distance).asin();
        let long = focal * ((off_axis + half).tan() - (off_axis - half).tan()) / 2.0;
        let eccentricity = off_axis.sin() / half.cos();
        (camera.at, long * (1.0 + (1.0 - eccentricity * eccentricity).sqrt()) / 2.0)
    }

    /// Points of the ball at random turns, their normal and tangent turned into a table's frame.
    pub(super) fn probes(&self, count: usize, frame: Frame) -> Vec<Probe> {
        let (at, radius) = self.ball();
        let mut random = Random(7);
        let mut probes = Vec::new();
        let lights = self.lights_about();
        while probes.len() < count {
            let pixel = at + (DVec2::new(random.next(), random.next()) * 2.0 - 1.0) * radius * 1.1;
            let angle = random.next() * TAU;
            let Some((normal, eye)) = self.hit(pixel) else { continue };
            // Where the rim is excluded, the table is filled in.
            if normal.dot(eye) < 0.25 {
                continue;
            }
            let shaded = self.cloth.shade(normal, Self::tangent(normal, angle), eye, &lights);
            let colour = shaded.map(|value| value.min(1.0));
            let towards = if frame == Frame::Full { eye } else { (eye + DVec3::Z).normalize() };
            let turn = DQuat::from_rotation_arc(towards, DVec3::Z);
            let tangent = (turn * Self::tangent(normal, angle)).as_vec3();
            probes.push(Probe { normal: (turn * normal).as_vec3(), tangent, colour });
        }
        probes
    }

    /// Writes the pictures, and a session where the angles ask for one.
    pub(super) fn write(&self) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let all = (0..self.width * self.height).into_par_iter();
        let hits: Vec<Hits> = all.map(|k| self.hits(k % self.width, k / self.width)).collect();
        (0..self.pictures).into_par_iter().for_each(|k| {
            let path = folder.path().join(format!("picture{k}.png"));
            std::fs::File::create(path).unwrap().write_all(&self.picture(k, &hits)).unwrap();
        });
        if self.uneven {
            let pictures: Vec<_> = (0..self.pictures)
                .map(|k| serde_json::json!({"file": format!("picture{k}.png"), "angle_deg": self.angle(k).to_degrees()}))
                .collect();
            let session = serde_json::json!({"version": 1, "turn": self.turn, "pictures": pictures});
            crate::file::save_bytes(&folder.path().join("session.json"), session.to_string().as_bytes())
                .unwrap();
        }
        folder
    }

    fn picture(&self, k: usize, hits: &[Hits]) -> Vec<u8> {
        let mut random = Random(k as u64 + 1);
        let angle = self.turn.sign() * self.angle(k);
        let lights = self.lights_about();
        let mut samples = Vec::new();
        for (k, hits) in (0..).zip(hits) {
            let colour = self.colour(k % self.width, k / self.width, hits, angle, &lights);
            let mut encoded = colour.map(|value| f64::from(srgb_from_linear(value as f32)));
            if self.noise > 0.0 {
                encoded = encoded.map(|value| value + self.noise / 255.0 * random.normal());
            }
            samples.extend(encoded.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8));
            if self.alpha {
                samples.push((hits.coverage() * 255.0).round() as u8);
            }
        }
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(if self.alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fastest);
        encoder.write_header().unwrap().write_image_data(&samples).unwrap();
        bytes
    }

    /// Where the ball is hit inside of a pixel: 6 x 6 times at its rim.
    fn hits(&self, x: u32, y: u32) -> Hits {
        let at = |u: f64, v: f64| self.hit(DVec2::new(f64::from(x) + u, f64::from(y) + v));
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5)];
        let inside = corners.iter().filter(|&&(u, v)| at(u, v).is_some()).count();
        let steps: usize = if inside == 0 || inside == 5 { 1 } else { 6 };
        let middle = |k: usize| (k as f64 + 0.5) / steps as f64;
        let hits = (0..steps * steps).filter_map(|k| at(middle(k % steps), middle(k / steps))).collect();
        Hits { hits, tried: steps * steps }
    }

    /// A pixel's colour, straight where there is alpha.
    fn colour(&self, x: u32, y: u32, hits: &Hits, angle: f64, lights: &[(DVec3, f64)]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for &(normal, eye) in &hits.hits {
            let shaded = self.cloth.shade(normal, Self::tangent(normal, angle), eye, lights);
            for (sum, value) in sum.iter_mut().zip(shaded) {
                *sum += value;
            }
        }
        if self.alpha {
            return sum.map(|value| value / hits.hits.len().max(1) as f64);
        }
        let middle = DVec2::new(f64::from(self.width), f64::from(self.height)) / 2.0;
        let off =
            (DVec2::new(f64::from(x), f64::from(y)) - middle).length_squared() / middle.length_squared();
        let background = self.background * (1.0 - hits.coverage());
        sum.map(|value| (value / hits.tried as f64 + background) * (1.0 - self.vignette * off))
    }
}

/// The normals that a pixel shows and the directions to the eye, in the axes about the ball.
struct Hits {
    hits: Vec<(DVec3, DVec3)>,
    tried: usize,
}

impl Hits {
    fn coverage(&self) -> f64 {
        self.hits.len() as f64 / self.tried as f64
    }
}

/// A small generator of random numbers (splitmix64).
struct Random(u64);

impl Random {
    /// In 0..1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Of mean 0 and standard deviation 1.
    fn normal(&mut self) -> f64 {
        (-2.0 * (self.next() + 1e-300).ln()).sqrt() * (TAU * self.next()).cos()
    }
}
