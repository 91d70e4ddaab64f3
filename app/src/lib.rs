//! AMC Studio as a library: the command line, and (feature `window`) the window that hosts the plugins.

pub mod command_line;
mod pictures;
pub mod project;
mod scene;
mod storage;
#[cfg(feature = "window")]
pub mod studio;
#[cfg(feature = "window")]
pub mod viewport;
