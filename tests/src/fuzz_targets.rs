//! What a fuzzer feeds. Each target takes any bytes and must end without a panic and without an allocation that the
//! bytes do not justify. The fuzz crate drives them with new bytes; the test `crashes` with those that once failed.

use std::path::Path;
use std::sync::LazyLock;

use amc_core::amc::Amc;
use amc_core::capture::Session;
use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Mesh};
use amc_core::reflectance::{self as reflectances, Lighting};
use amc_core::render::Camera;
use amc_core::{Progress, exchange, image::decode, mesh};
use amc_studio::project::{encode, parse};
use studio_plugin::document::{Document, Project};
use tangent_editor::import;
use wardrobe::cut::cut;
use wardrobe::pattern::Pattern;

/// A fuzz target's name and what it does with the bytes.
pub type Target = (&'static str, fn(&[u8]));

/// All targets. A parser is one line here and one file in the fuzz crate.
pub const TARGETS: [Target; 14] = [
    ("ktx2", ktx2),
    ("gltf", gltf),
    ("gltf_beside", gltf_beside),
    ("obj", obj),
    ("picture", picture),
    ("session", session),
    ("camera", camera),
    ("reflectance", reflectance),
    ("exchange", exchanged),
    ("slices", slices),
    ("pattern", pattern),
    ("project", project),
    ("dxf", dxf),
    ("directions", directions),
];

/// AMC files.
pub fn ktx2(bytes: &[u8]) {
    if let Ok(amc) = Amc::from_ktx2(bytes) {
        write_and_read(&amc);
    }
}

/// Whatever a reader lets through can be kept.
fn write_and_read(amc: &Amc) {
    let written = amc.to_ktx2().expect("a table that was read can be written");
    let again = Amc::from_ktx2(&written).expect("a table that was written can be read");
    let looked_up_alike =
        (again.symmetry, again.azimuth, again.frame) == (amc.symmetry, amc.azimuth, amc.frame);
    assert!(looked_up_alike && again.size() == amc.size() && again.metadata.name == amc.metadata.name);
    assert!(again.texels() == amc.texels(), "texels changed on the way through a file");
}

/// glTF, both containers; no files beside it.
pub fn gltf(bytes: &[u8]) {
    let no_files = |_: &str| Err(amc_core::Error::invalid("no files here"));
    if let Ok(mesh) = mesh::gltf::parse(bytes, &no_files) {
        cut_into_panels(mesh);
    }
    if let Ok((garment, said)) = mesh::gltf::anisotropy(bytes, &no_files) {
        assert_eq!(garment.panels.len(), said.len());
        assert!(said.iter().filter_map(|said| said.warp).all(|warp| warp.is_finite()));
    }
}

/// Stands between the files of an input that is several.
pub const NEXT_FILE: &[u8] = b"\0next file\0";

fn files(bytes: &[u8]) -> Vec<&[u8]> {
    let (mut files, mut rest) = (Vec::new(), bytes);
    while let Some(end) = rest.windows(NEXT_FILE.len()).position(|window| window == NEXT_FILE) {
        files.push(&rest[..end]);
        rest = &rest[end + NEXT_FILE.len()..];
    }
    files.push(rest);
    files
}

/// Gives the files one after the other, whatever they are asked for as.
fn in_turn<'a>(files: &'a [&'a [u8]]) -> impl Fn(&str) -> amc_core::Result<Vec<u8>> + 'a {
    let next = std::cell::Cell::new(0);
    move |_| {
        let file = files.get(next.replace(next.get() + 1));
        file.map(|file| file.to_vec()).ok_or_else(|| amc_core::Error::invalid("no more files"))
    }
}

/// glTF, and after [`NEXT_FILE`] each of the files beside it.
pub fn gltf_beside(bytes: &[u8]) {
    let files = files(bytes);
    if let Ok(mesh) = mesh::gltf::parse(files[0], &in_turn(&files[1..])) {
        cut_into_panels(mesh);
    }
}

/// Wavefront OBJ.
pub fn obj(bytes: &[u8]) {
    if let Ok(mesh) = mesh::obj::parse(bytes) {
        cut_into_panels(mesh);
    }
}

/// Whatever a reader lets through must stand the whole way to directions.
fn cut_into_panels(mesh: Mesh) {
    if let Ok(garment) = Garment::new(mesh) {
        let along_grain = Direction::along_grain;
        let directions: Vec<_> = garment.panels.iter().map(along_grain).collect();
        for pattern in garment.panels.iter().map(|panel| &panel.pattern) {
            let partners = pattern.seams.iter().map(|seam| seam.partner).chain(pattern.mirror);
            assert!(partners.max().is_none_or(|partner| partner < garment.panels.len()));
        }
        let tangents =
            amc_core::direction::tangents(&garment, &directions).expect("a checked garment has directions");
        for tangent in tangents.vectors.iter() {
            assert!((tangent.length() - 1.0).abs() < 1e-3, "a tangent of length {}", tangent.length());
        }
    }
}

/// Larger pictures are decoded, but not spread out to four floats a pixel: how large a picture may be is a stated limit,
/// and a blank one packs into next to nothing.
const MOST_PIXELS_SPREAD: u64 = 1 << 22;

/// JPEG, PNG and EXR, by their first bytes.
pub fn picture(bytes: &[u8]) {
    if let Ok(raster) = decode::decode(bytes)
        && u64::from(raster.width()) * u64::from(raster.height()) <= MOST_PIXELS_SPREAD
    {
        let picture = raster.to_picture();
        assert_eq!(picture.pixels().len(), picture.width() as usize * picture.height() as usize);
    }
}

/// `session.json`.
pub fn session(bytes: &[u8]) {
    if let Ok(session) = Session::parse(bytes) {
        assert!(session.pictures.iter().all(|picture| picture.angle_deg.is_finite()));
    }
}

/// `CAMERA.json`.
pub fn camera(bytes: &[u8]) {
    drop(Camera::from_json(bytes));
}

/// Reflectances and lights.
pub fn reflectance(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        drop(reflectances::parse(text));
        drop(Lighting::parse(text));
    }
}

/// Whatever single file an AMC may come in: slice atlases, MatCaps.
pub fn exchanged(bytes: &[u8]) {
    if let Ok(amc) = exchange::parse(bytes) {
        write_and_read(&amc);
    }
}

/// A slice folder: the list, and after [`NEXT_FILE`] each of the pictures.
pub fn slices(bytes: &[u8]) {
    let files = files(bytes);
    if let Ok(amc) = exchange::parse_slices(files[0], &in_turn(&files[1..])) {
        write_and_read(&amc);
    }
}

/// A garment's pattern, and whatever is let through cut coarsely.
pub fn pattern(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes)
        && let Ok(pattern) = Pattern::from_json(text)
        && let Ok(garment) = cut(&pattern, 0.1)
    {
        for piece in &garment.pieces {
            let count = piece.flat.len() as u32;
            assert!(piece.triangles.as_flattened().iter().all(|&corner| corner < count));
        }
    }
}

