//! Remakes the fidelity table of BENCHMARKS.md from a data folder:
//! `cargo run --release -p studio-tests --example fidelity -- DATA`.
//!
//! The folder holds `ball-ideal/frames`, `ball-camera/frames` and `scenes/` (meshes, cameras and an independent path
//! tracer's pictures). Nothing is tuned: every table is what `build` makes of the pictures with its defaults.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "its result is what it prints")]

use std::path::Path;
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::capture::{self, BuildOptions};
use amc_core::direction::{self, Direction, Source};
use amc_core::image::{compare::psnr_srgb, decode};
use amc_core::mesh::{self, Garment, Unit};
use amc_core::render::{Camera, Cloth, Drawing, Mode, Orientation, Perspective, Shading, View, cpu};
use amc_core::view_space::Azimuth;
use amc_core::{Progress, Result};

fn main() -> std::process::ExitCode {
    let Some(data) = std::env::args_os().nth(1) else {
        eprintln!("usage: fidelity DATA");
        return std::process::ExitCode::from(2);
    };
    match table(Path::new(&data)) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("fidelity: {error}");
            std::process::ExitCode::FAILURE
        }
    }
}

fn table(data: &Path) -> Result<()> {
    let ideal_options = BuildOptions::default();
    let projected_options = BuildOptions { azimuth: Azimuth::Projected, ..ideal_options.clone() };
    let camera_options = BuildOptions { horizontal_fov: Some(22f64.to_radians()), ..ideal_options.clone() };
    let ideal = built(&data.join("ball-ideal/frames"), &ideal_options)?;
    let projected = built(&data.join("ball-ideal/frames"), &projected_options)?;
    let camera = built(&data.join("ball-camera/frames"), &camera_options)?;

    println!("| picture | table | PSNR, dB | bar |\n|---|---|---|---|");
    let row = |scene: &str, view: &str, table: (&str, &Arc<Amc>), look: Look, bar: &str| -> Result<()> {
        let psnr = psnr(data, scene, view, table.1, look)?;
        println!("| {scene}{} | {} | {psnr:.1} | {bar} |", look.words(), table.0);
        Ok(())
    };
    let plain = Look::default();
    row("torus", "orthographic", ("ball-ideal, transported", &ideal), plain, ">= 46")?;
    row("sheet", "orthographic", ("ball-ideal, transported", &ideal), plain, ">= 50")?;
    row("torus", "orthographic", ("ball-ideal, projected", &projected), plain, ">= 43")?;
    row("sheet", "orthographic", ("ball-ideal, projected", &projected), plain, "")?;
    for (perspective, bar) in [
        (Perspective::Off, ""),
        (Perspective::Paper, ""),
        (Perspective::Full, ""),
        (Perspective::Half, ">= 32, above the others"),
    ] {
        row("torus-fov45", "fov45", ("ball-ideal, transported", &ideal), Look { perspective, ..plain }, bar)?;
    }
    row("torus", "orthographic", ("ball-camera, fov 22", &camera), plain, ">= 36")?;
    row("sheet", "orthographic", ("ball-camera, fov 22", &camera), plain, ">= 44")?;
    for scene in ["torus", "sheet"] {
        row(
            scene,
            "orthographic",
            ("ball-ideal, transported", &ideal),
            Look { isotropic: true, ..plain },
            "far below",
        )?;
        row(
            scene,
            "orthographic",
            ("ball-ideal, transported", &ideal),
            Look { angle_degrees: 90.0, ..plain },
            "far below",
        )?;
    }
    Ok(())
}

fn built(pictures: &Path, options: &BuildOptions) -> Result<Arc<Amc>> {
    let built = capture::build(pictures, options, &Progress::none())?;
    let report = &built.report;
    eprintln!("{}: symmetry {}, ball {:?}", pictures.display(), report.symmetry.order(), report.ball);
    Ok(Arc::new(built.amc))
}

/// What departs from the plain look.
#[derive(Debug, Clone, Copy)]
struct Look {
    perspective: Perspective,
    isotropic: bool,
    angle_degrees: f32,
}

impl Default for Look {
    fn default() -> Self {
        Self { perspective: Perspective::Half, isotropic: false, angle_degrees: 0.0 }
    }
}

impl Look {
    fn words(self) -> String {
        match self {
            Self { isotropic: true, .. } => ", isotropic MatCap".to_owned(),
            Self { angle_degrees, .. } if angle_degrees != 0.0 => {
                format!(", turned by {angle_degrees} degrees")
            }
            Self { perspective: Perspective::Half, .. } => String::new(),
            Self { perspective, .. } => format!(", perspective {perspective:?}").to_lowercase(),
        }
    }
}

/// PSNR of our picture of the scene against the path tracer's, in dB.
fn psnr(data: &Path, scene: &str, view: &str, table: &Arc<Amc>, look: Look) -> Result<f64> {
    let scenes = data.join("scenes");
    let mesh_name = scene.split('-').next().unwrap_or(scene);
    let garment = Garment::new(mesh::read(&scenes.join(format!("{mesh_name}.obj")), Unit::Metre)?)?;
    let direction = Direction { source: Source::Yarn, angle: look.angle_degrees.to_radians() };
    let tangents = direction::tangents(&garment, &vec![direction; garment.panels.len()])?;
    let drawing = Drawing::new(&garment, tangents.vectors, None, vec![table.clone()], |_| Cloth::Fabric(0))?;
    let truth = decode::read(&scenes.join(format!("{scene}.png")))?;
    let camera = Camera::read(&scenes.join(format!("{view}.camera.json")))?;
    let view = View::with_camera(
        &camera,
        Orientation::default(),
        &garment.positions,
        truth.width(),
        truth.height(),
    )?;
    let shading = Shading {
        mode: if look.isotropic { Mode::Isotropic } else { Mode::Amc },
        perspective: look.perspective,
        occlusion: false,
        ..Shading::default()
    };
    let ours = cpu::render(&drawing, &view, &shading, &Progress::none())?;
    psnr_srgb(&ours, &truth)
}
