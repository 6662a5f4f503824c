//! Wet ground and lakes.

use landform_graph::Lattice;
use landform_sim::field::{Bed, Water, stored_values};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, named};
use crate::lakes::lakes;

/// Water on the ground: `wet_percent` of the nodes with more than `least_depth_m`; `water_m3`, its
/// volume; `lakes`, the depressions that hold as much on `least_nodes` nodes and more, and
/// `lakes_percent`, their share of the area; `lakes_drained`, how many lakes of one measurement were
/// gone at the next, but for a tenth of their nodes at most. A depression is what a flood that drains
/// over the borders of the domain would fill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StandingWater {
    /// Depth above which a node is wet.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub least_depth_m: f64,
    /// Nodes of the smallest lake.
    #[schemars(range(min = 1))]
    pub least_nodes: u32,
}

impl Default for StandingWater {
    fn default() -> Self {
        Self { least_depth_m: 0.1, least_nodes: 4 }
    }
}

/// The lakes of the latest measurement, and how many drained so far.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Lakes {
    nodes: Vec<Vec<usize>>,
    drained: u64,
}

impl Lakes {
    /// Takes the lakes of the next measurement.
    fn follow(&mut self, lakes: Vec<Vec<usize>>, node_count: usize) {
        let mut in_lake = vec![false; node_count];
        lakes.iter().flatten().for_each(|&node| in_lake[node] = true);
        let left = |lake: &Vec<usize>| lake.iter().filter(|&&node| in_lake[node]).count();
        let drained = self.nodes.iter().filter(|lake| 10 * left(lake) <= lake.len()).count();
        self.drained += drained as u64;
        self.nodes = lakes;
    }
}

impl Metric for StandingWater {
    type Memory = Lakes;
    const NAME: &'static str = "StandingWater";

    fn fields(&self) -> Vec<String> {
        vec!["bed".to_owned(), "water".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(
        &self,
        memory: &mut Lakes,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let lattice = snapshot.lattice();
        let bed = stored_values::<Bed>(snapshot.world());
        let water = stored_values::<Water>(snapshot.world());
        let lakes = lakes(lattice, (bed, water), self.least_depth_m, self.least_nodes);
        let lakes = lakes.map_err(|error| Problem::new("", error.to_string(), ""))?;
        let percent = |nodes: usize| Some(100.0 * nodes as f64 / bed.len() as f64);
        let wet = water.iter().filter(|&&depth| depth > self.least_depth_m).count();
        let in_lakes = lakes.iter().map(Vec::len).sum();
        memory.follow(lakes, bed.len());
        Ok(named([
            ("wet_percent", percent(wet)),
            ("water_m3", Some(sum(water) * lattice.spacing().powi(2))),
            ("lakes", Some(memory.nodes.len() as f64)),
            ("lakes_percent", percent(in_lakes)),
            ("lakes_drained", Some(memory.drained as f64)),
        ]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lakes_are_drained_when_all_but_a_tenth_is_gone() {
        let mut memory = Lakes::default();
        let lake = |nodes: usize| vec![(0..nodes).collect::<Vec<_>>()];
        for (nodes, drained) in [(20, 0), (3, 0), (20, 0), (2, 1), (2, 1)] {
            memory.follow(lake(nodes), 25);
            assert_eq!(memory.drained, drained);
        }
    }
}
