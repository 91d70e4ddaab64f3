//! Pictures to a table and back: a sphere with a turntable's tangents shows the pictures it was built from.

use std::sync::Arc;

use amc_core::Progress;
use amc_core::capture::{self, BuildOptions};
use amc_core::direction::{self, Direction};
use amc_core::image::compare::psnr_srgb;
use amc_core::mesh::Garment;
use amc_core::render::{Cloth, Drawing, Orientation, Shading, View, cpu};
use amc_core::shape;
use amc_core::view_space::Azimuth;
use studio_tests::materials::{Facets, three_lights};

/// The bar for clean input, dB.
const CLEAN: f64 = 40.0;

#[test]
fn a_sphere_turned_to_a_slice_angle_is_the_picture_at_that_angle() {
    let lights = three_lights();
    let cloth = Facets::new(2);
    let folder = tempfile::tempdir().unwrap();
    cloth.save_turn(folder.path(), &lights, 128, 64, 0.0).unwrap();
    let garment = Garment::new(shape::mesh("sphere").unwrap()).unwrap();
    let directions = vec![Direction::default(); garment.panels.len()];
    let tangents = direction::tangents(&garment, &directions).unwrap();
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        let options = BuildOptions { azimuth, ..BuildOptions::default() };
        let table = Arc::new(capture::build(folder.path(), &options, &Progress::none()).unwrap().amc);
        assert_eq!(table.symmetry.order(), 2);
        let drawing =
            Drawing::new(&garment, tangents.vectors.clone(), None, vec![table], |_| Cloth::Fabric(0))
                .unwrap();
        for slice in [0u32, 5, 16, 40] {
            let angle = std::f32::consts::TAU * slice as f32 / 64.0;
            let orientation = Orientation { roll: angle, ..Orientation::default() };
            let view = View::fitted(&garment.positions, orientation, 128, 128).unwrap();
            let ours = cpu::render(&drawing, &view, &Shading::default(), &Progress::none()).unwrap();
            let truth = cloth.picture(&lights, 128, angle, 0.0, 0).unwrap();
            let psnr = psnr_srgb(&ours, &truth).unwrap();
            assert!(psnr >= CLEAN, "{azimuth:?}, slice {slice}: {psnr} dB");
        }
    }
}
