//! Running a scenario: from its parts to a report.

mod build;
mod error;
mod guard;
mod memory;
mod progress;
mod report;
mod run;
mod stage;
mod turn;

pub(crate) use build::check;
pub use build::{Limits, Simulation};
pub use error::RunError;
pub use progress::{Progress, ProgressHook};
pub use report::{Report, StageReport};
