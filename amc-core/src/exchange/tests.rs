use half::f16;

use super::*;
use crate::ErrorKind;
use crate::amc::{Frame, Symmetry, TableSize, TexelFormat, Texels};
use crate::image::{Picture, decode, encode};
use crate::pseudo_random::PseudoRandom;
use crate::view_space::Azimuth;

fn amc(format: TexelFormat) -> Amc {
    let size = TableSize::new(5, 7).unwrap();
    let texels = match format {
        TexelFormat::Srgb8 => {
            let texel = |k: usize| {
                [k as u8, (k * 3) as u8, (k * 5) as u8, if k.is_multiple_of(2) { 255 } else { 128 }]
            };
            Texels::Srgb8((0..size.texels()).map(texel).collect())
        }
        TexelFormat::Half => {
            let texel = |k: usize| [k as f32 * 0.01, 3.7, 0.123, (k % 4) as f32 / 3.0].map(f16::from_f32);
            Texels::Half((0..size.texels()).map(texel).collect())
        }
    };
    let mut amc = Amc::new(size, texels, Symmetry::Four, Azimuth::Projected, Frame::Full).unwrap();
    amc.metadata.name = "Μετάξι".into();
    amc
}

fn saved(folder: &Path, format: TexelFormat) -> (Amc, std::path::PathBuf) {
    let (amc, path) = (amc(format), folder.join("in.amc.ktx2"));
    amc.save(&path).unwrap();
    (amc, path)
}

#[test]
fn every_form_that_keeps_all_brings_all_back() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (format, outputs) in [
        (TexelFormat::Srgb8, ["a.png", "slices8", "b.atlas.png"]),
        (TexelFormat::Half, ["a.atlas.exr", "slices16", "b.ktx2"]),
    ] {
        let (amc, input) = saved(folder, format);
        for name in outputs {
            let output = folder.join(name);
            let there = convert(&input, &output, Hints::default()).unwrap();
            assert_eq!((there.from, there.lost), (Kind::Amc, vec![]), "{name}");
            let back = folder.join("back.amc.ktx2");
            let converted = convert(&output, &back, Hints::default()).unwrap();
            assert_eq!((converted.from, converted.to), (there.to, Kind::Amc), "{name}");
            assert_eq!(Amc::read(&back).unwrap(), amc, "{name}");
        }
    }
}

#[test]
fn what_is_lost_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (_, input) = saved(folder, TexelFormat::Half);
    let converted = convert(&input, &folder.join("a.atlas.png"), Hints::default()).unwrap();
    // Every texel's green is 3.7.
    assert!(converted.lost[0].contains("175 of 175 colours"), "{:?}", converted.lost);
    let converted = convert(&input, &folder.join("a.exr"), Hints::default()).unwrap();
    assert_eq!((converted.to, converted.lost.len()), (Kind::MatCap, 1));
}

#[test]
fn an_atlas_has_its_first_slice_top_left_and_upright() {
    let folder = tempfile::tempdir().unwrap();
    let (amc, input) = saved(folder.path(), TexelFormat::Srgb8);
    let output = folder.path().join("a.png");
    convert(&input, &output, Hints::default()).unwrap();
    let picture = decode::read(&output).unwrap();
    // Seven slices stand in rows of three; the last row holds one.
    assert_eq!((picture.width(), picture.height()), (15, 15));
    let table = amc.to_linear();
    assert_eq!(picture.pixel(0, 0), table.texel(0, 4, 0));
    assert_eq!(picture.pixel(5 + 2, 5 + 4), table.texel(2, 0, 4));
    assert_eq!(picture.pixel(14, 14), [0.0; 4]);
}

#[test]
fn a_matcap_becomes_one_slice_with_its_top_row_last() {
    let folder = tempfile::tempdir().unwrap();
    let pixels = (0..64).map(|k| [(k / 8) as f32 / 8.0, (k % 8) as f32 / 8.0, 0.5, 1.0]).collect();
    let mut picture = Picture::new(8, 8, pixels).unwrap();
    // Background, off the disc.
    picture.pixels_mut()[0] = [9.0, 9.0, 9.0, 1.0];
    let (input, output) = (folder.path().join("ball.exr"), folder.path().join("ball.amc.ktx2"));
    encode::write_exr(&picture, &input).unwrap();
    let converted = convert(&input, &output, Hints::default()).unwrap();
    assert_eq!(converted.from, Kind::MatCap);
    let amc = Amc::read(&output).unwrap();
    assert_eq!((amc.size().side(), amc.size().slices(), amc.format()), (8, 1, TexelFormat::Half));
    let table = amc.to_linear();
    assert_eq!(table.texel(3, 7, 0), picture.pixel(3, 0));
    assert_eq!(table.texel(4, 2, 0), picture.pixel(4, 5));
    // And out again: the corner shows the rim, the rest is as it was.
    let again = folder.path().join("again.exr");
    convert(&output, &again, Hints::default()).unwrap();
    let back = decode::read(&again).unwrap();
    assert_eq!(back.pixel(4, 5), picture.pixel(4, 5));
    assert!(back.pixel(0, 0)[0] < 0.2 && (back.pixel(0, 0)[2] - 0.5).abs() < 1e-3);
}

