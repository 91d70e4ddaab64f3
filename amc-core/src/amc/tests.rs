//! Conversions of whole tables, against reflectances evaluated directly.

use glam::Vec3;

use super::*;
use crate::Progress;
use crate::bake::{BakeOptions, bake};
use crate::color::srgb_from_linear;
use crate::reflectance::{Description, parse};
use crate::view_space::Azimuth;

/// A table whose texel at column, row and slice is what `texel` says.
pub(super) fn table(side: u32, slices: u32, texel: impl Fn(u32, u32, u32) -> [f32; 4]) -> LinearTable {
    let size = TableSize::new(side, slices).unwrap();
    let texels = (0..slices)
        .flat_map(|s| (0..side).flat_map(move |j| (0..side).map(move |i| (i, j, s))))
        .map(|(i, j, s)| texel(i, j, s))
        .collect();
    LinearTable { size, texels, symmetry: Symmetry::One, azimuth: Azimuth::Transported }
}

/// A cloth of crossed fibres; `weft` is the strength of one set, 1 for the other. Wide highlights, so that a table of
/// modest size holds them.
fn cloth(weft: f32) -> Description {
    let fibre = |weight: f32| {
        format!(
            r#"{{"weight": {weight}, "diffuse": [0.1, 0.05, 0.02], "specular": [0.3, 0.2, 0.1], "exponent": 12}}"#
        )
    };
    let (warp, weft) = (fibre(1.0), fibre(weft));
    parse(&format!(
        r#"{{"version": 1, "model": "line", "name": "test",
            "parameters": {{"warp": {warp}, "weft": {weft}, "ambient": [0.1, 0.1, 0.1]}},
            "lighting": {{"lights": [{{"towards": [-1, 2, 2], "irradiance": [1, 1, 1]}},
                                     {{"towards": [2, 0, 1], "irradiance": [0.5, 0.5, 0.6]}}],
                          "ambient": [0.2, 0.2, 0.2]}}}}"#
    ))
    .unwrap()
}

fn baked(cloth: &Description, side: u32, slices: u32, symmetry: Symmetry, azimuth: Azimuth) -> LinearTable {
    let options = BakeOptions {
        side,
        slices: Some(slices),
        symmetry: Some(symmetry),
        azimuth,
        format: TexelFormat::Half,
        ..BakeOptions::default()
    };
    bake(cloth, &options, &Progress::none()).unwrap().to_linear()
}

/// PSNR of sRGB-encoded values.
fn psnr(pairs: impl Iterator<Item = ([f32; 3], [f32; 3])>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (a, b) in pairs {
        for (a, b) in a.iter().zip(b) {
            sum += f64::from(srgb_from_linear(*a) - srgb_from_linear(b)).powi(2);
            count += 1.0;
        }
    }
    -10.0 * (sum / f64::max(count, 1.0)).max(1e-12).log10()
}

fn colour(texel: [f32; 4]) -> [f32; 3] {
    [texel[0], texel[1], texel[2]]
}

/// PSNR of two tables of one size over the texels on the disc.
fn likeness(a: &LinearTable, b: &LinearTable) -> f64 {
    assert_eq!((a.size, a.symmetry, a.azimuth), (b.size, b.symmetry, b.azimuth));
    let disc = a.size.disc();
    let texels = a.texels.iter().zip(&b.texels).zip(disc.iter().cycle());
    psnr(texels.filter(|(_, on)| **on).map(|((a, b), _)| (colour(*a), colour(*b))))
}

