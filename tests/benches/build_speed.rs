//! `build` of 128 JPEGs of 1280x720 against only decoding them, with the same decoder and threads, in one run.
//!
//! Prints both medians and the ratio; exits 1 when the ratio is over the bar.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "its result is what it prints")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use amc_core::Progress;
use amc_core::capture::{self, BuildOptions};
use amc_core::image::decode;
use glam::Vec3;
use rayon::prelude::*;
use studio_tests::materials::{Facets, three_lights};
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

/// Build time over decode time.
const BAR: f64 = 1.4;
const PICTURES: u32 = 128;
const WIDTH: u16 = 1280;
const HEIGHT: u16 = 720;
const RADIUS: f32 = 300.0;
const ROUNDS: usize = 7;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let folder = tempfile::tempdir().expect("a scratch folder");
    let files: Vec<PathBuf> = (0..PICTURES).map(|k| folder.path().join(format!("{k:04}.jpg"))).collect();
    let lights = three_lights();
    files.par_iter().enumerate().for_each(|(k, file)| save_picture(k, file, &lights));

    let mut decode_times = Vec::new();
    let mut build_times = Vec::new();
    for _ in 0..ROUNDS {
        decode_times.push(timed(|| {
            files.par_iter().for_each(|file| {
                let bytes = std::fs::read(file).expect("a picture");
                std::hint::black_box(decode::decode(&bytes).expect("a picture"));
            });
        }));
        build_times.push(timed(|| {
            let built =
                capture::build(folder.path(), &BuildOptions::default(), &Progress::none()).expect("a table");
            assert_eq!(built.report.symmetry.order(), 2);
        }));
    }
    let (decode, build) = (median(decode_times), median(build_times));
    let ratio = build.as_secs_f64() / decode.as_secs_f64();
    println!("threads: {}", rayon::current_num_threads());
    println!("decode only: {:.0} ms", milliseconds(decode));
    println!("build:       {:.0} ms", milliseconds(build));
    println!("ratio:       {ratio:.2} (bar {BAR})");
    if ratio <= BAR { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// A ball before a grey wall, as a camera saves it.
fn save_picture(k: usize, file: &Path, lights: &[Vec3]) {
    let cloth = Facets::new(2);
    let angle = std::f32::consts::TAU * k as f32 / PICTURES as f32;
    let across = glam::Vec2::from_angle(angle);
    let mut bytes = Vec::with_capacity(usize::from(WIDTH) * usize::from(HEIGHT) * 3);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let p = glam::Vec2::new(f32::from(x) - 640.0, 360.0 - f32::from(y)) / RADIUS;
            let linear = if p.length_squared() < 1.0 {
                let n = p.extend((1.0 - p.length_squared()).sqrt());
                cloth.colour(lights, n, (across * n.z).extend(-p.dot(across)).normalize_or(Vec3::X))
            } else {
                // A wall that is lit unevenly, with a grain that a camera's noise has.
                [0.2 + 0.02 * (f32::from(x) / 97.0).sin() + 0.004 * f32::from((x * 31 + y * 17) % 7); 3]
            };
            bytes.extend(linear.map(amc_core::color::srgb8_from_linear));
        }
    }
    let encoder = jpeg_encoder::Encoder::new_file(file, 90).expect("a file");
    encoder.encode(&bytes, WIDTH, HEIGHT, jpeg_encoder::ColorType::Rgb).expect("a picture");
}
