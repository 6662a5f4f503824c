//! Bends of a field along the lines of a grid.

use landform_analysis as analysis;
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, heights, refusal};

/// Creases of a field on the lines of a grid, which multi-level synthesis leaves (figures 2.5 and
/// 2.8 of the thesis): the largest second difference across a line, in the unit of the field, and
/// the root mean square of those across lines over that of the others, 1 without creases. Nothing
/// for a plane.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Creases {
    /// Name of the field.
    pub field: String,
    /// Distance of the lines, the first one the western and northern border.
    #[schemars(range(min = 2, max = 1_000_000), extend("x-unit" = "nodes"))]
    pub cell_nodes: usize,
}

impl Default for Creases {
    fn default() -> Self {
        Self { field: "surface".to_owned(), cell_nodes: 16 }
    }
}

impl Metric for Creases {
    type Memory = ();
    const NAME: &'static str = "Creases";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = heights(snapshot, &self.field)?;
        let found = analysis::Creases::new(snapshot.lattice(), &heights, self.cell_nodes)
            .map_err(|error| refusal(&error))?;
        Ok(columns([
            ("crease_largest", found.map(|creases| creases.largest)),
            ("crease_ratio", found.map(|creases| creases.ratio)),
        ]))
    }
}