/// PSNR of look-ups against a table so fine that it stands for the truth, at even-spread normals and tangents.
fn fidelity(table: &LinearTable, truth: &LinearTable) -> f64 {
    let golden = 2.399_963_2_f32;
    psnr((0..20_000).map(|k| {
        let z = 0.1 + 0.9 * (k as f32 + 0.5) / 20_000.0;
        let xy = glam::Vec2::from_angle(k as f32 * golden) * (1.0 - z * z).sqrt();
        let phi = (k as f32 * 0.754_877_7).fract() * std::f32::consts::TAU;
        let n = Vec3::new(xy.x, xy.y, z);
        let t = Azimuth::Transported.tangent(n, phi);
        (table.look_up(xy, table.azimuth.of(n, t)), truth.look_up(xy, truth.azimuth.of(n, t)))
    }))
}

#[test]
fn converting_the_azimuth_gives_what_baking_in_it_gives() {
    let cloth = cloth(0.3);
    let both = [Azimuth::Transported, Azimuth::Projected];
    let [transported, projected] = both.map(|azimuth| baked(&cloth, 32, 64, Symmetry::Two, azimuth));
    let to_projected = likeness(&transported.with_azimuth(Azimuth::Projected).unwrap(), &projected);
    let to_transported = likeness(&projected.with_azimuth(Azimuth::Transported).unwrap(), &transported);
    assert!(to_projected > 55.0, "{to_projected}");
    // Near the rim the projected axis is stretched up to 1/n_z: fewer samples where the cloth changes most.
    assert!(to_transported > 40.0, "{to_transported}");
    assert_eq!(transported.with_azimuth(Azimuth::Transported).unwrap(), transported);
}

#[test]
fn a_four_fold_table_converts_through_the_whole_turn() {
    let cloth = cloth(1.0);
    let quarter = baked(&cloth, 32, 32, Symmetry::Four, Azimuth::Transported);
    let projected = quarter.with_azimuth(Azimuth::Projected).unwrap();
    assert_eq!((projected.symmetry, projected.size.slices()), (Symmetry::Two, 64));
    let direct = baked(&cloth, 32, 64, Symmetry::Two, Azimuth::Projected);
    let likeness = likeness(&projected, &direct);
    assert!(likeness > 50.0, "{likeness}");
}

#[test]
fn a_four_fold_cloth_at_a_quarter_of_its_slices_loses_nothing_transported_and_much_projected() {
    let cloth = cloth(1.0);
    let truth = baked(&cloth, 128, 256, Symmetry::Four, Azimuth::Transported);
    let loss = |azimuth| {
        let whole = baked(&cloth, 48, 128, Symmetry::One, azimuth);
        let quarter = whole.folded(Symmetry::Four).unwrap();
        assert_eq!(quarter.size.slices(), 32);
        fidelity(&whole, &truth) - fidelity(&quarter, &truth)
    };
    let (transported, projected) = (loss(Azimuth::Transported), loss(Azimuth::Projected));
    assert!(transported < 0.5, "{transported}");
    assert!(projected > 5.0, "{projected}");
}

#[test]
fn folding_into_three_averages_directions_between_slices() {
    // One wave that a third of a turn repeats and one that it does not: folding keeps the first and cancels the second.
    let size = TableSize::new(4, 64).unwrap();
    let value = |s: usize| {
        let turn = s as f32 / 64.0 * std::f32::consts::TAU;
        2.0 + (3.0 * turn).cos() + 0.5 * (2.0 * turn).sin()
    };
    let texels = (0..64).flat_map(|s| vec![[value(s), 0.0, 0.0, 1.0]; 16]).collect();
    let table = LinearTable { size, texels, symmetry: Symmetry::One, azimuth: Azimuth::Transported };
    let folded = table.folded(Symmetry::Three).unwrap();
    assert_eq!((folded.symmetry, folded.size.slices()), (Symmetry::Three, 22));
    for s in 0..22 {
        let wave = (s as f32 / 22.0 * std::f32::consts::TAU).cos();
        let texel = folded.texel(1, 2, s);
        assert!((texel[0] - 2.0 - wave).abs() < 2e-3 && texel[3] == 1.0, "{s}: {texel:?}");
    }
    // A whole number of slices to a third: nothing is interpolated.
    let exact = table.with_symmetry(Symmetry::Three, 64).unwrap();
    assert!((exact.texel(0, 1, 0)[0] - 3.0).abs() < 2e-3);
}

