//! One panel's angle changed in a garment of 473,200 triangles in 14 panels: the processor's time from the new angle to all that the
//! next frame draws of it, tangents, drawing, upload. Prints the median and the bytes uploaded; ends with 1 where one is over its bar.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use amc_core::Progress;
use amc_core::direction::{Direction, Fineness, KeptTangents, PanelDirection};
use amc_core::render::gpu::{Backend, Gpu, Renderer};
use amc_core::render::{Cloth, Drawing};
use studio_tests::large_garment::waving_panels;
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

/// From an angle to its upload.
const BAR: Duration = Duration::from_millis(4);
const PANELS: u32 = 14;
/// 14 x 2 x 130^2 = 473,200 triangles.
const CELLS: u32 = 130;
const REPEATS: usize = 31;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let garment = Arc::new(waving_panels(PANELS, CELLS));
    let mut directions = vec![PanelDirection::plain(Direction::default()); PANELS as usize];
    let own: Vec<Direction> = directions.iter().map(|direction| direction.own).collect();
    let mut kept = KeptTangents::new(Arc::clone(&garment), &own).expect("a checked garment has directions");
    let vectors = || Arc::clone(&kept.tangents().vectors);
    let plain = Drawing::new(&garment, vectors(), None, Vec::new(), |_| Cloth::Plain).expect("a drawing");
    let gpu = Gpu::headless(Backend::Vulkan).expect("a graphics device");
    let renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(&plain).expect("the drawing fits the device");
    let (mut times, mut most) = (Vec::new(), 0);
    for k in 0..REPEATS {
        let panel = k % directions.len();
        times.push(timed(|| {
            directions[panel].own.angle += 0.1;
            assert!(kept.is_quick(&directions), "done in the frame, not in a job");
            kept.set(&directions, Fineness::Whole, Progress::none()).expect("angles are numbers");
            let vectors = Arc::clone(&kept.tangents().vectors);
            let drawing = plain.dressed(vectors, Vec::new(), |_| Cloth::Plain).expect("a drawing");
            most = most.max(renderer.update(&mut scene, &drawing).expect("the drawing fits the device"));
        }));
    }
    let (time, whole) = (median(times), 12 * garment.positions.len() as u64);
    report(&format!(
        "one panel of {} turned, {} triangles: {:.2} ms (bar {} ms), at most {most} of {whole} bytes uploaded",
        PANELS,
        garment.triangles.len(),
        milliseconds(time),
        BAR.as_millis()
    ));
    // A panel's share and what lies between its vertices.
    let is_partial = most <= whole / u64::from(PANELS) * 2;
    ExitCode::from(u8::from(!(is_partial && time <= BAR)))
}

#[allow(clippy::print_stdout, reason = "a benchmark's result is what it prints")]
fn report(line: &str) {
    println!("{line}");
}
