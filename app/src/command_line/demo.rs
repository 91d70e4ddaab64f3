//! Without a window: the first look. The bundled satin as a picture.

use std::path::Path;

use amc_core::image::encode;
use amc_core::mesh::Unit;
use amc_core::render::{Orientation, Shading, View};

use super::Outcome;
use super::output::Output;
use super::progress::with_progress;
use super::renderer::draw_anyhow;
use crate::scene::{Fabrics, drawing, load_garment, panel_looks};

/// What wears it.
const SCENE: &str = "garment:shirt";

/// Where the picture goes: the current folder.
const PICTURE: &str = "amc-studio.png";

/// Columns, and rows.
const SIDE: u32 = 1024;

/// `why`: what keeps the window from being opened.
pub(super) fn run(why: &str, output: &Output) -> Outcome {
    let garment = load_garment(Path::new(SCENE), Unit::Metre)?;
    let orientation = Orientation { yaw: -0.4, pitch: 0.15, roll: 0.0 };
    let view = View::fitted(&garment.positions, orientation, SIDE, SIDE)?;
    let (picture, renderer, without_device) = with_progress(|progress| {
        let mut fabrics = Fabrics::default();
        let looks = panel_looks(&garment, (None, None), &[], Some(&mut fabrics), progress)?;
        let drawing = drawing((&garment, None), (&looks, &[]), fabrics, true, progress)?;
        draw_anyhow(&drawing, &view, &Shading::default(), progress)
    })?;
    if let Some(error) = without_device {
        output.notice(&format!("drawn by the processor: {error}"));
    }
    let file = Path::new(PICTURE);
    encode::write_png(&picture, file, &[])?;
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let result = serde_json::json!({ "picture": file, "renderer": renderer });
    output.result(&result, || {
        format!(
            "No window can be opened: {why}. The bundled satin on {SCENE}: {}\n\
             Try also: amc-studio render {SCENE} -o picture.png --amc fabric:changeant --yaw 40",
            file.display()
        )
    })?;
    Ok(())
}
