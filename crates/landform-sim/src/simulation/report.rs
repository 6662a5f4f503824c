//! What a run leaves in `report.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::ledger::Ledger;
use crate::output::OutputFile;

/// Summary of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Title of the scenario.
    pub title: String,
    /// Seed of the run.
    pub seed: u64,
    /// Version of Landform.
    pub version: String,
    /// Columns, rows and layers of the lattice.
    pub size: [usize; 3],
    /// Number of nodes.
    pub nodes: usize,
    /// Distance of neighbouring nodes in metres.
    pub spacing_m: f64,
    /// Whether the run came to its end.
    pub finished: bool,
    /// Threads that the run could use.
    pub threads: usize,
    /// Seconds that the run took, without building it.
    pub seconds: f64,
    /// Metrics before the first iteration.
    pub initial_metrics: BTreeMap<String, f64>,
    /// The stages that were run.
    pub stages: Vec<StageReport>,
    /// Latest value of each metric.
    pub metrics: BTreeMap<String, f64>,
    /// What was conserved, what came and what went.
    pub ledger: Ledger,
    /// The files that outputs wrote.
    pub outputs: Vec<OutputFile>,
    /// What processes told: see [`Notes`](crate::notes::Notes).
    pub notes: Vec<String>,
    /// What a person should know.
    pub warnings: Vec<String>,
}

/// Summary of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StageReport {
    /// Name of the stage.
    pub name: String,
    /// Names of its processes.
    pub processes: Vec<String>,
    /// Iterations that were done.
    pub iterations: u64,
    /// Why it was over.
    pub stopped: String,
    /// Seconds that the processes took.
    pub seconds: f64,
    /// Metrics at the end of the stage.
    pub metrics: BTreeMap<String, f64>,
}
