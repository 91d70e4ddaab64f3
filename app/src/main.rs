//! The program `amc-studio`.

use std::process::ExitCode;

fn main() -> ExitCode {
    amc_studio::command_line::run(std::env::args_os())
}
