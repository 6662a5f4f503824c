//! The parts of a scenario as its file writes them.

use serde::Deserialize;

use crate::initial::Combine;
use crate::registry::{AnyDomain, AnyInitial, AnyMetric, AnyOutput, AnyProcess, Chosen};
use crate::stop::Stop;

/// A run as a file describes it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// What the run shows, in a line.
    pub title: String,
    /// What to look for, in a few sentences.
    #[serde(default)]
    pub description: String,
    /// Seed of all random numbers.
    #[serde(default = "one")]
    pub seed: u64,
    /// Where the run takes place.
    pub domain: Chosen<dyn AnyDomain>,
    /// How fields are filled, in order.
    #[serde(default)]
    pub initial: Vec<InitialEntry>,
    /// The stages, in order. They share the state of the nodes. Without any, a bed is
    /// made, measured and drawn, and that is all.
    pub stages: Vec<StageEntry>,
    /// What is measured.
    #[serde(default)]
    pub metrics: Vec<Chosen<dyn AnyMetric>>,
    /// Iterations between two measurements; stages are measured when they end in any case.
    #[serde(default = "one")]
    pub measure_every: u64,
    /// What is written.
    #[serde(default)]
    pub outputs: Vec<Chosen<dyn AnyOutput>>,
}

fn one() -> u64 {
    1
}

/// How one field is filled.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InitialEntry {
    /// Name of the field.
    pub field: String,
    /// Where the values come from.
    pub from: Chosen<dyn AnyInitial>,
    /// How they meet the values of earlier entries for the same field.
    #[serde(default)]
    pub combine: Combine,
}

/// Processes that run together until a stop rule holds.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageEntry {
    /// Name in reports.
    #[serde(default)]
    pub name: String,
    /// The processes, which take turns in this order at each iteration.
    pub processes: Vec<Chosen<dyn AnyProcess>>,
    /// When the stage is over.
    #[serde(default)]
    pub stop: Stop,
}

impl StageEntry {
    /// Ends of the processes that have one.
    pub(crate) fn ends(&self) -> Vec<u64> {
        self.processes.iter().filter_map(|process| process.value.iterations()).collect()
    }
}