#[test]
fn hints_win_over_names() {
    let folder = tempfile::tempdir().unwrap();
    let (_, input) = saved(folder.path(), TexelFormat::Srgb8);
    let (atlas, output) = (folder.path().join("a.png"), folder.path().join("m.png"));
    convert(&input, &atlas, Hints::default()).unwrap();
    let hints = Hints { output: Some(Kind::MatCap), ..Hints::default() };
    assert_eq!(convert(&input, &output, hints).unwrap().to, Kind::MatCap);
    assert_eq!(decode::read(&output).unwrap().width(), 5);
    let hints = Hints { input: Some(Kind::MatCap), ..Hints::default() };
    convert(&atlas, &folder.path().join("c.ktx2"), hints).unwrap();
    let read = Amc::read(&folder.path().join("c.ktx2")).unwrap();
    assert_eq!((read.size().side(), read.size().slices()), (15, 1));
}

#[test]
fn refusals_say_what_is_wrong_and_where() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (_, input) = saved(folder, TexelFormat::Srgb8);
    let refused = |input: &Path, output: &str| {
        convert(input, &folder.join(output), Hints::default()).unwrap_err().to_string()
    };
    assert!(refused(&input, "a.tiff").contains("a.tiff: the name does not say what to write"));
    assert!(refused(&input, "a.jpg").contains("the name does not say"));
    std::fs::create_dir(folder.join("empty")).unwrap();
    assert!(refused(&folder.join("empty"), "a.ktx2").contains("empty: a folder without `slices.json`"));
    file::save_bytes(&folder.join("a.txt"), b"hello").unwrap();
    assert!(refused(&folder.join("a.txt"), "a.ktx2").contains("a.txt: neither an AMC nor a picture"));
    let wide = Picture::new(4, 3, vec![[1.0; 4]; 12]).unwrap();
    encode::write_png(&wide, &folder.join("wide.png"), &[]).unwrap();
    assert!(refused(&folder.join("wide.png"), "a.ktx2").contains("wide.png: 4 x 3 pixels"));
    // An atlas that was cropped.
    convert(&input, &folder.join("atlas.png"), Hints::default()).unwrap();
    let bytes = std::fs::read(folder.join("atlas.png")).unwrap();
    let text = sheet::text(&bytes, "amc").unwrap();
    encode::write_png(&wide, &folder.join("cropped.png"), &[("amc", &text)]).unwrap();
    assert!(refused(&folder.join("cropped.png"), "a.ktx2").contains("its slices need 15 x 15"));
    encode::write_png(&wide, &folder.join("broken.png"), &[("amc", "{\n oops")]).unwrap();
    assert!(refused(&folder.join("broken.png"), "a.ktx2").contains("line 2, column 2"));
}

#[test]
fn a_list_of_slices_cannot_reach_out_of_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let (_, input) = saved(folder.path(), TexelFormat::Srgb8);
    let slices = folder.path().join("slices");
    convert(&input, &slices, Hints::default()).unwrap();
    let list = slices.join("slices.json");
    let json = std::fs::read_to_string(&list).unwrap();
    file::save_bytes(&list, json.replace("slice-0003.png", "../secret.png").as_bytes()).unwrap();
    let error = read(&slices).unwrap_err();
    assert!(error.to_string().contains("slices[3]"), "{error}");
    file::save_bytes(&list, json.replace("slice-0003.png", "missing.png").as_bytes()).unwrap();
    assert_eq!(read(&slices).unwrap_err().kind(), ErrorKind::Io);
}

