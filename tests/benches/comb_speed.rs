//! A panel's direction combed by strokes: a first solution, an edit, a large panel, its preview.
//! Prints the medians; ends with 1 where one is over its bar.

use std::process::ExitCode;
use std::time::Duration;

use amc_core::Progress;
use amc_core::direction::comb::{Comb, CombSolver, Elsewhere, Hold, PanelMesh, Path, Stroke};
use amc_core::mesh::{Garment, Panel};
use glam::{Vec2, Vec3};
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

/// Cells along each side: 59^2 = 3,481 vertices.
const SMALL: u32 = 58;
/// Cells along each side: 490^2 = 240,100 vertices.
const LARGE: u32 = 489;
/// How often each is timed.
const REPEATS: usize = 7;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let small = Subject::new(SMALL);
    let large = Subject::new(LARGE);
    let mut is_within = true;
    let mut check = |what: &str, bar: f64, times: Vec<Duration>| {
        let time = milliseconds(median(times));
        report(&format!("{what}: {time:.1} ms (bar {bar} ms)"));
        is_within &= time <= bar;
    };
    check("3,481 vertices, mesh and first solution", 60.0, small.first(REPEATS));
    check("3,481 vertices, a stroke moved", 15.0, small.edits(REPEATS, Work::Solve));
    check("240,100 vertices, mesh and first solution", 3000.0, large.first(3));
    check("240,100 vertices, a stroke moved", 3000.0, large.edits(3, Work::Solve));
    check("240,100 vertices, a stroke moved, preview", 100.0, large.edits(REPEATS, Work::Preview));
    if is_within { ExitCode::SUCCESS } else { fail("over a bar") }
}

#[allow(clippy::print_stdout, reason = "a benchmark's result is what it prints")]
fn report(line: &str) {
    println!("{line}");
}

#[allow(clippy::print_stderr, reason = "a benchmark's fault is what it prints")]
fn fail(line: &str) -> ExitCode {
    eprintln!("comb_speed: {line}");
    ExitCode::FAILURE
}

/// What is timed.
#[derive(Clone, Copy, PartialEq)]
enum Work {
    Solve,
    Preview,
}

/// A waving panel of a square metre.
struct Subject {
    garment: Garment,
    /// The direction it has without a comb.
    own: Vec<Vec3>,
}

impl Subject {
    fn new(cells: u32) -> Self {
        let mut garment = Garment { has_uvs: true, ..Garment::default() };
        for row in 0..=cells {
            for column in 0..=cells {
                let p = Vec2::new(column as f32, row as f32) / cells as f32;
                let (sin, cos) = (p.x * 12.0 + p.y).sin_cos();
                garment.positions.push(p.extend(0.03 * sin));
                garment
                    .normals
                    .push((Vec2::new(12.0, 1.0) * (-0.03 * cos)).extend(1.0).normalize_or(Vec3::Z));
                garment.uvs.push(p);
                if row < cells && column < cells {
                    let k = row * (cells + 1) + column;
                    let above = k + cells + 1;
                    garment.triangles.extend([[k, k + 1, above + 1], [k, above + 1, above]]);
                }
            }
        }
        garment.panels.push(Panel {
            id: "panel".to_owned(),
            name: "panel".to_owned(),
            triangles: 0..garment.triangles.len() as u32,
            takes_fabric: true,
            area: 1.0,
            flags: Default::default(),
            pattern: Default::default(),
        });
        let own = garment.normals.iter().map(|n| (Vec3::X - *n * n.x).normalize_or(Vec3::X)).collect();
        Self { garment, own }
    }

    fn solver(&self) -> CombSolver {
        CombSolver::new(PanelMesh::new(&self.garment, &self.garment.panels[0]).expect("a sound panel"))
    }

    fn run(&self, solver: &mut CombSolver, comb: &Comb, work: Work) {
        let field = match work {
            Work::Solve => solver.solve(comb, 4, &self.own, Progress::none()),
            Work::Preview => solver.preview(comb, 4, &self.own, Progress::none()),
        };
        assert!(field.expect("a sound comb has a field").unplaced.is_empty());
    }

    /// Everything from the garment on.
    fn first(&self, times: usize) -> Vec<Duration> {
        (0..times).map(|_| timed(|| self.run(&mut self.solver(), &comb(0.0), Work::Solve))).collect()
    }

    /// Another place of a stroke each time.
    fn edits(&self, times: usize, work: Work) -> Vec<Duration> {
        let mut solver = self.solver();
        self.run(&mut solver, &comb(0.0), work);
        (1..=times).map(|k| timed(|| self.run(&mut solver, &comb(k as f32 * 0.02), work))).collect()
    }
}

/// Four strokes, one of them at a place of its own.
fn comb(place: f32) -> Comb {
    let bow = |x: f32, y: f32| {
        let points =
            (0..=50).map(|k| Vec2::new(x, y) + 0.3 * Vec2::from_angle(0.3 + k as f32 * 0.02)).collect();
        Stroke { path: Path::Pattern(points), hold: Hold::Exact, radius: 0.05, is_on: true }
    };
    let soft = Stroke { hold: Hold::Soft(1.0), ..bow(0.5, 0.5) };
    Comb {
        strokes: vec![bow(0.1, 0.1), bow(0.4, 0.2), soft, bow(0.1 + place, 0.6)],
        elsewhere: Elsewhere::Own,
        reach: 0.1,
        turn: 0.0,
    }
}
