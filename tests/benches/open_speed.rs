//! How long it takes to open a 500,000-triangle GLB as a checked mesh with panels, against the crate `gltf`: its
//! `import` and its readers collecting positions, normals, UVs and indices. Both in one run, taking turns.
//!
//! Prints the median times and their ratio; ends with 1 where the ratio is over 2.0.

use std::path::Path;
use std::process::ExitCode;

use amc_core::mesh::{Garment, Unit};
use studio_tests::large_garment;
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

const LIMIT: f64 = 2.0;
const ROUNDS: usize = 21;
/// Primitives, and islands in each.
const PRIMITIVES: usize = 6;
const ISLANDS: usize = 8;
/// Squares along a side of an island: 2 x 6 x 8 x 72 x 72 = 497,664 triangles.
const SIDE: usize = 72;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("garment.glb");
    amc_core::file::save_bytes(&path, &large_garment::glb(PRIMITIVES, ISLANDS, SIDE))
        .expect("the file is written");
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        theirs.push(timed(|| import(&path)));
        ours.push(timed(|| open(&path)));
    }
    let (ours, theirs) = (median(ours), median(theirs));
    let ratio = ours.as_secs_f64() / theirs.as_secs_f64();
    #[expect(clippy::print_stdout, reason = "a benchmark's figures are its output")]
    {
        println!(
            "open {:.1} ms, gltf import and readers {:.1} ms: ratio {ratio:.2}, limit {LIMIT}",
            milliseconds(ours),
            milliseconds(theirs)
        );
    }
    ExitCode::from(u8::from(ratio > LIMIT))
}

fn open(path: &Path) -> Garment {
    let mesh = amc_core::mesh::read(path, Unit::Metre).expect("the file is valid");
    let garment = Garment::new(mesh).expect("the mesh is valid");
    assert_eq!(garment.panels.len(), PRIMITIVES * ISLANDS);
    garment
}

/// Positions, normals, UVs and indices of a primitive.
type Arrays = (Vec<[f32; 3]>, Vec<[f32; 3]>, Vec<[f32; 2]>, Vec<u32>);

fn import(path: &Path) -> Vec<Arrays> {
    let (document, buffers, _) = gltf::import(path).expect("the file is valid");
    let read = |primitive: gltf::Primitive<'_>| {
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| data.0.as_slice()));
        let positions = reader.read_positions().expect("positions").collect();
        let normals = reader.read_normals().expect("normals").collect();
        let uvs = reader.read_tex_coords(0).expect("UVs").into_f32().collect();
        let indices = reader.read_indices().expect("indices").into_u32().collect();
        (positions, normals, uvs, indices)
    };
    document.meshes().flat_map(|mesh| mesh.primitives().map(read).collect::<Vec<_>>()).collect()
}
