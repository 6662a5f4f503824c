//! Avalanches of sandpiles and of the relaxed models.

use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::measured;
use crate::plugin::AvalancheRecord;

/// Events of the latest iteration (slips, blocks, topplings, moves) and, for `Sandpile`, `RicePile` and
/// `SlidingSlabs`, the mean size of the avalanches so far and the largest, beside the exact mean: that of a
/// square `Sandpile` (Dhar 1990), the number of columns of rice, and (columns + 1) / 2 by the slabs that
/// slide together.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Avalanches {}

impl Metric for Avalanches {
    type Memory = ();
    const NAME: &'static str = "Avalanches";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let Some(record) = snapshot.world().get_resource::<AvalancheRecord>() else {
            return Ok(Vec::new());
        };
        let recorded = record.sizes.count() > 0;
        Ok(measured([
            ("avalanche_events", Some(record.events as f64)),
            ("mean_avalanche", recorded.then(|| record.sizes.mean())),
            ("largest_avalanche", recorded.then(|| record.sizes.largest() as f64)),
            ("mean_avalanche_exact", record.exact_mean.filter(|_| recorded)),
        ]))
    }
}
