//! Branches as lines.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::{Feature, Geometry};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::branch_source::BranchSource;
use super::map_place::{MapPlace, check_plane};

/// The branches of a dendrite, an aggregate or an L-system as lines, GeoJSON or comma-separated
/// values: each from where it leaves another, or from its root, to its tip.
///
/// Each line has its `branch` number, the number of the `tree`, Strahler's `order` at its
/// beginning, its `length_m`, and `radius_m` at its beginning.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BranchLines {
    /// File name below the output folder.
    pub file: PathBuf,
    /// The branches.
    pub of: BranchSource,
    /// When it is written.
    pub when: When,
}

impl Default for BranchLines {
    fn default() -> Self {
        Self { file: "branches.geojson".into(), of: BranchSource::default(), when: When::End }
    }
}

impl FileOutput for BranchLines {
    const NAME: &'static str = "BranchLines";
    const KIND: &'static str = "lines";
    const EXTENSIONS: &'static [&'static str] = &["geojson", "csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)?;
        self.of.check(lattice)
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let branching = self.of.branching(snapshot)?;
        let (place, lattice) = (MapPlace::of(snapshot), snapshot.lattice());
        let point = |node: &u32| {
            let [east, north, _] = branching.positions[*node as usize];
            let steps = [east, north].map(|metres| metres / lattice.spacing());
            place.point([steps[0], (lattice.height() - 1) as f64 - steps[1]])
        };
        let (lengths, orders, trees) =
            (branching.root_lengths(), branching.orders(), branching.trees());
        let features: Vec<Feature> = branching
            .branches()
            .iter()
            .filter(|branch| branch.len() > 1)
            .enumerate()
            .map(|(number, branch)| {
                let [first, second, last] =
                    [branch[0], branch[1], branch[branch.len() - 1]].map(|node| node as usize);
                let properties = vec![
                    ("branch", (number + 1) as f64),
                    ("tree", f64::from(trees[first] + 1)),
                    ("order", f64::from(orders[second])),
                    ("length_m", lengths[last] - lengths[first]),
                    ("radius_m", branching.radii[second]),
                ];
                Feature { geometry: Geometry::Line(branch.iter().map(point).collect()), properties }
            })
            .collect();
        place.write(path, &features)
    }
}
