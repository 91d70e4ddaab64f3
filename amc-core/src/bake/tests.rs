use super::*;
use crate::reflectance::bundled;

fn options(symmetry: Symmetry) -> BakeOptions {
    BakeOptions {
        side: 16,
        slices: Some(12),
        symmetry: Some(symmetry),
        format: TexelFormat::Half,
        ..BakeOptions::default()
    }
}

fn satin() -> Description {
    bundled("satin").unwrap().description().unwrap()
}

/// The radiance of the ball at a normal whose cloth runs along `t`, from the definition: all in view space turned into
/// the cloth's frame by dot products.
fn seen(description: &Description, n: Vec3, t: Vec3) -> Vec3 {
    let b = n.cross(t);
    let into_cloth = glam::Mat3::from_cols(t, b, n).transpose();
    let lighting = description.lighting.as_ref().unwrap();
    let mut sum = description.reflectance.ambient() * lighting.ambient;
    for light in &lighting.lights {
        let to_light = light.towards / light.towards.length();
        sum +=
            light.irradiance * description.reflectance.reflect(into_cloth * to_light, into_cloth * Vec3::Z);
    }
    sum
}

#[test]
fn a_texel_is_the_reflectance_at_its_centre() {
    let description = satin();
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        for symmetry in [Symmetry::One, Symmetry::Two] {
            let options = BakeOptions { azimuth, ..options(symmetry) };
            let table = bake(&description, &options, &Progress::none()).unwrap().to_linear();
            for (i, j, s) in [(8, 8, 0), (3, 11, 5), (12, 4, 11), (7, 1, 3)] {
                let xy = Vec2::new((2 * i + 1) as f32, (2 * j + 1) as f32) / 16.0 - 1.0;
                let n = xy.extend((1.0 - xy.length_squared()).sqrt());
                let phi = std::f32::consts::TAU * s as f32 / (symmetry.order() * 12) as f32;
                // The cloth's direction, from what the azimuth means: a tangent of that angle on the picture, or before
                // the least rotation from +z to n.
                let flat = Vec3::new(phi.cos(), phi.sin(), 0.0);
                let t = match azimuth {
                    Azimuth::Transported => glam::Quat::from_rotation_arc(Vec3::Z, n) * flat,
                    Azimuth::Projected => (flat - Vec3::Z * (n.dot(flat) / n.z)).try_normalize().unwrap(),
                };
                let [r, g, b, a] = table.texel(i, j, s);
                let expected = seen(&description, n, t);
                let difference = (Vec3::new(r, g, b) - expected).abs().max_element();
                assert!(difference < 1e-3 * expected.max_element(), "{azimuth:?} {i} {j} {s}");
                assert_eq!(a, 1.0);
            }
        }
    }
}

#[test]
fn a_symmetry_the_cloth_lacks_is_the_mean_of_its_directions() {
    let description = satin();
    let whole =
        bake(&description, &BakeOptions { slices: Some(48), ..options(Symmetry::One) }, &Progress::none());
    let whole = whole.unwrap().to_linear();
    let folded = bake(&description, &options(Symmetry::Four), &Progress::none()).unwrap().to_linear();
    for s in 0..12 {
        let mean = |c: usize| (0..4).map(|k| whole.texel(5, 9, s + 12 * k)[c]).sum::<f32>() / 4.0;
        assert!((folded.texel(5, 9, s)[0] - mean(0)).abs() < 2e-3);
    }
}

#[test]
fn the_symmetry_is_found_and_the_shape_follows_from_it() {
    let amc = bake(&satin(), &BakeOptions { side: 8, ..BakeOptions::default() }, &Progress::none()).unwrap();
    assert_eq!((amc.symmetry, amc.size().slices(), amc.format()), (Symmetry::Two, 8, TexelFormat::Srgb8));
    assert_eq!(amc.metadata.name, "Satin");
    assert_eq!(amc.metadata.capture["texels_above_1"], 0);
}

#[test]
fn sub_samples_average_over_the_texel_and_are_the_same_for_the_same_seed() {
    let description = satin();
    let many = |samples, seed| {
        let options = BakeOptions { side: 8, samples, seed, ..options(Symmetry::Two) };
        bake(&description, &options, &Progress::none()).unwrap().to_linear()
    };
    assert_eq!(many(16, 3), many(16, 3));
    assert_ne!(many(16, 3), many(16, 4));
    // The mean over a texel of a table eight times as fine.
    let options = BakeOptions { side: 64, slices: Some(12 * 8), ..options(Symmetry::Two) };
    let fine = bake(&description, &options, &Progress::none()).unwrap().to_linear();
    let coarse = many(256, 1);
    for (i, j, s) in [(3, 4, 2u32), (5, 3, 7)] {
        let mut sum = 0.0;
        for k in 0..8u32 {
            // A coarse slice stands for half a step to both sides: fine slices 8s - 4 to 8s + 4, the ends by half.
            for (offset, share) in [(k, 0.5), (k + 1, 0.5)] {
                let slice = (8 * s + 96 + offset - 4) % 96;
                for y in 0..8 {
                    for x in 0..8 {
                        sum += share * fine.texel(8 * i + x, 8 * j + y, slice)[0] / 512.0;
                    }
                }
            }
        }
        let sampled = coarse.texel(i, j, s)[0];
        assert!((sampled - sum).abs() < 0.02 * sum, "{sampled} {sum}");
    }
}

#[test]
fn no_lights_no_samples_and_a_cancel_are_refused() {
    let none = |description: &Description, options: BakeOptions| {
        bake(description, &options, &Progress::none()).unwrap_err()
    };
    let dark = Description { lighting: None, ..satin() };
    assert!(none(&dark, options(Symmetry::Two)).to_string().contains("give the lights"));
    assert!(
        none(&satin(), BakeOptions { samples: 0, ..BakeOptions::default() })
            .to_string()
            .contains("0 samples")
    );
    assert!(none(&satin(), BakeOptions { side: 0, ..BakeOptions::default() }).to_string().contains("0 x 0"));
    let cancelled = std::sync::atomic::AtomicBool::new(true);
    let report = |_: crate::Step<'_>| {};
    let progress = Progress::new(&report, &cancelled);
    assert!(bake(&satin(), &options(Symmetry::Two), &progress).unwrap_err().is_cancelled());
}
