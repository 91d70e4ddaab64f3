//! AMC Studio as a library: the command line now, the window that hosts the plugins next.

pub mod command_line;
mod scene;
mod storage;
pub mod viewport;
