//! What to measure on a coast.

use landform_sim::field::stored_values;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Land;
use super::erosion::{CoastRecord, CoastState};
use super::groups::land_nodes;
use crate::coast::{Coast, Front, Shore, islands, spacings};

/// What the sea does: `coast_events`, the nodes that fell in the latest iteration (none yet at the
/// beginning), which is 0 when the coast rests; `land_left_percent` of the first land; `shore_m`
/// and `shore_ratio`, its length and that beside the first one; `mean_force` of the sea at the
/// coast.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CoastActivity {}

impl Metric for CoastActivity {
    type Memory = ();
    const NAME: &'static str = "CoastActivity";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let world = snapshot.world();
        let Some(record) = world.get_resource::<CoastRecord>() else { return Ok(Vec::new()) };
        let land = stored_values::<Land>(world);
        let left = land_nodes(land) as f64;
        // The coast of an earlier stage knows nothing of what happened since.
        let coast = world.get_resource::<CoastState>().map(|state| &state.0);
        let coast = coast.filter(|_| record.stage == snapshot.clock().stage);
        let shore = coast.map_or_else(
            || Shore::new(snapshot.lattice(), land).total(),
            |coast| coast.shore().total(),
        );
        let events = coast.and(record.events).map(|events| events as f64);
        let values = [
            ("coast_events", events),
            ("land_left_percent", Some(100.0 * left / record.initial_land.max(1) as f64)),
            ("shore_m", Some(spacings(shore) * snapshot.lattice().spacing())),
            ("shore_ratio", Some(shore as f64 / record.initial_shore.max(1) as f64)),
            ("mean_force", coast.and_then(|coast| mean_force(coast, record.initial_shore))),
        ];
        let measured = values.into_iter().filter_map(|(name, value)| Some((name, value?)));
        Ok(measured.map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// Mean of the force of the sea over the coast, summed in node order.
fn mean_force(coast: &Coast, initial_shore: u64) -> Option<f64> {
    let nodes = coast.nodes();
    let sum: f64 = nodes.iter().map(|&node| coast.force(node, initial_shore)).sum();
    (!nodes.is_empty()).then(|| sum / nodes.len() as f64)
}

/// The islands: `islands`, how many pieces of land there are; `large_islands`, how many of
/// them have more shore than `least_shore_m`, and `large_islands_shore_m`, how much; of the
/// largest by area, `main_island_percent` of all land, `main_island_shore_m` and
/// `main_island_folding`, its shore by the square root of its area (4 for a square).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Islands {
    /// Shore above which an island is large.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m", "x-source" = "thesis 4.2.1: 24 grid units"))]
    pub least_shore_m: f64,
}

impl Default for Islands {
    fn default() -> Self {
        Self { least_shore_m: 240.0 }
    }
}

impl Metric for Islands {
    type Memory = ();
    const NAME: &'static str = "Islands";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let land = stored_values::<Land>(snapshot.world());
        let lattice = snapshot.lattice();
        let islands = islands(lattice, land);
        let length_m = |shore: u64| spacings(shore) * lattice.spacing();
        let is_large = |shore: &u64| length_m(*shore) > self.least_shore_m;
        let large: Vec<u64> = islands.iter().map(|island| island.shore).filter(is_large).collect();
        let mut values = vec![
            ("islands", islands.len() as f64),
            ("large_islands", large.len() as f64),
            ("large_islands_shore_m", length_m(large.iter().sum())),
        ];
        if let Some(main) = islands.iter().max_by_key(|island| island.nodes.len()) {
            let all: usize = islands.iter().map(|island| island.nodes.len()).sum();
            let area = main.nodes.len() as f64;
            values.push(("main_island_percent", 100.0 * area / all as f64));
            values.push(("main_island_shore_m", length_m(main.shore)));
            values.push(("main_island_folding", spacings(main.shore) / area.sqrt()));
        }
        Ok(values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// The front of a sea that comes from the south, by the shore of the largest piece of land: `front_reach_m`,
/// its mean distance from the southernmost nodes; `front_beyond_share`, the share of the map that lies
/// beyond; `front_width_m`, the standard deviation of the distance; `front_shore_m`, its length, and
/// `front_accessible_m`, that of the shore which the sea still reaches when it stays a node away from
/// land (gradient percolation: Sapoval, Rosso and Gouyet 1985).
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CoastFront {}

impl Metric for CoastFront {
    type Memory = ();
    const NAME: &'static str = "CoastFront";

    fn fields(&self) -> Vec<String> {
        vec!["land".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let (lattice, land) = (snapshot.lattice(), stored_values::<Land>(snapshot.world()));
        let Some(front) = Front::new(lattice, land) else { return Ok(Vec::new()) };
        let spacing = lattice.spacing();
        let values = [
            ("front_reach_m", front.reach * spacing),
            ("front_beyond_share", 1.0 - front.reach / lattice.height() as f64),
            ("front_width_m", front.width * spacing),
            ("front_shore_m", front.shore * spacing),
            ("front_accessible_m", front.accessible_shore * spacing),
        ];
        Ok(values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}
