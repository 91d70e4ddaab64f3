//! Pictures that say in their Exif data how the camera was held.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use amc_core::Progress;
use amc_core::capture::{BuildOptions, Built, build};
use glam::{Vec2, Vec3};
use studio_tests::materials::{Facets, three_lights};

/// Columns and rows of the pictures as they are to be seen.
const SIZE: [u16; 2] = [128, 96];
/// The ball: centre and radius, pixels.
const BALL: (f64, f64, f64) = (72.0, 44.0, 40.0);
const PICTURES: usize = 8;

/// Linear light may differ by this much in the mean: the pictures are compressed along other blocks.
const COMPRESSION: f32 = 0.006;

/// The ball of picture `k` before a grey wall; pixels from the top left.
fn pixel(k: usize, cloth: &Facets, lights: &[Vec3], [x, y]: [u16; 2]) -> [u8; 3] {
    let across = Vec2::from_angle(std::f32::consts::TAU * k as f32 / PICTURES as f32);
    let (column, row, radius) = (BALL.0 as f32, BALL.1 as f32, BALL.2 as f32);
    let p = Vec2::new(f32::from(x) + 0.5 - column, row - f32::from(y) - 0.5) / radius;
    let linear = if p.length_squared() < 1.0 {
        let n = p.extend((1.0 - p.length_squared()).sqrt());
        cloth.colour(lights, n, (across * n.z).extend(-p.dot(across)).normalize_or(Vec3::X))
    } else {
        [0.2; 3]
    };
    linear.map(amc_core::color::srgb8_from_linear)
}

/// Saves picture `k` with the tag `orientation`: 1, or 6 or 8 where the file's first row is seen on the right or left.
fn save(folder: &Path, k: usize, orientation: u8) {
    let (cloth, lights) = (Facets::new(2), three_lights());
    let [across, down] = SIZE;
    let (width, height) = if orientation == 1 { (across, down) } else { (down, across) };
    let seen_at = |column: u16, row: u16| match orientation {
        1 => [column, row],
        6 => [across - 1 - row, column],
        _ => [row, down - 1 - column],
    };
    let places = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let bytes: Vec<u8> =
        places.flat_map(|(column, row)| pixel(k, &cloth, &lights, seen_at(column, row))).collect();
    // Little-endian; one tag, of one 16-bit number.
    let mut exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".to_vec();
    exif.extend([orientation, 0, 0, 0, 0, 0, 0, 0]);
    let mut encoder = jpeg_encoder::Encoder::new_file(folder.join(format!("{k:04}.jpg")), 95).unwrap();
    encoder.add_app_segment(1, exif).unwrap();
    encoder.encode(&bytes, width, height, jpeg_encoder::ColorType::Rgb).unwrap();
}

fn built(folder: &Path) -> amc_core::Result<Built> {
    let options = BuildOptions { side: 32, sphere: Some(BALL), ..BuildOptions::default() };
    build(folder, &options, &Progress::none())
}

#[test]
fn a_camera_on_its_side_gives_the_same_table() {
    let [upright, right, left] = [1, 6, 8].map(|orientation| {
        let folder = tempfile::tempdir().unwrap();
        (0..PICTURES).for_each(|k| save(folder.path(), k, orientation));
        built(folder.path()).unwrap()
    });
    assert!(upright.report.notices.is_empty(), "{:?}", upright.report.notices);
    let expected = upright.amc.to_linear().texels;
    for turned in [right, left] {
        assert_eq!(turned.report.picture_size, SIZE.map(u32::from));
        assert!(turned.report.notices[0].contains("Exif orientation"), "{:?}", turned.report.notices);
        let found = turned.amc.to_linear().texels;
        let differences = expected.iter().zip(&found).map(|(a, b)| (a[1] - b[1]).abs());
        let mean = differences.sum::<f32>() / expected.len() as f32;
        assert!(mean < COMPRESSION, "{mean}");
    }
}

#[test]
fn pictures_of_which_one_was_held_otherwise_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    (0..PICTURES).for_each(|k| save(folder.path(), k, if k == 3 { 8 } else { 6 }));
    let message = built(folder.path()).unwrap_err().to_string();
    assert!(message.contains("0003.jpg: ") && message.contains("Exif orientation"), "{message}");
}
