//! `amc-studio render`: a picture of a garment in its fabrics.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::Error;
use amc_core::image::{Picture, decode, encode};
use amc_core::mesh::Unit;
use amc_core::render::{Camera, Cyclic, Mode, Orientation, Perspective, Shading, View};
use clap::ValueEnum;

use super::output::Output;
use super::progress::with_progress;
use super::renderer::{RendererChoice, draw};
use super::values::{Background, PictureSize, finite, unit};
use super::{Failure, Outcome};
use crate::scene::{Fabrics, PanelOption, drawing, load_garment, panel_looks};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A mesh (.obj, .glb, .gltf), garment:NAME or shape:NAME.
    scene: PathBuf,
    /// The picture: .png (sRGB, straight alpha) or .exr (linear, premultiplied).
    #[arg(short, long)]
    output: PathBuf,
    /// The fabric of every panel: a file, or fabric:NAME for a bundled one [default: fabric:satin].
    #[arg(long)]
    amc: Option<PathBuf>,
    /// ID|all[,amc=FILE|fabric:NAME][,angle=DEGREES][,source=NAME]; repeatable, later ones win. The angle counts from +u
    /// of the flat pattern [default: the panel's grain, else 0]. Sources: gradient, yarn, around-x|y|z, along-x|y|z, radial.
    #[arg(long)]
    panel: Vec<PanelOption>,
    /// amc, isotropic, matcap=PNG, normals, tangents, uv.
    #[arg(long, default_value = "amc")]
    shading: String,
    /// The picture's size in pixels.
    #[arg(long, default_value = "1024x1024")]
    size: PictureSize,
    /// Samples per pixel.
    #[arg(long, default_value = "4", value_parser = ["1", "4"])]
    samples: String,
    /// Turn about the vertical axis, degrees.
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    yaw: f32,
    /// Turn about the horizontal axis, degrees.
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    pitch: f32,
    /// Turn about the line of sight, degrees.
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    roll: f32,
    /// An exact camera, in place of the fitted one.
    #[arg(long)]
    camera: Option<PathBuf>,
    /// How the azimuth gets from vertices to fragments.
    #[arg(long, value_enum, default_value = "cyclic")]
    cyclic: CyclicChoice,
    /// How normals and tangents are turned for perspective.
    #[arg(long, value_enum, default_value = "half")]
    perspective: PerspectiveChoice,
    /// Whether ambient occlusion darkens the folds.
    #[arg(long, value_enum, default_value = "on")]
    occlusion: Switch,
    /// RRGGBB, or none: transparent.
    #[arg(long, default_value = "none")]
    background: Background,
    /// gpu, or cpu: the reference.
    #[arg(long, value_enum, default_value_t)]
    renderer: RendererChoice,
    /// What the mesh's numbers mean: m, dm, cm or mm.
    #[arg(long, default_value = "m", value_parser = unit)]
    unit: Unit,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum CyclicChoice {
    Naive,
    Cyclic,
    Fragment,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PerspectiveChoice {
    Off,
    Paper,
    Full,
    Half,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Switch {
    On,
    Off,
}

/// What is said about a picture that was made.
#[derive(Debug, serde::Serialize)]
struct Rendered<'a> {
    picture: &'a Path,
    width: u32,
    height: u32,
    renderer: String,
    triangles: usize,
    panels: usize,
    notices: &'a [String],
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    refuse_projects(&arguments.scene)?;
    let format = PictureFormat::of(&arguments.output)?;
    let shading = shading(arguments)?;
    let garment = load_garment(&arguments.scene, arguments.unit)?;
    for notice in &garment.notices {
        output.notice(notice);
    }
    let orientation = Orientation {
        yaw: arguments.yaw.to_radians(),
        pitch: arguments.pitch.to_radians(),
        roll: arguments.roll.to_radians(),
    };
    let PictureSize { width, height } = arguments.size;
    let view = match &arguments.camera {
        Some(file) => {
            View::with_camera(&Camera::read(file)?, orientation, &garment.positions, width, height)?
        }
        None => View::fitted(&garment.positions, orientation, width, height)?,
    };
    let (picture, renderer) = with_progress(|progress| {
        let mut fabrics = Fabrics::default();
        let looks =
            panel_looks(&garment, arguments.amc.as_deref(), &arguments.panel, Some(&mut fabrics), progress)?;
        let drawing = drawing(&garment, &looks, fabrics, shading.occlusion, progress)?;
        draw(arguments.renderer, &drawing, &view, &shading, progress)
    })?;
    format.save(&picture, &arguments.output)?;
    let rendered = Rendered {
        picture: &arguments.output,
        width,
        height,
        renderer,
        triangles: garment.triangles.len(),
        panels: garment.panels.len(),
        notices: &garment.notices,
    };
    output.result(&rendered, || {
        format!("{} ({width} x {height}, {})", rendered.picture.display(), rendered.renderer)
    })?;
    Ok(())
}

fn shading(arguments: &Arguments) -> Result<Shading, Failure> {
    let mode = match arguments.shading.as_str() {
        "amc" => Mode::Amc,
        "isotropic" => Mode::Isotropic,
        "normals" => Mode::Normals,
        "tangents" => Mode::Tangents,
        "uv" => Mode::Uv,
        "lines" => return Err(Failure::NotAvailable("the shading 'lines'".to_owned())),
        other => match other.strip_prefix("matcap=") {
            Some(file) => Mode::MatCap(Arc::new(decode::read(Path::new(file))?)),
            None => {
                return Err(Failure::Usage(format!(
                    "the shading '{other}' is none of amc, isotropic, matcap=PNG, normals, tangents, uv"
                )));
            }
        },
    };
    Ok(Shading {
        mode,
        cyclic: match arguments.cyclic {
            CyclicChoice::Naive => Cyclic::Naive,
            CyclicChoice::Cyclic => Cyclic::Cyclic,
            CyclicChoice::Fragment => Cyclic::Fragment,
        },
        perspective: match arguments.perspective {
            PerspectiveChoice::Off => Perspective::Off,
            PerspectiveChoice::Paper => Perspective::Paper,
            PerspectiveChoice::Full => Perspective::Full,
            PerspectiveChoice::Half => Perspective::Half,
        },
        occlusion: arguments.occlusion == Switch::On,
        samples: if arguments.samples == "1" { 1 } else { 4 },
        background: arguments.background.0,
    })
}

/// Projects come with the studio's window.
pub(super) fn refuse_projects(file: &Path) -> Outcome {
    if file.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("amcproj")) {
        return Err(Failure::NotAvailable("reading a project (.amcproj)".to_owned()));
    }
    Ok(())
}

/// How a picture is saved, by its suffix.
#[derive(Debug, Clone, Copy)]
pub(super) enum PictureFormat {
    Png,
    Exr,
}

impl PictureFormat {
    pub(super) fn of(file: &Path) -> Result<Self, Failure> {
        let suffix = file.extension().and_then(|suffix| suffix.to_str()).map(str::to_ascii_lowercase);
        match suffix.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            _ => {
                Err(Failure::Usage(format!("a picture is saved as .png or .exr, not as {}", file.display())))
            }
        }
    }

    pub(super) fn save(self, picture: &Picture, file: &Path) -> Result<(), Error> {
        match self {
            Self::Png => encode::write_png(picture, file, &[]),
            Self::Exr => encode::write_exr(picture, file),
        }
    }
}
