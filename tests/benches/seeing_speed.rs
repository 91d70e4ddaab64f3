//! What is shown over the cloth of the bundled shirt: how long each way takes to be made for the whole garment, and how long after one panel
//! was turned. Prints the medians; ends with 1 where line integral convolution is over its bar.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use amc_core::Progress;
use amc_core::direction::{Direction, tangents};
use amc_core::mesh::{Garment, Unit, read};
use studio_tests::timing::{is_wanted, median, milliseconds, timed};
use tangent_editor::seeing::{Asked, Cut, Settings, Show, seen};

/// Line integral convolution of the whole shirt.
const BAR: Duration = Duration::from_millis(1500);
/// How often each is timed.
const REPEATS: usize = 5;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/garments/shirt.glb");
    let mesh = read(file.as_ref(), Unit::Metre).expect("the bundled shirt is read");
    let garment = Arc::new(Garment::new(mesh).expect("the bundled shirt has panels"));
    let mut is_within = true;
    for show in Show::ALL {
        let asked = |turned: usize, by: f32| {
            let mut directions: Vec<Direction> = garment.panels.iter().map(Direction::along_grain).collect();
            directions[turned].angle += by;
            let vectors = tangents(&garment, &directions).expect("a checked garment has directions").vectors;
            let cuts = directions.into_iter().map(|direction| Cut { direction, is_combed: false });
            Asked {
                garment: Arc::clone(&garment),
                vectors,
                cuts: cuts.collect(),
                show,
                settings: Settings::default(),
            }
        };
        let first = asked(0, 0.0);
        let made = |asked: &Asked, before| {
            seen(asked, before, &Progress::none()).expect("nothing stands in the way")
        };
        let whole = median((0..REPEATS).map(|_| timed(|| made(&first, None))).collect());
        let before = made(&first, None);
        let turn = |k: usize| {
            let turned = asked(0, 0.1 * (k + 1) as f32);
            timed(|| made(&turned, Some(&before)))
        };
        let again = median((0..REPEATS).map(turn).collect());
        report(&format!(
            "{}: the shirt {:.0} ms, one front turned {:.0} ms",
            show.id(),
            milliseconds(whole),
            milliseconds(again)
        ));
        is_within &= show != Show::Lines || whole <= BAR;
    }
    ExitCode::from(u8::from(!is_within))
}

#[allow(clippy::print_stdout, reason = "a benchmark's result is what it prints")]
fn report(line: &str) {
    println!("{line}");
}
