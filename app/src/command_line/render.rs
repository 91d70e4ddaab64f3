//! `amc-studio render`: pictures of a garment in its fabrics.

mod choices;
mod show;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::image::decode;
use amc_core::image::stream::Timing;
use amc_core::mesh::{Garment, Unit};
use amc_core::render::{Bounds, Camera, Mode, Orientation, Shading};
use amc_core::{Progress, Result};
use studio_plugin::ShadingChoice;
use studio_plugin::document::{Angles, ViewSettings};

use self::choices::{CyclicChoice, PerspectiveChoice, Switch, ViewChoice};
use self::show::ShowChoice;
use super::output::Output;
use super::progress::with_progress;
use super::renderer::RendererChoice;
use super::values::{Background, PictureSize, finite, unit};
use super::{Failure, Outcome};
use crate::pictures::{Device, Kind, Order, Painter, Size, Stand};
use crate::scene::{
    Fabrics, PanelOption, Scene, drawing, hidden_panels, load_prints, open_scene, panel_looks, worn_prints,
};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A project (.amcproj), a mesh (.obj, .glb, .gltf), garment:NAME or shape:NAME.
    scene: PathBuf,
    /// The picture: .png (sRGB, straight alpha) or .exr (linear, premultiplied); a turn: .gif or .png (animated).
    #[arg(short, long)]
    output: PathBuf,
    /// The fabric of every panel: a file, or fabric:NAME for a bundled one [default: the project's own,
    /// else fabric:satin].
    #[arg(long)]
    amc: Option<PathBuf>,
    /// The colourway of a project, by its name [default: the one that is worn].
    #[arg(long, value_name = "NAME")]
    colourway: Option<String>,
    /// ID|all[,amc=FILE|fabric:NAME][,angle=DEGREES][,source=NAME]; repeatable, later ones win. The angle counts from +u
    /// of the flat pattern [default: the project's, else the panel's grain, else 0]. Sources: gradient, yarn, around-x|y|z, along-x|y|z, radial.
    #[arg(long)]
    panel: Vec<PanelOption>,
    /// amc, isotropic, matcap=PNG, normals, tangents, uv [default: the project's, else amc].
    #[arg(long)]
    shading: Option<String>,
    /// In place of fabrics: arrows, streamlines, lic, weave[=TIMES LARGER], checker, stretch-warp, stretch-weft, shear or gradient-yarn,
    /// as the window shows them over the cloth.
    #[arg(long, conflicts_with = "shading")]
    show: Option<ShowChoice>,
    /// The size in pixels of the picture, of each view or of each frame.
    #[arg(long, default_value = "1024x1024")]
    size: PictureSize,
    /// Samples per pixel.
    #[arg(long, default_value = "4", value_parser = ["1", "4"])]
    samples: String,
    /// Turn about the vertical axis, degrees [default: the project's, else 0].
    #[arg(long, value_parser = finite, allow_negative_numbers = true)]
    yaw: Option<f32>,
    /// Turn about the horizontal axis, degrees [default: the project's, else 0].
    #[arg(long, value_parser = finite, allow_negative_numbers = true)]
    pitch: Option<f32>,
    /// Turn about the line of sight, degrees [default: the project's, else 0].
    #[arg(long, value_parser = finite, allow_negative_numbers = true)]
    roll: Option<f32>,
    /// An exact camera, in place of the fitted one.
    #[arg(long)]
    camera: Option<PathBuf>,
    /// How the azimuth gets from vertices to fragments [default: the project's, else cyclic].
    #[arg(long, value_enum)]
    cyclic: Option<CyclicChoice>,
    /// How normals and tangents are turned for perspective [default: the project's, else half].
    #[arg(long, value_enum)]
    perspective: Option<PerspectiveChoice>,
    /// Whether ambient occlusion darkens the folds [default: the project's, else on].
    #[arg(long, value_enum)]
    occlusion: Option<Switch>,
    /// RRGGBB, or none: transparent [default: the project's, else none].
    #[arg(long)]
    background: Option<Background>,
    /// A contact sheet of these views, fitted, in equal cells: front, right, back, left, top, bottom.
    #[arg(long, value_enum, value_delimiter = ',', conflicts_with_all = ["turn_frames", "yaw", "pitch", "roll"])]
    views: Vec<ViewChoice>,
    /// One whole turn about the garment's vertical axis in so many frames, beginning with the view.
    #[arg(long, value_name = "FRAMES")]
    turn_frames: Option<u32>,
    /// Frames of a turn shown in a second, 1 to 50.
    #[arg(long, default_value_t = 24, requires = "turn_frames")]
    fps: u16,
    /// gpu, or cpu: the reference.
    #[arg(long, value_enum, default_value_t)]
    renderer: RendererChoice,
    /// What the mesh's numbers mean: m, dm, cm or mm.
    #[arg(long, default_value = "m", value_parser = unit)]
    unit: Unit,
}

