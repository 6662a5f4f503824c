//! Sweeps: many runs of one scenario over parameters and seeds.
//!
//! A [`Sweep`] is what the file says. [`runs`] unrolls it into runs with their values and seeds,
//! [`Plan`] adds the digest of each run's scenario and is kept in the output folder, and an
//! [`Outcome`] in the folder of each run says how it ended; so a sweep goes on where it was
//! stopped. [`Results`] gathers the runs into a table, a contact sheet and plots.

mod draw;
mod file;
mod outcome;
mod plan;
mod plot;
mod prepare;
mod results;
mod sheet;
mod table;
mod unroll;

pub(crate) use file::{Sweep, SweepSource};
pub(crate) use outcome::{Outcome, Status};
pub(crate) use plan::{Plan, PlannedRun};
pub(crate) use prepare::{Prepared, prepare};
pub(crate) use results::Results;
pub(crate) use unroll::runs;

/// Ending of the names of sweep files.
pub(crate) const ENDING: &str = ".sweep.ron";
