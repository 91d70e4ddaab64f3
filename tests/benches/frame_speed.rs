//! A frame in an AMC against the same frame in a 2D MatCap, on software Vulkan, alternately in one run.
//!
//! 1024x768, a waving sheet that fills the view; the same vertices, occlusion and perspective in both. Prints the
//! medians and the ratio per table format; exits 1 when the ratio of 8-bit sRGB is over the bar. `--gl` measures on
//! OpenGL instead.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark says what it measured")]

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use amc_core::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use amc_core::image::Picture;
use amc_core::render::gpu::{Backend, Eye, Gpu, Offscreen, Renderer, Scene, wgpu};
use amc_core::render::{Cloth, Cyclic, Draw, Drawing, Mode, Projection, Shading, Vertex, View};
use amc_core::view_space::Azimuth;
use glam::{Mat4, Vec2, Vec3};
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

/// AMC time over MatCap time, 8-bit sRGB.
const BAR: f64 = 1.6;
const WIDTH: u32 = 1024;
const HEIGHT: u32 = 768;
const SIDE: u32 = 128;
const SLICES: u32 = 128;
/// 20,000 triangles.
const CELLS: [u32; 2] = [125, 80];
const FRAMES: usize = 60;
const WARM_UP: usize = 5;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let backend = if std::env::args().any(|word| word == "--gl") { Backend::Gl } else { Backend::Vulkan };
    let gpu = match Gpu::headless(backend) {
        Ok(gpu) => gpu,
        Err(error) => {
            eprintln!("frame_speed: {error}");
            return ExitCode::FAILURE;
        }
    };
    println!("{}, {WIDTH}x{HEIGHT}, {FRAMES} frames each", gpu.name());
    let mut worst: f64 = 0.0;
    for samples in [1, 4] {
        for (format, texels) in [("sRGB 8-bit", srgb8()), ("half float", half(&srgb8()))] {
            let eight_bits = matches!(texels, Texels::Srgb8(_));
            for cyclic in [Cyclic::Cyclic, Cyclic::Fragment] {
                let ratio = compare(&gpu, samples, format, &texels, cyclic);
                if eight_bits && cyclic == Cyclic::Cyclic {
                    worst = worst.max(ratio);
                }
            }
        }
    }
    if worst > BAR {
        eprintln!("frame_speed: the AMC's frame takes {worst:.2} times the MatCap's; the bar is {BAR}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

/// Prints the medians of both frames; their ratio.
fn compare(gpu: &Gpu, samples: u32, format: &str, texels: &Texels, cyclic: Cyclic) -> f64 {
    let size = TableSize::new(SIDE, SLICES).expect("a size");
    let amc =
        Amc::new(size, texels.clone(), Symmetry::Two, Azimuth::Transported, Frame::Half).expect("a table");
    let ball = Arc::new(slice_as_picture(&amc));
    let drawing = sheet(Arc::new(amc));
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(&drawing).expect("a scene");
    let offscreen = Offscreen::new(&gpu.device, WIDTH, HEIGHT, samples).expect("attachments");
    let eye = renderer.eye();
    let amc = Shading { cyclic, samples, ..Shading::default() };
    let matcap = Shading { mode: Mode::MatCap(ball), ..amc.clone() };
    let mut times = [Vec::new(), Vec::new()];
    for frame in 0..WARM_UP + FRAMES {
        for (times, shading) in times.iter_mut().zip([&amc, &matcap]) {
            let time = timed_frame(gpu, &mut renderer, &mut scene, &offscreen, &eye, shading);
            if frame >= WARM_UP {
                times.push(time);
            }
        }
    }
    let [amc, matcap] = times.map(|times| milliseconds(median(times)));
    let ratio = amc / matcap;
    println!(
        "samples {samples}, {format}, {cyclic:?}: AMC {amc:.2} ms, MatCap {matcap:.2} ms, ratio {ratio:.2}"
    );
    ratio
}

/// From the call to the device being done.
fn timed_frame(
    gpu: &Gpu,
    renderer: &mut Renderer,
    scene: &mut Scene,
    offscreen: &Offscreen,
    eye: &Eye,
    shading: &Shading,
) -> Duration {
    timed(|| {
        let frame = renderer.draw_data(scene, eye, &view(), shading, offscreen.target()).expect("a frame");
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        offscreen.draw(&mut encoder, &frame, None);
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("a working device");
    })
}

fn view() -> View {
    View {
        object_to_view: Mat4::from_translation(Vec3::new(0.0, 0.0, -2.0)) * Mat4::from_rotation_y(0.2),
        projection: Projection::Perspective { fov_y: 45f32.to_radians() },
        width: WIDTH,
        height: HEIGHT,
        near: 0.5,
        far: 8.0,
        shift: Vec2::ZERO,
    }
}

/// A sheet of 3 x 2.6 units in waves, seen whole by no view of 45 degrees from 2 units away.
fn sheet(fabric: Arc<Amc>) -> Drawing {
    let [columns, rows] = CELLS;
    let (mut vertices, mut tangents, mut triangles) = (vec![], vec![], vec![]);
    for row in 0..=rows {
        for column in 0..=columns {
            let uv = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
            let xy = (uv - 0.5) * Vec2::new(3.0, 2.6);
            let phase = Vec2::new(9.0 * xy.x + 2.0 * xy.y, 3.0 * xy.y - xy.x);
            let z = 0.06 * phase.x.sin() + 0.08 * phase.y.sin();
            let slope = Vec2::new(
                0.54 * phase.x.cos() - 0.08 * phase.y.cos(),
                0.12 * phase.x.cos() + 0.24 * phase.y.cos(),
            );
            tangents.push(Vec3::new(1.0, 0.0, slope.x).normalize_or(Vec3::X));
            vertices.push(Vertex {
                position: xy.extend(z),
                normal: (-slope).extend(1.0).normalize_or(Vec3::Z),
                uv,
                occlusion: Vec2::splat(0.9 + 0.1 * phase.x.sin()),
            });
        }
    }
    let corner = |column: u32, row: u32| row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [corner(column, row), corner(column + 1, row)];
            let [c, d] = [corner(column, row + 1), corner(column + 1, row + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    Drawing {
        vertices: vertices.into(),
        tangents: tangents.into(),
        triangles: triangles.into(),
        draws: vec![Draw { triangles: 0..2 * columns * rows, cloth: Cloth::Fabric(0) }],
        fabrics: vec![fabric],
    }
}

/// A smooth table with all values in use.
fn srgb8() -> Texels {
    let value =
        |x: u32, y: u32, s: u32| (127.5 + 127.0 * (0.05 * (x + 2 * y) as f32 + 0.1 * s as f32).sin()) as u8;
    let texel = |k: u32| {
        let (i, j, s) = (k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE));
        [value(i, j, s), value(j, i, s), value(i, i, j), 255]
    };
    Texels::Srgb8((0..SIDE * SIDE * SLICES).map(texel).collect())
}

fn half(texels: &Texels) -> Texels {
    let size = TableSize::new(SIDE, SLICES).expect("a size");
    let amc =
        Amc::new(size, texels.clone(), Symmetry::Two, Azimuth::Transported, Frame::Half).expect("a table");
    let mut linear = amc.to_linear();
    // Off the 8-bit values, so that the MatCap is kept in half floats too.
    linear.texels.iter_mut().for_each(|texel| *texel = texel.map(|value| value * 0.97 + 0.011));
    linear.to_half()
}

/// Slice 0 as the picture of a ball.
fn slice_as_picture(amc: &Amc) -> Picture {
    let mut pixels = amc.to_linear().texels;
    pixels.truncate(amc.size().slice_texels());
    Picture::new(SIDE, SIDE, pixels).expect("a picture")
}
