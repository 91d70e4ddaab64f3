//! Writes valid little files of every format to `tests/fuzz/corpus/TARGET`, for the fuzzer to start from.

use std::error::Error;
use std::path::Path;

use amc_core::amc::{Amc, TexelFormat};
use amc_core::bake::{BakeOptions, bake};
use amc_core::direction::{Direction, tangents};
use amc_core::image::{Picture, encode};
use amc_core::mesh::{Garment, gltf};
use amc_core::{Progress, exchange, export, reflectance};
// The coverage counters that all code here is built with live in libFuzzer.
use libfuzzer_sys as _;
use studio_fuzz::fuzz_targets::NEXT_FILE;

type Outcome = Result<(), Box<dyn Error>>;

/// Side of the pictures, pixels.
const SIDE: u32 = 8;

const OBJ: &str = "# quads, a polygon, groups, all forms of corners\nmtllib none.mtl\no cloth\ng front\nusemtl red\n\
    v 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 1.5 1e-1\nvt 0 0\nvt 1 0 0\nvt 1 1\nvt 0 1\nvt .5\nvn 0 0 1\n\
    f 1/1/1 2/2/1 3/3/1 4/4/1\ng back\ns 1\nf 4//1 3//1 5//1\nf -5/-5 -4/-4 -3/-3 \\\n -1/-1 -2/-2\n\
    usemtl buttons\nf 1 2 3 # bare\nl 1 2\np 1\nfo 1 3 5\n";

const SESSION: &str = r#"{"version": 1, "turn": "cw", "rig": {"camera": [1, null, true]}, "pictures": [
    {"file": "frames/0000.jpg", "angle_deg": 0.0}, {"file": "frames/0001.png", "angle_deg": 1.2e1, "exposure": 4}]}"#;

const CAMERAS: [&str; 2] = [
    r#"{"world_to_view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0.5,-1e-1,-3,1], "projection": {"perspective": {"fov_y_deg": 45}}}"#,
    r#"{"world_to_view": [0,1,0,0, -1,0,0,0, 0,0,1,0, 0,0,0,1], "projection": {"orthographic": {"half_height": 1.5}}}"#,
];

/// Version 0, and version 1 with something of everything.
const PROJECTS: [&str; 2] = [
    r#"{"garment": "shape:sheet", "fabric": "cloth/silk.amc.ktx2", "for": "Ada"}"#,
    r#"{"version": 1, "garment": {"path": "coat.glb", "content": "0123456789abcdef0123456789abcdef"},
    "fabrics": [{"id": 0, "name": "Satin", "asset": "fabric:satin"}, {"id": 7, "asset": {"path": "../silk.amc.ktx2"}}],
    "panels": {"front": {"fabric": 7, "direction": {"source": "yarn", "angle_deg": 9e1}, "visible": false},
    "back": {"fabric": null, "direction": {"source": {"field": {"around": {"origin": [0, 1, 0], "direction": [0, 0, 1]}}},
    "angle_deg": -1.5}, "hem": [1]}}, "view": {}, "notes": "two\nlines", "later": {"a": null}}"#,
];

/// The sheet by its id and by its name, with all that can be said.
const DIRECTIONS: &str = r#"{"version": 1, "panels": [{"id": "sheet", "source": "yarn", "angle_deg": -4.5e1, "orientation": "nap",
    "fabric": "Satin", "locked": true, "linked": false, "tangents": [[1, 0, 0]]}, {"name": "Sheet",
    "source": {"field": {"around": {"origin": [0, 1, 0], "direction": [0, 0, 1]}}}}, {"name": "hood", "angle_deg": null}]}"#;

/// A square of two metres by a name of its own, turned, in millimetres; and a block of other entities.
const DXF: &str = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n1\n2\nA\n0\nPOLYLINE\n8\n1\n66\n1\n0\nVERTEX\n8\n1\n10\n0\n20\n0\n\
    0\nVERTEX\n10\n1732\n20\n1000\n0\nVERTEX\n10\n732\n20\n2732\n0\nVERTEX\n10\n-1000\n20\n1732\n0\nSEQEND\n0\nLINE\n\
    8\n7\n10\n0\n20\n500\n11\n0\n21\n1500\n0\nTEXT\n8\n1\n1\nQUANTITY: 2\n0\nENDBLK\n0\nBLOCK\n2\nSHEET\n0\nLWPOLYLINE\n\
    8\n14\n90\n3\n10\n0\n20\n0\n10\n1\n20\n0\n10\n0\n20\n1\n0\nTEXT\n1\nANNOTATION: one-way\n0\nENDBLK\n0\nENDSEC\n0\nEOF\n";

