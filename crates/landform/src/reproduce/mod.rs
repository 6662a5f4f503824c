//! Numbers of the thesis, or of another paper, beside ours: what to run, what to compare, and the
//! verdict.
//!
//! A target file (`scenarios/thesis/NAME.targets.ron`, `scenarios/dendry/NAME.targets.ron`) names scenarios, the metrics to take from
//! them over several seeds, the thesis' values and the bands that count as reproduced. Figures of
//! real ground name files of elevations, which lie in a folder that the user names.

mod check;
mod data;
mod measure;
mod sheet;
mod targets;

pub use check::check;
pub use measure::{FigureReport, Places, TargetReport, Verdict, measure};
pub use targets::{AnalysisEntry, Average, Band, Figure, Over, Quantity, RunEntry, Source, Target};
