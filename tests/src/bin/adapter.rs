//! Tells whether a graphics backend is there: `adapter vulkan` or `adapter gl`; exit 1 where it is not.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "its result is what it prints")]

use std::process::ExitCode;

use amc_core::render::gpu::{Backend, Gpu};

fn main() -> ExitCode {
    let backend = match std::env::args().nth(1).as_deref() {
        Some("vulkan") => Backend::Vulkan,
        Some("gl") => Backend::Gl,
        _ => {
            eprintln!("usage: adapter vulkan|gl");
            return ExitCode::from(2);
        }
    };
    match Gpu::headless(backend) {
        Ok(gpu) => {
            println!("{}", gpu.name());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
