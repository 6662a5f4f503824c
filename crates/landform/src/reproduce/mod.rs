//! Numbers of the thesis, or of another paper, beside ours: what to run, what to compare, and the
//! verdict.
//!
//! A target file (`scenarios/thesis/NAME.targets.ron`, `scenarios/physics/NAME.targets.ron`) names
//! scenarios, the metrics to take from them over several seeds, the thesis' values and the bands that count as reproduced. Figures of
//! real ground name files of elevations, which lie in a folder that the user names.

mod catalogue;
mod check;
mod data;
mod judge;
mod law;
mod markdown;
mod measure;
mod page;
mod plot;
mod quantity;
mod record;
mod sheet;
mod tally;
mod targets;
mod work;

pub use catalogue::{Entry, all, find};
pub use check::check;
pub use judge::{FigureReport, TargetReport, Verdict};
pub use law::Law;
pub use markdown::markdown;
pub use page::page;
pub use plot::{PlotEntry, PlotPoint, PlotSeries};
pub use quantity::{Quantity, Source};
pub use record::Record;
pub use tally::Tally;
pub use targets::{AnalysisEntry, Average, Band, Figure, Over, RunEntry, Target};
pub use work::Work;
