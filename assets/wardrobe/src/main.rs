//! The wardrobe's command line.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use amc_core::{Error, Progress, Result, Step};
use clap::{Parser, Subcommand};
use wardrobe::body::Body;
use wardrobe::cut::CutGarment;
use wardrobe::drape::{self, Draped, Options};
use wardrobe::measure;
use wardrobe::pattern::Pattern;

/// Makes garments from patterns.
#[derive(Debug, Parser)]
#[command(version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Cut, sew and drape a pattern.
    Make {
        /// The pattern, a JSON file.
        pattern: PathBuf,
        /// The garment: .obj
        #[arg(short, long)]
        output: PathBuf,
        /// Length of the triangles' edges, metres.
        #[arg(long, default_value_t = 0.012, conflicts_with = "triangles")]
        edge_length: f64,
        /// About how many triangles, in place of their edges' length.
        #[arg(long)]
        triangles: Option<usize>,
    },
}

fn main() -> ExitCode {
    match run(&Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            #[allow(clippy::print_stderr, reason = "a command line's one line of error")]
            {
                eprintln!("wardrobe: {error}");
            }
            ExitCode::FAILURE
        }
    }
}

fn run(command: &Command) -> Result<()> {
    let Command::Make { pattern, output, edge_length, triangles } = command;
    let pattern = Pattern::read(pattern)?;
    let edge_length = match triangles {
        Some(triangles) => drape::edge_length_for(&pattern, *triangles)?,
        None => *edge_length,
    };
    let levels = drape::levels(&pattern, edge_length)?;
    let Some(finest) = levels.last() else { return Err(Error::invalid("nothing to cut")) };
    let body = Body::new(finest.figure);
    let started = std::time::Instant::now();
    let cancelled = AtomicBool::new(false);
    let last = std::sync::Mutex::new(String::new());
    let report = |step: Step<'_>| {
        if let Ok(mut last) = last.lock() && *last != step.stage {
            *last = step.stage.to_owned();
            #[allow(clippy::print_stderr, reason = "progress")]
            {
                eprintln!("{:6.1} s  {}", started.elapsed().as_secs_f64(), step.stage);
            }
        }
    };
    let options = Options::default();
    let (draped, rest) = drape::drape(&levels, &body, &options, &Progress::new(&report, &cancelled))?;
    let count: usize = finest.pieces.iter().map(|piece| piece.triangles.len()).sum();
    #[allow(clippy::print_stderr, reason = "progress")]
    {
        eprintln!("{}\n{}", measure::Figures::HEAD, measure::measure(finest, &draped, &body).row(&finest.name));
        eprintln!("{:6.1} s  {count} triangles, {} substeps, fastest {:.1} mm/s", started.elapsed().as_secs_f64(), rest.substeps, rest.fastest * 1e3);
    }
    write_obj(finest, &draped, output)
}

fn write_obj(garment: &CutGarment, draped: &Draped, path: &Path) -> Result<()> {
    let mut text = String::new();
    let mut first = 1;
    for (piece, places) in garment.pieces.iter().zip(&draped.positions) {
        let _ = writeln!(text, "o {}", piece.name);
        for p in places {
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", p.x, p.y, p.z);
        }
        for uv in &piece.flat {
            let _ = writeln!(text, "vt {:.6} {:.6}", uv.x, uv.y);
        }
        for [a, b, c] in piece.triangles.iter().map(|corners| corners.map(|corner| corner + first)) {
            let _ = writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}");
        }
        first += places.len() as u32;
    }
    std::fs::write(path, text).map_err(|error| Error::io("cannot write", error).in_file(path))
}
