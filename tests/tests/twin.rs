//! The same pictures from both renderers: at least 99.9 % of the pixels within 3 steps of 1/255 (sRGB, alpha
//! included), and 0.5 steps in the mean. On OpenGL in the ordinary run, on Vulkan too with the feature `full`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Arc;

use amc_core::Progress;
use amc_core::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use amc_core::color::srgb8_from_linear;
use amc_core::direction::{Direction, tangents};
use amc_core::image::Picture;
use amc_core::image::compare::Difference;
use amc_core::mesh::Garment;
use amc_core::render::gpu::{Backend, Gpu, Offscreen, Renderer};
use amc_core::render::{
    Camera, Cloth, Cyclic, Drawing, LaidPrint, Laying, Mode, Orientation, Perspective, Print, Projection,
    Shading, View, cpu,
};
use amc_core::shape;
use amc_core::view_space::Azimuth;
use glam::{DMat4, DVec3, Vec2, Vec3};

const WIDTH: u32 = 200;
const HEIGHT: u32 = 160;
const SIDE: u32 = 32;
const SLICES: u32 = 32;

macro_rules! on {
    ($adapter:ident, $backend:expr) => {
        mod $adapter {
            use super::*;

            #[test]
            fn every_mode_on_every_shape() {
                super::every_mode_on_every_shape($backend);
            }

            #[test]
            fn every_cyclic_mode_symmetry_and_azimuth() {
                super::every_cyclic_mode_symmetry_and_azimuth($backend);
            }

            #[test]
            fn every_perspective_mode() {
                super::every_perspective_mode($backend);
            }

            #[test]
            fn coarse_triangles_backs_and_plain_parts() {
                super::coarse_triangles_backs_and_plain_parts($backend);
            }

            #[test]
            fn prints_near_and_afar() {
                super::prints_near_and_afar($backend);
            }
        }
    };
}

on!(gl, Backend::Gl);
#[cfg(feature = "full")]
on!(vulkan, Backend::Vulkan);

/// Both renderers, and everything that differed too much.
struct Twins {
    gpu: Gpu,
    renderer: Renderer,
    compared: usize,
    faults: Vec<String>,
}

impl Twins {
    fn new(backend: Backend) -> Self {
        let gpu = Gpu::headless(backend).unwrap_or_else(|error| panic!("{error}"));
        let renderer = Renderer::new(&gpu.device, &gpu.queue);
        Self { gpu, renderer, compared: 0, faults: Vec::new() }
    }

    fn compare(&mut self, what: &str, drawing: &Drawing, view: &View, shading: &Shading) {
        let reference = cpu::render(drawing, view, shading, &Progress::none()).unwrap();
        let offscreen = Offscreen::new(&self.gpu.device, view.width, view.height, shading.samples).unwrap();
        let mut scene = self.renderer.prepare(drawing).unwrap();
        let eye = self.renderer.eye();
        let frame = self.renderer.draw_data(&mut scene, &eye, view, shading, offscreen.target()).unwrap();
        let picture = offscreen.picture(&self.gpu, &frame, shading.background).unwrap();
        let covered = reference.pixels().iter().filter(|pixel| pixel[3] > 0.0).count();
        assert!(covered > reference.pixels().len() / 10, "{what}: nearly nothing to see");
        let difference = Difference::new(&reference, &picture).unwrap();
        let (share, mean) = (difference.share_within(3), difference.mean);
        self.compared += 1;
        if share < 0.999 || mean > 0.5 {
            self.faults.push(format!(
                "{what}: {:.3} % of the pixels within 3 steps, mean {mean:.3}, {:?}",
                share * 100.0,
                difference.worst
            ));
        }
    }

    #[track_caller]
    fn agree(self, expected: usize) {
        assert_eq!(self.compared, expected);
        let faults = self.faults;
        assert!(faults.is_empty(), "{} of {expected} pictures differ:\n{}", faults.len(), faults.join("\n"));
    }
}

/// A fabric with a broad and a narrow highlight that both turn with the cloth.
fn fabric(symmetry: Symmetry, azimuth: Azimuth) -> Arc<Amc> {
    let size = TableSize::new(SIDE, SLICES).unwrap();
    let order = symmetry.order() as f32;
    let light = Vec3::new(0.4, 0.5, 0.77).normalize_or(Vec3::Z);
    let half_vector = (light + Vec3::Z).normalize_or(Vec3::Z);
    let mut texels = Vec::with_capacity(size.texels());
    for s in 0..SLICES {
        let phi = std::f32::consts::TAU * s as f32 / (order * SLICES as f32);
        for j in 0..SIDE {
            for i in 0..SIDE {
                let xy = size.normal_xy(i, j).clamp_length_max(0.999);
                let n = xy.extend((1.0 - xy.length_squared()).sqrt());
                // Lobes along every R-th part of the turn, so that the table closes.
                let lobe = |c: u32| {
                    let t = azimuth.tangent(n, phi + std::f32::consts::TAU * c as f32 / order);
                    let along = t.dot(half_vector);
                    (1.0 - along * along).max(0.0).sqrt()
                };
                let lobes: f32 = (0..symmetry.order()).map(|c| lobe(c).powi(12)).sum::<f32>() / order;
                let turning = 0.5 + 0.5 * (order * phi).sin();
                let diffuse = n.dot(light).max(0.0);
                let colour = [0.05 + 0.3 * diffuse + 0.6 * lobes, 0.1 + 0.7 * lobes, 0.1 + 0.4 * turning];
                let [r, g, b] = colour.map(srgb8_from_linear);
                texels.push([r, g, b, 255]);
            }
        }
    }
    Arc::new(Amc::new(size, Texels::Srgb8(texels), symmetry, azimuth, Frame::Half).unwrap())
}

