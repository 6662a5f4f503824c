//! Captures of tributaries.

use landform_analysis::grid::Grid;
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, named};
use crate::captures::CaptureRecord;

/// Rivers that take the tributaries of others: `captures`, how many were found so far from one
/// measurement to the next, and `rivers`, how many there are. A river is all that drains through
/// one mouth at the border, over depressions filled to their brims; the output `CaptureTable`
/// lists the captures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TributaryCaptures {
    /// Name of the field of heights.
    pub field: String,
    /// Nodes that drain through the beginning of a river.
    #[schemars(range(min = 1))]
    pub channel_nodes: u32,
}

impl Default for TributaryCaptures {
    fn default() -> Self {
        Self { field: "bed".to_owned(), channel_nodes: 100 }
    }
}

impl Metric for TributaryCaptures {
    type Memory = CaptureRecord;
    const NAME: &'static str = "TributaryCaptures";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(
        &self,
        record: &mut CaptureRecord,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let lattice = snapshot.lattice();
        let unknown = |message: String| Problem::new("field", message, "a field of the run");
        let bed = snapshot.field(&self.field).map_err(|error| unknown(error.to_string()))?;
        let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2]);
        let survey = grid
            .and_then(|grid| record.survey(&grid, &bed, self.channel_nodes, snapshot.clock().tick));
        survey.map_err(|error| Problem::new("", error.to_string(), ""))?;
        Ok(named([
            ("captures", Some(record.captures.len() as f64)),
            ("rivers", Some(record.present_rivers() as f64)),
        ]))
    }
}
