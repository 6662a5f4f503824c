//! Avalanches of sandpiles and of the relaxed models.

use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::measured;
use crate::plugin::AvalancheRecord;
use crate::sandpile::exact::mean_avalanche_size;

/// Events of the latest iteration (slips, blocks, topplings) and, for `Sandpile`, the mean size of
/// the avalanches so far beside its exact value for a square pile (Dhar 1990).
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
        let lattice = snapshot.lattice();
        let recorded = record.sizes.count() > 0;
        let square = recorded && lattice.width() == lattice.height();
        Ok(measured([
            ("avalanche_events", Some(record.events as f64)),
            ("mean_avalanche", recorded.then(|| record.sizes.mean())),
            ("largest_avalanche", recorded.then(|| record.sizes.largest() as f64)),
            ("mean_avalanche_exact", square.then(|| mean_avalanche_size(lattice.width()))),
        ]))
    }
}