/// What is said about a picture that was made.
#[derive(Debug, serde::Serialize)]
struct Rendered<'a> {
    picture: &'a Path,
    width: u32,
    height: u32,
    /// How many are on the sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    views: Option<usize>,
    /// How many are in the turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Option<u32>,
    renderer: String,
    triangles: usize,
    panels: usize,
    notices: &'a [String],
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    let kind = arguments.kind();
    Order::check_file(&kind, &arguments.output).map_err(|error| Failure::Usage(error.to_string()))?;
    let mode = mode(arguments)?;
    let (scene, device) = with_progress(|progress| {
        let mut scene = open_scene(&arguments.scene, arguments.unit, progress)?;
        if let Some(name) = &arguments.colourway {
            scene.wear(name)?;
        }
        for notice in &scene.notices {
            output.notice(notice);
        }
        if let Some(project) = &scene.project {
            left_out(&project.view, mode.is_some()).iter().for_each(|notice| output.notice(notice));
        }
        let settings = arguments.settings(scene.project.as_ref().map(|project| &project.view));
        let order = Order {
            kind: kind.clone(),
            stand: arguments.stand(&scene.garment, &settings)?,
            size: Size { width: arguments.size.width, height: arguments.size.height },
            shading: arguments.shading(&settings, mode),
            file: arguments.output.clone(),
        };
        let device = arguments.renderer.device()?;
        order.carry_out(&mut painter(arguments, &scene, &device, &order.shading, progress)?, progress)?;
        Ok((scene, device))
    })?;
    let PictureSize { width, height } = arguments.size;
    let rendered = Rendered {
        picture: &arguments.output,
        width,
        height,
        views: (!arguments.views.is_empty()).then_some(arguments.views.len()),
        frames: arguments.turn_frames,
        renderer: device.name(),
        triangles: scene.garment.triangles.len(),
        panels: scene.garment.panels.len(),
        notices: &scene.notices,
    };
    output.result(&rendered, || {
        let views = rendered.views.map_or_else(String::new, |views| format!("{views} views of "));
        let frames = rendered.frames.map_or_else(String::new, |frames| format!("{frames} frames of "));
        format!("{} ({views}{frames}{width} x {height}, {})", rendered.picture.display(), rendered.renderer)
    })?;
    Ok(())
}

/// The garment in its looks, ready to be drawn.
fn painter(
    arguments: &Arguments,
    Scene { garment, project, .. }: &Scene,
    device: &Device,
    shading: &Shading,
    progress: &Progress<'_>,
) -> Result<Painter> {
    let mut fabrics = Fabrics::default();
    let starting = (project.as_ref(), arguments.amc.as_deref());
    let looks = panel_looks(garment, starting, &arguments.panel, Some(&mut fabrics), progress)?;
    let prints = match project {
        Some(project) => {
            let worn = (project, project.colourways.worn().id);
            worn_prints(worn, garment, &load_prints(project, garment)?)
        }
        None => Vec::new(),
    };
    let drawing =
        drawing((garment, project.as_ref()), (&looks, &prints), fabrics, shading.occlusion, progress)?;
    let drawing = match arguments.show {
        Some(show) => show.over((garment, project.as_ref()), &looks, &drawing, progress)?,
        None => drawing,
    };
    let hidden = project.as_ref().map(|project| hidden_panels(project, garment)).unwrap_or_default();
    Painter::new(device.clone(), drawing, &hidden)
}

/// What of a project's view a picture does not show.
fn left_out(view: &ViewSettings, has_mode: bool) -> Vec<String> {
    let mut notices = Vec::new();
    if !has_mode && ShadingChoice::BUILT_IN.iter().all(|choice| choice.id != view.mode) {
        notices.push(format!("the shading mode '{}' is a plugin's: cloth is drawn in its place", view.mode));
    }
    if view.compared.is_some() {
        notices.push("the project's view is split: what is left of the divider is drawn".to_owned());
    }
    notices
}

/// The mode that is asked for; none: the project's.
fn mode(arguments: &Arguments) -> Result<Option<Mode>, Failure> {
    let Some(named) = &arguments.shading else { return Ok(None) };
    Ok(Some(match named.as_str() {
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
    }))
}

impl Arguments {
    fn kind(&self) -> Kind {
        match self.turn_frames {
            Some(frames) => Kind::Turn(Timing { frames, per_second: self.fps }),
            None if self.views.is_empty() => Kind::Still,
            None => Kind::Views(self.views.iter().map(|&view| view.into()).collect()),
        }
    }

    /// How it is looked at: as the project says, but for what was asked for.
    fn settings(&self, project: Option<&ViewSettings>) -> ViewSettings {
        let mut settings = project.cloned().unwrap_or_default();
        if self.yaw.or(self.pitch).or(self.roll).is_some() {
            let Angles { yaw, pitch, roll } = settings.angles();
            settings.set_angles(Angles {
                yaw: self.yaw.map_or(yaw, f64::from),
                pitch: self.pitch.map_or(pitch, f64::from),
                roll: self.roll.map_or(roll, f64::from),
            });
        }
        if let Some(cyclic) = self.cyclic {
            settings.cyclic = cyclic.into();
        }
        if let Some(perspective) = self.perspective {
            settings.perspective = perspective.into();
        }
        if let Some(occlusion) = self.occlusion {
            settings.occlusion = occlusion == Switch::On;
        }
        settings
    }

    fn stand(&self, garment: &Garment, settings: &ViewSettings) -> Result<Stand> {
        let Some(file) = &self.camera else {
            let bounds = Bounds::of(&garment.positions)?;
            return Ok(Stand::Settings { settings: Box::new(settings.clone()), bounds });
        };
        let radians = |degrees: Option<f32>| degrees.unwrap_or(0.0).to_radians();
        let orientation =
            Orientation { yaw: radians(self.yaw), pitch: radians(self.pitch), roll: radians(self.roll) };
        let positions = Arc::new(garment.positions.clone());
        Ok(Stand::Camera { camera: Camera::read(file)?, orientation, positions })
    }

    fn shading(&self, settings: &ViewSettings, mode: Option<Mode>) -> Shading {
        let shading = settings.shading();
        // A mode of a plugin's own is cloth here.
        let own = ShadingChoice::BUILT_IN.into_iter().find(|choice| choice.id == settings.mode);
        Shading {
            mode: mode.or(own.map(|choice| choice.mode)).unwrap_or(shading.mode),
            samples: if self.samples == "1" { 1 } else { 4 },
            background: self.background.map_or(shading.background, |background| background.0),
            ..shading
        }
    }
}
