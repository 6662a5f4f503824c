//! What to measure while level sets are made, and on image coasts.

use landform_sim::field::{Bed, stored_values};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{HeightsRecord, ImageCoastRecord, InteriorRecord, Land, LevelSetNumber, OnLevelSet};
use crate::interior::{LevelSets, crossings};

/// What the fronts of `IslandInterior` and the heights of `LevelSetHeights` did: `level_sets`, how
/// many were marked above the first coast; `uneroded_nodes` of land that are left, 0 at the end;
/// `pressure`, what the force is multiplied with. In the stage of the heights: `crossings`, at how
/// many nodes `bed` leaves the range between the level sets round it, 0 for a good interpolant;
/// after relaxation `bending_energy`, its sum over the nodes in square metres,
/// `bending_reduction_percent`, by how much it fell, `bending_residual`, the projected gradient
/// that is left as a share of the first one, and `bending_rounds` of the solver.
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
        let heights = world.get_resource::<HeightsRecord>();
        let heights = heights.filter(|record| record.stage == snapshot.clock().stage);
        let relaxation = heights.and_then(|record| record.relaxation);
        let left = stored_values::<Land>(world).iter().filter(|&&land| land > 0).count();
        let values = [
            ("level_sets", fronts.map(|fronts| f64::from(fronts.level))),
            ("uneroded_nodes", fronts.map(|_| left as f64)),
            ("pressure", fronts.map(|fronts| fronts.pressure)),
            ("crossings", heights.map(|record| count_crossings(record, snapshot)).transpose()?),
            ("bending_energy", relaxation.map(|relaxation| relaxation.energy_after)),
            (
                "bending_reduction_percent",
                relaxation.map(|relaxation| relaxation.reduction_percent()),
            ),
            ("bending_residual", relaxation.map(|relaxation| relaxation.residual)),
            ("bending_rounds", relaxation.map(|relaxation| relaxation.rounds as f64)),
        ];
        let measured =
            values.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
        Ok(measured.collect())
    }
}

/// At how many nodes level sets cross in the present ground.
fn count_crossings(heights: &HeightsRecord, snapshot: &Snapshot<'_>) -> Result<f64, Problem> {
    let world = snapshot.world();
    let band = stored_values::<LevelSetNumber>(world);
    let on_level = stored_values::<OnLevelSet>(world);
    let levels = LevelSets { band, on_level, interval_m: heights.interval_m };
    let count = crossings(snapshot.lattice(), &levels, heights.course, stored_values::<Bed>(world));
    count.map(|count| count as f64).map_err(|error| Problem::new("", error.to_string(), ""))
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
