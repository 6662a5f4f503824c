//! What to measure while level sets are made, and on image coasts.

use landform_sim::field::stored_values;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ImageCoastRecord, InteriorRecord, Land, RelaxationRecord};

/// What the fronts of `IslandInterior` and the heights of `LevelSetHeights` did: `level_sets`, how
/// many were marked above the first coast; `uneroded_nodes` of land that are left, 0 at the end;
/// `pressure`, what the force is multiplied with; after relaxation `bending_energy`, its sum over
/// the nodes in square metres, and `bending_reduction_percent`, by how much it fell.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LevelSetActivity {}

impl Metric for LevelSetActivity {
    type Memory = ();
    const NAME: &'static str = "LevelSetActivity";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let world = snapshot.world();
        let fronts = world.get_resource::<InteriorRecord>().map(|record| record.0);
        let relaxation = world.get_resource::<RelaxationRecord>().and_then(|record| record.0);
        let left = stored_values::<Land>(world).iter().filter(|&&land| land > 0).count();
        let values = [
            ("level_sets", fronts.map(|fronts| f64::from(fronts.level))),
            ("uneroded_nodes", fronts.map(|_| left as f64)),
            ("pressure", fronts.map(|fronts| fronts.pressure)),
            ("bending_energy", relaxation.map(|relaxation| relaxation.energy_after)),
            (
                "bending_reduction_percent",
                relaxation.map(|relaxation| relaxation.reduction_percent()),
            ),
        ];
        let measured =
            values.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
        Ok(measured.collect())
    }
}

/// What the sea does on an image coast: `image_coast_events`, the nodes that fell in the latest
/// iteration (none yet at the beginning), which is 0 when the coast rests;
/// `image_coast_iterations`, how many iterations it took until then; `image_land_left_percent` of
/// the land when the stage began.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ImageCoastActivity {}

impl Metric for ImageCoastActivity {
    type Memory = ();
    const NAME: &'static str = "ImageCoastActivity";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let world = snapshot.world();
        let Some(record) = world.get_resource::<ImageCoastRecord>() else { return Ok(Vec::new()) };
        let Some(events) = record.events else { return Ok(Vec::new()) };
        let left = stored_values::<Land>(world).iter().filter(|&&land| land > 0).count();
        let values = [
            ("image_coast_events", events as f64),
            ("image_coast_iterations", record.iterations as f64),
            ("image_land_left_percent", 100.0 * left as f64 / record.initial_land.max(1) as f64),
        ];
        Ok(values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}
