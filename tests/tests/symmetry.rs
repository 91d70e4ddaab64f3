//! The symmetry of a cloth is found from its pictures: right every time.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use amc_core::Progress;
use amc_core::capture::{self, BuildOptions};
use studio_tests::materials::{Facets, three_lights};

fn found(directions: u32, count: u32, noise: f32) -> (u32, bool) {
    let folder = tempfile::tempdir().unwrap();
    let lights = three_lights();
    Facets::new(directions).save_turn(folder.path(), &lights, 64, count, noise).unwrap();
    let options = BuildOptions { side: 64, ..BuildOptions::default() };
    let report = capture::build(folder.path(), &options, &Progress::none()).unwrap().report;
    (report.symmetry.order(), report.isotropic)
}

#[test]
fn every_symmetry_is_found_with_noise_and_with_counts_it_does_not_divide() {
    for (count, noise) in [(24, 0.0), (25, 1.0), (48, 3.0)] {
        for directions in 1..=4 {
            assert_eq!(
                found(directions, count, noise),
                (directions, false),
                "{count} pictures, noise {noise}"
            );
        }
        assert_eq!(found(0, count, noise), (1, true), "isotropic, {count} pictures, noise {noise}");
    }
}
