//! The directions of a mesh of 470,000 triangles, against the crate `mikktspace` on the same mesh in the same run.
//! Prints the medians and their ratio; ends with 1 where the ratio is under [`LEAST_RATIO`].

use std::process::ExitCode;

use amc_core::direction::{Direction, Source, tangents};
use amc_core::mesh::Garment;
use studio_tests::large_garment::waving_panels;
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

/// How many times faster than `mikktspace` the directions must be.
const LEAST_RATIO: f64 = 10.0;
/// How often each is timed, in turns.
const REPEATS: usize = 7;
/// Panels, and cells along each side of one: 14 x 2 x 130^2 = 473,200 triangles.
const PANELS: u32 = 14;
/// See [`PANELS`].
const CELLS: u32 = 130;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let garment = waving_panels(PANELS, CELLS);
    let directions: Vec<Direction> = (0..PANELS)
        .map(|k| Direction {
            source: if k % 2 == 0 { Source::Gradient } else { Source::Yarn },
            angle: k as f32 * 0.3,
        })
        .collect();
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        ours.push(timed(|| tangents(&garment, &directions).expect("a checked garment has directions")));
        let mut corners =
            Corners { garment: &garment, tangents: vec![[[0.0; 4]; 3]; garment.triangles.len()] };
        theirs.push(timed(|| assert!(mikktspace::generate_tangents(&mut corners))));
        if corners.tangents.as_flattened().iter().any(|tangent| tangent[3] == 0.0) {
            return fail("mikktspace gave no tangents");
        }
    }
    let (ours, theirs) = (median(ours), median(theirs));
    let ratio = theirs.as_secs_f64() / ours.as_secs_f64();
    report(&format!(
        "{} triangles, {} threads: directions {:.1} ms, mikktspace {:.1} ms: {ratio:.1} times faster",
        garment.triangles.len(),
        std::thread::available_parallelism().map_or(1, usize::from),
        milliseconds(ours),
        milliseconds(theirs)
    ));
    if ratio < LEAST_RATIO {
        return fail(&format!("under the {LEAST_RATIO} times that are promised"));
    }
    ExitCode::SUCCESS
}

#[allow(clippy::print_stdout, reason = "a benchmark's result is what it prints")]
fn report(line: &str) {
    println!("{line}");
}

#[allow(clippy::print_stderr, reason = "a benchmark's fault is what it prints")]
fn fail(line: &str) -> ExitCode {
    eprintln!("direction_speed: {line}");
    ExitCode::FAILURE
}

/// The same mesh as `mikktspace` asks for it.
struct Corners<'a> {
    garment: &'a Garment,
    tangents: Vec<[[f32; 4]; 3]>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.garment.triangles[face][corner] as usize
    }
}

impl mikktspace::Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.garment.triangles.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.garment.positions[self.vertex(face, corner)].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.garment.normals[self.vertex(face, corner)].to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.garment.uvs[self.vertex(face, corner)].to_array()
    }

    fn set_tangent_encoded(&mut self, tangent: [f32; 4], face: usize, corner: usize) {
        self.tangents[face][corner] = tangent;
    }
}