/// `.amcproj`: whatever is let through can be saved and read again.
pub fn project(bytes: &[u8]) {
    let folder = Some(Path::new("/clothes/coat"));
    if let Ok(read) = parse(bytes, folder) {
        read.project.check().expect("a project that was read is right");
        let written = encode(&read.project, &read.unknown, folder).expect("it can be saved");
        let again = parse(&written, folder).expect("what was saved can be read");
        assert!(
            again.project == read.project && again.unknown == read.unknown,
            "something was lost on the way"
        );
    }
}

/// DXF with grain lines, matched to the panels of a garment.
pub fn dxf(bytes: &[u8]) {
    if let Ok(entries) = import::parse_dxf(bytes) {
        take_in(&entries);
    }
}

/// The JSON of directions, matched likewise.
pub fn directions(bytes: &[u8]) {
    if let Ok(entries) = import::parse_json(bytes) {
        take_in(&entries);
    }
}

/// Whatever is let through can be done to a project.
fn take_in(entries: &[import::Entry]) {
    static GARMENT: LazyLock<Garment> = LazyLock::new(|| {
        let sheet = amc_core::shape::mesh("sheet").expect("a shape by its name");
        Garment::new(sheet).expect("a shape has panels")
    });
    let now = [Direction::along_grain(&GARMENT.panels[0])];
    if let Ok(import) = import::place(&GARMENT, &now, entries, &Progress::none()) {
        let mut document = Document::new(Project::default());
        let planned = import::edits(&import, &GARMENT, document.project()).expect("a project without locks");
        for edit in planned.edits {
            document.submit(edit, None).expect("what was let through is sound");
        }
    }
}
