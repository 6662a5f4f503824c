//! What a target file says.

use std::path::PathBuf;

use serde::Deserialize;

/// A figure or table of the thesis with its numbers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Name in the thesis: `table 4.1`.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// Number of seeds that medians are taken over.
    pub seeds: u64,
    /// The scenarios to run.
    pub runs: Vec<RunEntry>,
    /// The numbers.
    pub targets: Vec<Target>,
}

/// A scenario to run with every seed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunEntry {
    /// Name within the file.
    pub name: String,
    /// The scenario, relative to the target file.
    pub scenario: PathBuf,
}

/// One number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// What it is, in words.
    pub name: String,
    /// How it is taken from the runs.
    pub value: Quantity,
    /// The thesis' number.
    #[serde(default)]
    pub thesis: Option<f64>,
    /// What counts as reproduced.
    pub band: Band,
    /// What is known about a difference.
    #[serde(default)]
    pub reason: String,
}

/// How a number is taken from the runs of one seed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub enum Quantity {
    /// A metric of a run.
    Metric(Source),
    /// The metric of one run divided by that of another.
    Ratio(Source, Source),
}

/// A metric of a run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Name of the run.
    pub run: String,
    /// Name of the stage at whose end it is measured; `initial` for the state before the first
    /// iteration.
    pub stage: String,
    /// Name of the metric in the series.
    pub metric: String,
}

/// What counts as reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub enum Band {
    /// Nothing: the number is printed beside the thesis' own.
    Printed,
    /// A number from the first to the second.
    Within(f64, f64),
    /// At least this.
    AtLeast(f64),
    /// At most this.
    AtMost(f64),
}

impl Band {
    /// Whether a number lies in the band; `None` when there is no band.
    pub fn holds(self, value: f64) -> Option<bool> {
        match self {
            Self::Printed => None,
            Self::Within(low, high) => Some((low..=high).contains(&value)),
            Self::AtLeast(least) => Some(value >= least),
            Self::AtMost(most) => Some(value <= most),
        }
    }
}

impl std::fmt::Display for Band {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Printed => write!(f, "printed"),
            Self::Within(low, high) => write!(f, "{low} to {high}"),
            Self::AtLeast(least) => write!(f, "at least {least}"),
            Self::AtMost(most) => write!(f, "at most {most}"),
        }
    }
}
