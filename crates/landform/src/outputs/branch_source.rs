//! Branches that outputs write and metrics measure.

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_synth::{Aggregate, Branching, Dendrite, LSystem, SynthError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Branching lines that are made from parameters, the same as those of an initial condition with the
/// same parameters and `seed`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub enum BranchSource {
    /// A dendrite by path planning. Files of masks are relative to the folder that the program runs in.
    Dendrite(Box<Dendrite>),
    /// Diffusion-limited aggregation: a line from every particle to the one that it stuck to.
    Aggregate(Aggregate),
    /// An L-system.
    LSystem(LSystem),
}

impl Default for BranchSource {
    fn default() -> Self {
        Self::Dendrite(Box::default())
    }
}

impl BranchSource {
    /// Refuses what can be seen before a run.
    pub(crate) fn check(&self, lattice: &Lattice) -> Result<(), Problem> {
        let checked = match self {
            Self::Dendrite(dendrite) => dendrite.check(),
            Self::Aggregate(aggregate) => aggregate.check(),
            // Drawing is the only way to find out how long a string becomes.
            Self::LSystem(system) => system.branching(lattice, 0).map(|_| ()),
        };
        checked.map_err(refusal)
    }

    /// The branches on the lattice of a run.
    pub(crate) fn branching(&self, snapshot: &Snapshot<'_>) -> Result<Branching, Problem> {
        let (lattice, seed) = (snapshot.lattice(), snapshot.clock().seed);
        let made = match self {
            Self::Dendrite(dendrite) => dendrite.branching(Path::new(""), lattice, seed),
            Self::Aggregate(aggregate) => aggregate.branching(lattice, seed),
            Self::LSystem(system) => system.branching(lattice, seed),
        };
        made.map_err(refusal)
    }
}

fn refusal(error: SynthError) -> Problem {
    Problem::new("of", error.to_string(), "parameters that make branches")
}
