//! The program `landform` with the built-in processes.

use std::process::ExitCode;

fn main() -> ExitCode {
    landform::Program::new().run()
}