#[test]
fn every_kind_has_a_form() {
    for kind in [Kind::Amc, Kind::Atlas, Kind::Slices, Kind::MatCap] {
        assert_eq!(form(kind).kind, kind);
        let name = serde_json::to_value(kind).unwrap();
        assert_eq!(name.as_str().unwrap().parse::<Kind>().unwrap(), kind);
    }
    assert!("tiff".parse::<Kind>().unwrap_err().to_string().contains("amc, atlas, slices, matcap"));
}

#[test]
fn a_picture_is_a_slice_once() {
    let folder = tempfile::tempdir().unwrap();
    let (_, input) = saved(folder.path(), TexelFormat::Srgb8);
    let slices = folder.path().join("slices");
    convert(&input, &slices, Hints::default()).unwrap();
    let list = slices.join("slices.json");
    let json = std::fs::read_to_string(&list).unwrap();
    file::save_bytes(&list, json.replace("slice-0003.png", "slice-0002.png").as_bytes()).unwrap();
    let error = read(&slices).unwrap_err().to_string();
    assert!(error.contains("slices.json: slices[3]: ") && error.contains("named twice"), "{error}");
}

/// Bytes changed, and perhaps cut short.
fn mutated(bytes: &[u8], numbers: &mut PseudoRandom) -> Vec<u8> {
    let mut mutated = bytes.to_vec();
    for _ in 0..1 + numbers.below(3) {
        mutated[numbers.below(bytes.len())] = numbers.byte();
    }
    mutated.truncate(if numbers.below(4) == 0 { numbers.below(bytes.len()) } else { bytes.len() });
    mutated
}

#[test]
fn mutated_atlases_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut numbers = PseudoRandom::new(7);
    let mut read = 0;
    for (format, name) in [(TexelFormat::Srgb8, "a.png"), (TexelFormat::Half, "a.atlas.exr")] {
        let (_, input) = saved(folder, format);
        let output = folder.join(name);
        convert(&input, &output, Hints::default()).unwrap();
        let bytes = std::fs::read(&output).unwrap();
        for _ in 0..1500 {
            if let Ok(amc) = parse(&mutated(&bytes, &mut numbers)) {
                assert!(amc.size().texels() > 0);
                read += 1;
            }
        }
    }
    assert!(read > 10, "the good way was taken {read} times");
}

#[test]
fn mutated_lists_and_slices_never_panic_and_what_is_read_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let mut numbers = PseudoRandom::new(8);
    for format in [TexelFormat::Srgb8, TexelFormat::Half] {
        let (amc, input) = saved(folder.path(), format);
        let slices = folder.path().join(format!("{format:?}"));
        convert(&input, &slices, Hints::default()).unwrap();
        let list = std::fs::read(slices.join("slices.json")).unwrap();
        let beside = |name: &str| file::read(&slices.join(name), 1 << 20);
        assert_eq!(parse_slices(&list, &beside).unwrap(), amc);
        let mut read = 0;
        for k in 0..1200 {
            let spoilt_list = if k % 2 == 0 { mutated(&list, &mut numbers) } else { list.clone() };
            let spoilt_slice = numbers.below(amc.size().slices() as usize);
            let seed = numbers.below(1 << 16) as u32;
            let picture = |name: &str| {
                let bytes = beside(name)?;
                let spoilt = k % 2 == 1 && name.contains(&format!("{spoilt_slice:04}"));
                Ok(if spoilt { mutated(&bytes, &mut PseudoRandom::new(seed)) } else { bytes })
            };
            if let Ok(again) = parse_slices(&spoilt_list, &picture) {
                assert_eq!(again.size(), amc.size());
                read += 1;
            }
        }
        assert!(read > 10, "{format:?}: the good way was taken {read} times");
    }
}

#[test]
fn light_that_half_floats_cannot_hold_is_refused() {
    let picture = Picture::new(2, 1, vec![[1.0; 4], [1.0, 70_000.0, 1.0, 1.0]]).unwrap();
    let error = sheet::Sheet::decode(&encode::exr(&picture).unwrap()).unwrap_err();
    assert!(error.to_string().starts_with("pixel 1, 0: "), "{error}");
}

#[test]
fn a_text_that_unpacks_to_too_much_is_none() {
    for (length, read) in [(1 << 20, true), (17 << 20, false)] {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.add_ztxt_chunk("amc".into(), " ".repeat(length)).unwrap();
        encoder.write_header().unwrap().write_image_data(&[0]).unwrap();
        assert_eq!(sheet::text(&bytes, "amc").is_some(), read, "{length}");
    }
}