/// A picture of a ball whose quarters differ.
fn ball() -> Arc<Picture> {
    let pixels = (0..48 * 48).map(|k| {
        let (x, y) = ((k % 48) as f32 / 47.0, (k / 48) as f32 / 47.0);
        [x, 0.2 + 0.6 * y, (1.0 - x) * (1.0 - y), 1.0]
    });
    Arc::new(Picture::new(48, 48, pixels.collect()).unwrap())
}

/// A shape as one panel in `fabric`, its occlusion made up.
fn drawing(name: &str, fabric: Arc<Amc>) -> Drawing {
    let mesh = shape::mesh(name).unwrap();
    let garment = Garment::new(mesh).unwrap();
    let directions = vec![Direction::default(); garment.panels.len()];
    let vectors = tangents(&garment, &directions).unwrap().vectors;
    let light = |p: &Vec3| Vec2::new(0.75 + 0.25 * (5.0 * p.y).sin(), 0.75 + 0.25 * (7.0 * p.x).cos());
    let occlusion: Vec<Vec2> = garment.positions.iter().map(light).collect();
    Drawing::new(&garment, vectors, Some(&occlusion), vec![fabric], |_| Cloth::Fabric(0)).unwrap()
}

fn positions(drawing: &Drawing) -> Vec<Vec3> {
    drawing.vertices.iter().map(|vertex| vertex.position).collect()
}

fn orthographic(drawing: &Drawing) -> View {
    let orientation = Orientation { yaw: 0.4, pitch: 0.5, roll: -0.2 };
    View::fitted(&positions(drawing), orientation, WIDTH, HEIGHT).unwrap()
}

fn perspective(drawing: &Drawing) -> View {
    let orientation = Orientation { yaw: 0.4, pitch: 0.5, roll: -0.2 };
    let camera = Camera {
        world_to_view: DMat4::from_translation(DVec3::new(0.1, 0.05, -2.6)),
        projection: Projection::Perspective { fov_y: 50f32.to_radians() },
    };
    View::with_camera(&camera, orientation, &positions(drawing), WIDTH, HEIGHT).unwrap()
}

fn every_mode_on_every_shape(backend: Backend) {
    let mut twins = Twins::new(backend);
    let fabric = fabric(Symmetry::Two, Azimuth::Transported);
    let matcap = Mode::MatCap(ball());
    for name in shape::NAMES {
        let drawing = drawing(name, Arc::clone(&fabric));
        for (projection, view) in [("parallel", orthographic(&drawing)), ("camera", perspective(&drawing))] {
            let modes = [Mode::Amc, Mode::Isotropic, matcap.clone(), Mode::Normals, Mode::Tangents, Mode::Uv];
            for (index, mode) in modes.into_iter().enumerate() {
                let what = format!("{name}, {projection}, mode {index}");
                // The checker of the UV view has edges that rounding may shift by a pixel: where triangles are smaller
                // than pixels there are many of them.
                let scale = if mode == Mode::Uv { 2 } else { 1 };
                let view = View { width: scale * WIDTH, height: scale * HEIGHT, ..view };
                twins.compare(&what, &drawing, &view, &Shading { mode, ..Shading::default() });
            }
        }
    }
    twins.agree(7 * 2 * 6);
}

fn every_cyclic_mode_symmetry_and_azimuth(backend: Backend) {
    let mut twins = Twins::new(backend);
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        for symmetry in Symmetry::ALL {
            let drawing = drawing("torus", fabric(symmetry, azimuth));
            for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
                for samples in [1, 4] {
                    let what = format!("{azimuth:?}, {symmetry:?}, {cyclic:?}, {samples}");
                    let shading = Shading { cyclic, samples, ..Shading::default() };
                    twins.compare(&what, &drawing, &perspective(&drawing), &shading);
                }
            }
        }
    }
    twins.agree(2 * 4 * 3 * 2);
}

fn every_perspective_mode(backend: Backend) {
    let mut twins = Twins::new(backend);
    let fabric = fabric(Symmetry::Two, Azimuth::Transported);
    for name in ["sheet", "torus-poloidal"] {
        let drawing = drawing(name, Arc::clone(&fabric));
        for perspective_mode in [Perspective::Off, Perspective::Paper, Perspective::Full, Perspective::Half] {
            for mode in [Mode::Amc, Mode::Isotropic] {
                let what = format!("{name}, {perspective_mode:?}, {mode:?}");
                let background = Some([0.02, 0.5, 0.1]);
                let perspective_of = Shading { perspective: perspective_mode, ..Shading::default() };
                let shading = Shading { mode, occlusion: false, background, ..perspective_of };
                twins.compare(&what, &drawing, &perspective(&drawing), &shading);
            }
        }
    }
    twins.agree(2 * 4 * 2);
}

