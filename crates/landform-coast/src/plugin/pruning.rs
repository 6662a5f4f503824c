//! The process `IslandPruning`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use landform_graph::Lattice;
use landform_sim::agent::Agents;
use landform_sim::field::FieldMut;
use landform_sim::ledger::Ledger;
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::groups::{
    CoastAgents, CoastMarks, Eroded, LAND_BUDGET, Land, coast_surface, node_area_m2,
};
use crate::coast::{CoastError, islands, spacings};

/// Gives small islands to the sea, in one iteration (thesis, section 4.2.1).
///
/// An island is a piece of land that the sea divides from all others; those whose shore, lakes
/// included, is at most `least_shore_m` long go. The ledger books their area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct IslandPruning {
    /// Shore above which an island stays.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m", "x-source" = "thesis 4.2.1: 24 grid units"))]
    pub least_shore_m: f64,
}

impl Default for IslandPruning {
    fn default() -> Self {
        Self { least_shore_m: 240.0 }
    }
}

impl Process for IslandPruning {
    const NAME: &'static str = "IslandPruning";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<Land>()
            .writes::<Land>()
            .group::<CoastMarks>()
            .group::<CoastAgents>()
            .group::<Eroded>()
            .derives("coast_surface", "m", "land above the sea, to look at", coast_surface)
            .conserves(LAND_BUDGET)
            .scratch(24);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let connectivity = lattice.connectivity();
        if connectivity.is_volume() {
            let message = CoastError::Volume(connectivity).to_string();
            return Err(Problem::new("", message, "a 2-D domain"));
        }
        Ok(())
    }

    fn iterations(&self) -> Option<u64> {
        Some(1)
    }
}

impl Plugin for IslandPruning {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, prune);
    }
}

/// Gives the small islands and their agents to the sea.
fn prune(
    settings: Res<Settings<IslandPruning>>,
    space: Res<Space>,
    mut ledger: ResMut<Ledger>,
    mut land: FieldMut<Land>,
    mut marks: Agents<CoastMarks>,
    mut coast: Agents<CoastAgents>,
    mut eroded: Agents<Eroded>,
) {
    let (mut marks, mut coast, mut eroded) = (marks.view(), coast.view(), eroded.view());
    let land = land.values_mut();
    let mut pruned = 0;
    for island in islands(&space, land) {
        if spacings(island.shore) * space.spacing() > settings.least_shore_m {
            continue;
        }
        // Land without any shore is no island.
        let small = island.nodes.iter().filter(|_| island.shore > 0);
        for node in small.map(|&node| node as usize) {
            land[node] = 0;
            marks.deregister(node);
            coast.deregister(node);
            eroded.register(node, ());
            pruned += 1;
        }
    }
    if pruned > 0 {
        ledger.leave("land", "islands pruned", f64::from(pruned) * node_area_m2(&space));
    }
}
