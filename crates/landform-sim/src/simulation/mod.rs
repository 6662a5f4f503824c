//! Running a scenario: from its parts to a report.

mod build;
mod checkpoint;
mod error;
mod guard;
mod memory;
mod progress;
mod report;
mod run;
mod stage;
mod state;
mod turn;

#[cfg(test)]
mod tests;

pub(crate) use build::check;
pub use build::{Limits, Needs, Simulation};
pub use checkpoint::Keeper;
pub use error::RunError;
pub use progress::{Progress, ProgressHook};
pub use report::{Report, StageReport};