/// A picture with broad bands and fine ones, transparent in a corner; its sides are no powers of two.
fn print() -> Arc<Print> {
    let pixels = (0..50 * 36).map(|k| {
        let (x, y) = ((k % 50) as f32, (k / 50) as f32);
        let alpha = if x < 12.0 && y < 9.0 { 0.0 } else { 1.0 };
        [0.5 + 0.5 * (x * 0.25).sin(), 0.5 + 0.5 * (y * 0.7).cos(), 0.5 + 0.5 * (x + y).sin(), alpha]
    });
    Arc::new(Print::new(&Picture::new(50, 36, pixels.collect()).unwrap()).unwrap())
}

/// From a picture that is much larger than the screen's pixels to one that is smaller, repeated and once, over two directions.
fn prints_near_and_afar(backend: Backend) {
    let mut twins = Twins::new(backend);
    let (fabric, print) = (fabric(Symmetry::Two, Azimuth::Transported), print());
    let matcap = Mode::MatCap(ball());
    for name in ["sheet", "torus"] {
        let garment = Garment::new(shape::mesh(name).unwrap()).unwrap();
        for (width, is_repeated) in [(0.9, true), (0.12, true), (0.01, true), (0.7, false)] {
            let laying = Laying { width, turn: 0.4, shift: Vec2::new(0.05, 0.02), is_repeated };
            let panel = &garment.panels[0];
            let metres = garment.uv_to_metres(panel).unwrap();
            let laid = LaidPrint::new(&print, &laying, panel, &Direction::default(), metres);
            let mut printed = drawing(name, Arc::clone(&fabric));
            printed.draws[0].cloth = Cloth::Printed(0, laid);
            for (index, mode) in
                [Mode::Amc, Mode::Isotropic, matcap.clone(), Mode::Normals].into_iter().enumerate()
            {
                for samples in [1, 4] {
                    let what = format!("{name}, {width} m, mode {index}, {samples}");
                    let shading = Shading { mode: mode.clone(), samples, ..Shading::default() };
                    let view = perspective(&printed);
                    twins.compare(&what, &printed, &view, &shading);
                }
            }
            let Cloth::Printed(_, laid) = printed.draws[0].cloth.clone() else { continue };
            printed.draws[0].cloth = Cloth::Covered(laid);
            let view = perspective(&printed);
            twins.compare(&format!("{name}, {width} m, alone"), &printed, &view, &Shading::default());
        }
    }
    twins.agree(2 * 4 * (4 * 2 + 1));
}

/// A fan of few triangles around a point: each spans much of the azimuth; and half of them face away.
fn coarse_triangles_backs_and_plain_parts(backend: Backend) {
    let mut twins = Twins::new(backend);
    let mut drawing = drawing("disc-circular", fabric(Symmetry::One, Azimuth::Transported));
    let of = |position: Vec3| amc_core::render::Vertex {
        position,
        normal: Vec3::new(0.2 * position.x, 0.3 * position.y, 1.0).normalize_or(Vec3::Z),
        uv: Vec2::new(position.x, position.y),
        occlusion: Vec2::new(0.5 + 0.5 * position.x, 0.5 - 0.5 * position.y),
    };
    let angle = |k: u32| std::f32::consts::TAU * k as f32 / 9.0;
    let (vertices, tangents): (Vec<_>, Vec<_>) = (0..9)
        .flat_map(|k| {
            let (sin, cos) = angle(k).sin_cos();
            let (outer, tangent) = (Vec3::new(cos, sin, 0.3 * sin), Vec3::new(-sin, cos, 0.1));
            [(of(outer * 0.2), tangent), (of(outer), tangent)]
        })
        .unzip();
    (drawing.vertices, drawing.tangents) = (vertices.into(), tangents.into());
    let triangles: Vec<[u32; 3]> = (0..9)
        .flat_map(|k| {
            let [a, b, c, d] = [2 * k, 2 * k + 1, (2 * k + 2) % 18, (2 * k + 3) % 18];
            if k % 2 == 0 { [[a, b, d], [a, d, c]] } else { [[a, d, b], [a, c, d]] }
        })
        .collect();
    drawing.triangles = triangles.into();
    drawing.draws[0].triangles = 0..14;
    drawing.draws.push(amc_core::render::Draw { triangles: 14..18, cloth: Cloth::Plain });
    for (projection, view) in [("parallel", orthographic(&drawing)), ("camera", perspective(&drawing))] {
        for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
            for samples in [1, 4] {
                let shading = Shading { cyclic, samples, ..Shading::default() };
                twins.compare(&format!("{projection}, {cyclic:?}, {samples}"), &drawing, &view, &shading);
            }
        }
    }
    twins.agree(2 * 3 * 2);
}
