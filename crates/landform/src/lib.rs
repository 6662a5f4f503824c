//! Landform: agents that erode landforms.
//!
//! This crate puts the others together: it registers the built-in processes, initial
//! conditions, metrics and outputs, and is the program `landform`. A process of your own is a
//! struct of parameters that is a Bevy plugin; a program that offers it beside the built-in
//! ones is three lines:
//!
//! ```no_run
//! # use landform::prelude::*;
//! # use schemars::JsonSchema;
//! # use serde::{Deserialize, Serialize};
//! # /// A process.
//! # #[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
//! # #[serde(default)]
//! # struct Decay {}
//! # impl Plugin for Decay { fn build(&self, _app: &mut App) {} }
//! # impl Process for Decay {
//! #     const NAME: &'static str = "Decay";
//! #     fn declare(&self, _uses: &mut Declaration) {}
//! # }
//! fn main() -> std::process::ExitCode {
//!     landform::Program::new().register(|registry| { registry.process::<Decay>(); }).run()
//! }
//! ```
//!
//! The book in `docs/` has a tutorial, a page for each process and a chapter on writing one.

pub mod analyze;
pub mod explain;
pub mod inputs;
pub mod metrics;
pub mod outputs;
mod program;
mod registry;
pub mod reproduce;
mod sweep;

pub use landform_analysis as analysis;
pub use landform_caves as caves;
pub use landform_coast as coast;
pub use landform_dunes as dunes;
pub use landform_graph as graph;
pub use landform_io as io;
pub use landform_lessons as lessons;
pub use landform_rivers as rivers;
pub use landform_sim as sim;
pub use landform_sim::prelude;
pub use landform_synth as synth;
pub use landform_view as view;

pub use program::Program;
pub use registry::registry;
