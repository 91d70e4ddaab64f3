//! AMC Studio as a library: the command line now, the window that hosts the plugins next.

pub mod command_line;
pub mod project;
mod scene;
mod storage;
