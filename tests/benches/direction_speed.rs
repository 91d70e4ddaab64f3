//! The directions of a mesh of 470,000 triangles, against the crate `mikktspace` on the same mesh in the same run.
//! Prints the medians and their ratio; ends with 1 where the ratio is under [`LEAST_RATIO`].

use std::f32::consts::TAU;
use std::process::ExitCode;

use amc_core::direction::{Direction, Source, tangents};
use amc_core::mesh::{Garment, Panel};
use glam::{Vec2, Vec3};
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
    let garment = garment();
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

/// Waving panels side by side, their UVs sheared a little.
fn garment() -> Garment {
    let mut garment = Garment { has_uvs: true, ..Garment::default() };
    for panel in 0..PANELS {
        let (first, start) = (garment.positions.len() as u32, garment.triangles.len() as u32);
        for row in 0..=CELLS {
            for column in 0..=CELLS {
                let p = Vec2::new(column as f32, row as f32) / CELLS as f32;
                let (sin, cos) = (p.x * TAU * 3.0 + p.y + panel as f32).sin_cos();
                let slope = Vec2::new(TAU * 3.0, 1.0) * (0.05 * cos);
                garment.positions.push(Vec3::new(p.x + panel as f32 * 1.1, p.y, 0.05 * sin));
                garment.normals.push((-slope).extend(1.0).normalize_or(Vec3::Z));
                garment.uvs.push(Vec2::new(p.x + 0.1 * p.y * p.y, p.y));
                if row < CELLS && column < CELLS {
                    let k = first + row * (CELLS + 1) + column;
                    let above = k + CELLS + 1;
                    garment.triangles.extend([[k, k + 1, above + 1], [k, above + 1, above]]);
                }
            }
        }
        garment.panels.push(Panel {
            id: panel.to_string(),
            name: panel.to_string(),
            triangles: start..garment.triangles.len() as u32,
            takes_fabric: true,
            area: 1.0,
            flags: Default::default(),
            pattern: Default::default(),
        });
    }
    garment
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
