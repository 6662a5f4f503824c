//! Numbers of the thesis beside ours: what to run, what to compare, and the verdict.
//!
//! A target file (`scenarios/thesis/NAME.targets.ron`) names scenarios, the metrics to take from
//! them over several seeds, the thesis' values and the bands that count as reproduced.

mod check;
mod measure;
mod sheet;
mod targets;

pub use check::check;
pub use measure::{FigureReport, TargetReport, Verdict, measure};
pub use targets::{Band, Figure, Over, Quantity, RunEntry, Source, Target};
