//! By which of the two renderers a picture is drawn.

use amc_core::image::Picture;
use amc_core::render::{Drawing, Shading, View, cpu};
use amc_core::{Error, Progress, Result};
use clap::ValueEnum;

use crate::pictures::Device;

/// A renderer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum RendererChoice {
    Gpu,
    Cpu,
}

impl Default for RendererChoice {
    fn default() -> Self {
        if cfg!(feature = "gpu") { Self::Gpu } else { Self::Cpu }
    }
}

impl RendererChoice {
    /// What it draws with.
    ///
    /// # Errors
    /// There is no such renderer here.
    pub(super) fn device(self) -> Result<Device> {
        match self {
            Self::Cpu => Ok(Device::Cpu),
            Self::Gpu => Device::headless().map_err(|error| {
                Error::device(format!("{error}; or render with --renderer cpu")).because(error)
            }),
        }
    }
}

/// By the graphics device where there is one, else by the processor; then also why.
///
/// # Errors
/// The view or the drawing is impossible.
pub(super) fn draw_anyhow(
    drawing: &Drawing,
    view: &View,
    shading: &Shading,
    progress: &Progress<'_>,
) -> Result<(Picture, String, Option<Error>)> {
    match on_device(drawing, view, shading) {
        Ok((picture, name)) => Ok((picture, name, None)),
        Err(why) => Ok((cpu::render(drawing, view, shading, progress)?, Device::Cpu.name(), Some(why))),
    }
}

#[cfg(feature = "gpu")]
fn on_device(drawing: &Drawing, view: &View, shading: &Shading) -> Result<(Picture, String)> {
    use amc_core::render::gpu;
    let device = gpu::Gpu::headless(gpu::Backend::Auto)?;
    Ok((gpu::render_picture(&device, drawing, view, shading)?, device.name()))
}

#[cfg(not(feature = "gpu"))]
fn on_device(_: &Drawing, _: &View, _: &Shading) -> Result<(Picture, String)> {
    Err(Error::device("this program is built without a graphics interface"))
}