const LIGHTS: &str = r#"{"version": 1, "ambient": [0.1, 0.1, 0.1], "lights": [{"towards": [0, 1, 2], "irradiance": [1, 2.5, 3]}]}"#;

/// A node with a turned child; quantised positions of one triangle, as a strip with a sparse accessor.
const GLTF: &str = r#"{"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_mesh_quantization"], "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"children": [1], "scale": [2, 2, -2]},
    {"mesh": 0, "name": "Body", "rotation": [0, 0, 0.6, 0.8], "extras": {"amc": {"version": 1, "fabric": true,
    "name": "Sleeve", "uv_unit_m": 1, "grain_deg": 9e1, "mirror": "Body", "seams": [{"name": "underarm",
    "edge": [[0, 0], [0, 1]], "partner": "Sleeve", "partner_edge": [[1, 0], [1, 1.5]]}]}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3",
    "max": [1, 1, 1], "min": [0, 0, 0], "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5121},
    "values": {"bufferView": 0}}}, {"bufferView": 1, "componentType": 5121, "count": 4, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 8}, {"buffer": 0, "byteOffset": 24, "byteLength": 4}],
    "buffers": [{"byteLength": 28, "uri": "data:;base64,AAAAAAAAAAD/fwAAAAAAAAAA/38AAAAAAAECAQ=="}]}"#;

/// What the data URI there holds.
const GLTF_BUFFER: [u8; 28] =
    [0, 0, 0, 0, 0, 0, 0, 0, 255, 127, 0, 0, 0, 0, 0, 0, 0, 0, 255, 127, 0, 0, 0, 0, 0, 1, 2, 1];

/// Exif data of one tag, the orientation: the first row is seen on the right.
const EXIF_ON_ITS_SIDE: &[u8] =
    b"Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";

fn main() -> Outcome {
    let satin = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/fabrics/satin.json");
    let satin = std::fs::read_to_string(satin)?;
    texts(&satin)?;
    meshes()?;
    let picture = gradient()?;
    pictures(&picture)?;
    for format in [TexelFormat::Srgb8, TexelFormat::Half] {
        let options = BakeOptions { side: SIDE, slices: Some(4), format, ..BakeOptions::default() };
        tables(&bake(&reflectance::parse(&satin)?, &options, &Progress::none())?)?;
    }
    Ok(())
}

fn put(target: &str, name: &str, bytes: &[u8]) -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    std::fs::create_dir_all(&folder)?;
    Ok(std::fs::write(folder.join(name), bytes)?)
}

fn texts(satin: &str) -> Outcome {
    put("obj", "all.obj", OBJ.as_bytes())?;
    put("gltf", "quantised.gltf", GLTF.as_bytes())?;
    put("directions", "directions.json", DIRECTIONS.as_bytes())?;
    put("dxf", "pieces.dxf", DXF.as_bytes())?;
    put("session", "session.json", SESSION.as_bytes())?;
    put("pattern", "t-shirt.json", include_bytes!("../../../../assets/wardrobe/patterns/t-shirt.json"))?;
    put("pattern", "scarf.json", include_bytes!("../../../../assets/wardrobe/patterns/scarf.json"))?;
    put("reflectance", "satin.json", satin.as_bytes())?;
    put("reflectance", "lights.json", LIGHTS.as_bytes())?;
    for (k, project) in PROJECTS.iter().enumerate() {
        put("project", &format!("{k}.amcproj"), project.as_bytes())?;
    }
    CAMERAS
        .iter()
        .enumerate()
        .try_for_each(|(k, camera)| put("camera", &format!("{k}.json"), camera.as_bytes()))
}