#[test]
fn unfolding_repeats_the_table_and_folding_brings_it_back() {
    for symmetry in Symmetry::ALL {
        let size = TableSize::new(2, 8).unwrap();
        let texels = (0..32).map(|k| [k as f32, 0.5, 0.0, 1.0]).collect();
        let table = LinearTable { size, texels, symmetry, azimuth: Azimuth::Transported };
        let whole = table.folded(Symmetry::One).unwrap();
        assert_eq!(whole.size.slices(), 8 * symmetry.order());
        for s in 0..whole.size.slices() {
            assert_eq!(whole.texel(1, 0, s), table.texel(1, 0, s % 8));
        }
        let back = whole.folded(symmetry).unwrap();
        assert_eq!(back.size, table.size);
        for (a, b) in back.texels.iter().zip(&table.texels) {
            assert!((a[0] - b[0]).abs() < 1e-4 && a[3] == 1.0);
        }
    }
}

#[test]
fn the_isotropic_matcap_is_the_mean_with_the_top_row_first() {
    let size = TableSize::new(2, 3).unwrap();
    let texels = (0..12).map(|k| [k as f32, 0.0, 1.0, 1.0]).collect();
    let table = LinearTable { size, texels, symmetry: Symmetry::One, azimuth: Azimuth::Transported };
    let matcap = table.isotropic();
    // Texel (i, j) holds 4s + 2j + i: its mean over s = 0, 1, 2 is 4 + 2j + i.
    assert_eq!(
        matcap.pixels(),
        [[6.0, 0.0, 1.0, 1.0], [7.0, 0.0, 1.0, 1.0], [4.0, 0.0, 1.0, 1.0], [5.0, 0.0, 1.0, 1.0]]
    );
}

#[test]
fn storing_checks_what_it_is_given() {
    let size = TableSize::new(1, 1).unwrap();
    let table = |value| LinearTable {
        size,
        texels: vec![[value, 0.0, 0.0, 1.0]],
        symmetry: Symmetry::One,
        azimuth: Azimuth::Transported,
    };
    let store = |value, format| Amc::from_linear(&table(value), format, Frame::Half, Metadata::default());
    assert!(store(f32::NAN, TexelFormat::Srgb8).is_err());
    let error = store(1e6, TexelFormat::Half).unwrap_err().to_string();
    assert!(error.starts_with("texel at column 0, row 0, slice 0"), "{error}");
    assert_eq!(store(1e6, TexelFormat::Srgb8).unwrap().to_linear().texels[0][0], 1.0);
    assert_eq!(store(1.5, TexelFormat::Half).unwrap().to_linear().texels[0][0], 1.5);
}

#[test]
fn a_summary_has_what_inspect_promises() {
    let size = TableSize::new(4, 2).unwrap();
    let filled = |k: usize| k % 16 == 5;
    let texel = |k| [9, 9, 9, if filled(k) { 128 } else { 255 }];
    let texels = Texels::Srgb8((0..size.texels()).map(texel).collect());
    let amc = Amc::new(size, texels, Symmetry::Two, Azimuth::Projected, Frame::Full).unwrap();
    let json = serde_json::to_value(amc.summary()).unwrap();
    for (key, value) in [
        ("kind", "amc".into()),
        ("size", 4.into()),
        ("slices", 2.into()),
        ("symmetry", 2.into()),
        ("azimuth", "projected".into()),
        ("frame", "full".into()),
        ("format", "R8G8B8A8_SRGB".into()),
        ("bytes", serde_json::Value::from(128)),
    ] {
        assert_eq!(json[key], value, "{key}");
    }
    // Twelve of sixteen texels lie on the disc; one of them was filled in.
    assert!((amc.summary().measured - 11.0 / 12.0).abs() < 1e-9);
}
