//! The T-shirt of the collection, cut, sewn and draped: how long it takes, and how that grows with its vertices.
//!
//! Prints a line per size; exits 1 when the one that is kept as a file takes longer than the bar.

#![allow(clippy::print_stdout, reason = "its result is what it prints")]

use std::process::ExitCode;
use std::time::Instant;

use amc_core::Progress;
use studio_tests::timing::is_wanted;
use wardrobe::body::Body;
use wardrobe::collection::Entry;
use wardrobe::drape::{self, Options};
use wardrobe::measure;

/// Seconds for the T-shirt as it is kept, on two cores.
const BAR: f64 = 60.0;

/// Edge lengths, as shares of the kept file's.
const SIZES: [f64; 4] = [2.0, 1.4, 1.0, 0.7];

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let entry = Entry::named("t-shirt").expect("a garment of the collection");
    let pattern = entry.pattern().expect("a pattern");
    let mut kept = f64::INFINITY;
    println!("threads: {}", rayon::current_num_threads());
    for share in SIZES {
        let started = Instant::now();
        let levels = drape::levels(&pattern, entry.edge_length * share).expect("cuts");
        let finest = levels.last().expect("at least one cut");
        let body = Body::new(finest.figure);
        let (draped, rest) =
            drape::drape(&levels, &body, &Options::default(), &Progress::none()).expect("a draped garment");
        let seconds = started.elapsed().as_secs_f64();
        let figures = measure::measure(finest, &draped, &body);
        println!(
            "{} vertices, {} triangles: {seconds:.1} s, {} substeps of the finest, {} pierced",
            figures.vertices, figures.triangles, rest.substeps, figures.pierced
        );
        if share == 1.0 {
            kept = seconds;
        }
    }
    println!("as kept: {kept:.1} s (bar {BAR} s on two cores)");
    if kept <= BAR { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
