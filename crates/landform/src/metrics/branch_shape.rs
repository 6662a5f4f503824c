//! Shape of branching lines.

use landform_analysis::gyration_dimension;
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::columns;
use crate::outputs::BranchSource;

/// Shape of the branches of a dendrite, an aggregate or an L-system: the number of `branch_trees`
/// that they make; `branch_meetings`, nodes at the place of another, 0 for a forest whose branches
/// never cross at one; `branch_tortuosity`, the mean over tips of the length to the root by the
/// distance; and `branch_gyration_dimension`, by which the number of nodes grows with the radius of
/// gyration in the order of their arrival (Xu 2008; Meakin 1998). What has too few nodes for a
/// dimension has none.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BranchShape {
    /// The branches: the same parameters and `seed` as those of an initial condition make the same.
    pub of: BranchSource,
    /// The first nodes, too few to be a fractal, that the dimension leaves out.
    #[schemars(range(min = 2, max = 10_000_000), extend("x-unit" = "nodes"))]
    pub skipped: usize,
}

impl Default for BranchShape {
    fn default() -> Self {
        Self { of: BranchSource::default(), skipped: 1000 }
    }
}

impl Metric for BranchShape {
    type Memory = ();
    const NAME: &'static str = "BranchShape";

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.of.check(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let branching = self.of.branching(snapshot)?;
        let trees = branching.parents.iter().filter(|parent| parent.is_none()).count();
        let gyration = gyration_dimension(&branching.positions, self.skipped).ok();
        Ok(columns([
            ("branch_trees", Some(trees as f64)),
            ("branch_meetings", Some(meetings(&branching.positions) as f64)),
            ("branch_tortuosity", Some(branching.tortuosity())),
            ("branch_gyration_dimension", gyration.map(|found| found.dimension)),
        ]))
    }
}

/// Number of places that stand at that of another.
fn meetings(places: &[[f64; 3]]) -> usize {
    let mut sorted: Vec<[u64; 3]> =
        places.iter().map(|place| place.map(|at| (at + 0.0).to_bits())).collect();
    sorted.sort_unstable();
    sorted.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_others_are_meetings() {
        assert_eq!(meetings(&[]), 0);
        assert_eq!(meetings(&[[1.0, 2.0, 0.0], [1.0, 2.0, 1.0], [2.0, 1.0, 0.0]]), 0);
        let twice = [[1.0, -0.0, 0.0], [3.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -0.0]];
        assert_eq!(meetings(&twice), 2);
    }
}