fn meshes() -> Outcome {
    let no_files = |_: &str| Err(amc_core::Error::invalid("no files here"));
    let garment = Garment::new(gltf::parse(GLTF.as_bytes(), &no_files)?)?;
    let directions = vec![Direction::default(); garment.panels.len()];
    let path = std::env::temp_dir().join("triangle.glb");
    let beside = GLTF.replace("data:;base64,AAAAAAAAAAD/fwAAAAAAAAAA/38AAAAAAAECAQ==", "buffer%201.bin");
    put("gltf_beside", "quantised.gltf", &[beside.as_bytes(), NEXT_FILE, &GLTF_BUFFER].concat())?;
    export::tangents(&garment, &tangents(&garment, &directions)?, &directions, &[], &path)?;
    put("gltf", "triangle.glb", &std::fs::read(&path)?)?;
    export::garment(&garment, &path)?;
    put("gltf", "garment.glb", &std::fs::read(&path)?)?;
    Ok(std::fs::remove_file(&path)?)
}

fn gradient() -> amc_core::Result<Picture> {
    let value = |k: u32| k as f32 / (SIDE * SIDE) as f32;
    let pixels =
        (0..SIDE * SIDE).map(|k| [value(k), 0.5, 1.0 - value(k), if k % 3 == 0 { 0.5 } else { 1.0 }]);
    Picture::new(SIDE, SIDE, pixels.collect())
}

fn pictures(picture: &Picture) -> Outcome {
    let samples: Vec<u8> = (0..SIDE * SIDE * 4).map(|k| (k * 37) as u8).collect();
    let mut files = vec![
        ("colour.png", encode::png(picture, &[("silk", "a text")])?),
        ("colour.exr", encode::exr(picture)?),
        ("deep.png", deep_png(&samples)?),
    ];
    let side = SIDE as u16;
    for (name, kind, colours, progressive) in [
        ("grey.jpg", jpeg_encoder::ColorType::Luma, 1, false),
        ("colour.jpg", jpeg_encoder::ColorType::Rgb, 3, false),
        ("progressive.jpg", jpeg_encoder::ColorType::Rgb, 3, true),
    ] {
        let mut bytes = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, 80);
        encoder.set_progressive(progressive);
        encoder.add_app_segment(1, EXIF_ON_ITS_SIDE.to_vec())?;
        encoder.encode(&samples[..(SIDE * SIDE) as usize * colours], side, side, kind)?;
        files.push((name, bytes));
    }
    for (name, bytes) in files {
        put("picture", name, &bytes)?;
        put("exchange", name, &bytes)?;
    }
    Ok(())
}

/// The list of a slice folder, and its pictures.
fn slice_folder(amc: &Amc) -> Result<Vec<u8>, Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("slices-{}", std::process::id()));
    let table = folder.with_extension("amc.ktx2");
    amc.save(&table)?;
    let slices = exchange::Hints { output: Some(exchange::Kind::Slices), ..exchange::Hints::default() };
    exchange::convert(&table, &folder, slices)?;
    let mut bytes = std::fs::read(folder.join("slices.json"))?;
    let suffix = if amc.format() == TexelFormat::Half { "exr" } else { "png" };
    for slice in 0..amc.size().slices() {
        bytes.extend(NEXT_FILE);
        bytes.extend(std::fs::read(folder.join(format!("slice-{slice:04}.{suffix}")))?);
    }
    std::fs::remove_dir_all(&folder)?;
    std::fs::remove_file(&table)?;
    Ok(bytes)
}

/// 16 bits a channel, a grey one with alpha.
fn deep_png(samples: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE, SIDE);
    encoder.set_color(png::ColorType::GrayscaleAlpha);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.write_header()?.write_image_data(samples)?;
    Ok(bytes)
}

/// A table as itself and as a slice atlas.
fn tables(amc: &Amc) -> Outcome {
    let (kind, suffix) = match amc.format() {
        TexelFormat::Srgb8 => ("srgb8", "png"),
        TexelFormat::Half => ("half", "exr"),
    };
    let name = format!("{kind}.amc.ktx2");
    put("ktx2", &name, &amc.to_ktx2()?)?;
    let (from, to) =
        (std::env::temp_dir().join(&name), std::env::temp_dir().join(format!("{kind}.atlas.{suffix}")));
    amc.save(&from)?;
    exchange::convert(&from, &to, exchange::Hints::default())?;
    let atlas = std::fs::read(&to)?;
    std::fs::remove_file(&from)?;
    std::fs::remove_file(&to)?;
    put("exchange", &format!("{kind}.atlas.{suffix}"), &atlas)?;
    put("slices", &format!("{kind}.slices"), &slice_folder(amc)?)?;
    put("exchange", &name, &amc.to_ktx2()?)
}
