//! Rivers with water of their own as processes and metrics that scenarios may name.

mod erosion;
mod fields;
mod metrics;
mod water;

pub(crate) use erosion::book;
pub use fields::{Flow, PipeFlow, Rain};
pub use metrics::{Channels, FlowDensity, Lakes, StandingWater, TributaryCaptures};
pub use water::{Source, WaterColumn};

use landform_sim::parameters::Problem;

use crate::RiverError;

/// A refusal by the kernels, at the parameter that it is about.
pub(crate) fn refusal(error: &RiverError, parameter: &str) -> Problem {
    Problem::new(parameter, error.to_string(), "")
}
