//! The program `landform` with two processes and a metric of our own.

mod rain;
mod scree;

use std::process::ExitCode;

fn main() -> ExitCode {
    landform::Program::new()
        .register(|registry| {
            registry.process::<scree::Scree>().metric::<scree::SteepGround>();
            registry.process::<rain::Rain>();
        })
        .run()
}
