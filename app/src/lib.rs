//! AMC Studio as a library: the command line, and the window that hosts the plugins.

pub mod command_line;
pub mod project;
mod scene;
mod storage;
pub mod studio;
pub mod viewport;
