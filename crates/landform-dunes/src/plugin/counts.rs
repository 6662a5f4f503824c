//! What the wind did in the latest iteration, and the metric that shows it.

use bevy_ecs::resource::Resource;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::dunes::TickCounts;

/// What the process `Dunes` did in the latest iteration.
#[derive(Resource, Clone, Debug, Default, Serialize, Deserialize)]
pub struct DuneCounts(pub TickCounts);

/// What `Dunes` did in the latest iteration: slabs lifted, hops a lift, and the size of the
/// avalanches (slabs' worth of sand slid in slides, their number and the sweeps they took).
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DuneActivity {}

impl Metric for DuneActivity {
    type Memory = ();
    const NAME: &'static str = "DuneActivity";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let Some(DuneCounts(tick)) = snapshot.world().get_resource::<DuneCounts>() else {
            return Ok(Vec::new());
        };
        let lifts = tick.transport.lifts as f64;
        let slides: u64 = tick.avalanches.iter().map(|avalanche| avalanche.slides).sum();
        let slid_m: f64 = tick.avalanches.iter().map(|avalanche| avalanche.moved_m).sum();
        let mut values = vec![
            ("slabs_lifted".to_owned(), lifts),
            ("avalanche_slides".to_owned(), slides as f64),
            ("avalanche_slid_m".to_owned(), slid_m),
        ];
        if lifts > 0.0 {
            values.push(("hops_per_lift".to_owned(), tick.transport.hops as f64 / lifts));
        }
        Ok(values)
    }
}
