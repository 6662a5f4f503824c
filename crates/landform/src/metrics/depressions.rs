//! How much of a field lies in depressions.

use landform_analysis::hydrology;
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, grid, map_heights, refusal};

/// Depressions of a field: what a flood that drains over the borders of the domain would fill.
/// Their number, share of the area, volume and greatest depth, 8 neighbours a node. The borders
/// of periodic axes drain too.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Depressions {
    /// Name of the field.
    pub field: String,
}

impl Default for Depressions {
    fn default() -> Self {
        Self { field: "surface".to_owned() }
    }
}

impl Metric for Depressions {
    type Memory = ();
    const NAME: &'static str = "Depressions";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = map_heights(snapshot, &self.field)?;
        let found = hydrology::Depressions::new(&grid(snapshot)?, &heights);
        let found = found.map_err(|error| refusal(&error))?;
        Ok(columns([
            ("depressions_count", Some(found.count as f64)),
            ("depressions_area_percent", Some(found.area_percent)),
            ("depressions_volume_m3", Some(found.volume)),
            ("depressions_deepest_m", Some(found.deepest)),
        ]))
    }
}
