//! Wet ground and lakes.

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::fill_depressions;
use landform_graph::{BreadthFirst, Lattice, Reach};
use landform_sim::field::{Bed, Water, stored_values};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, named};

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
        let lakes = self.lakes(lattice, bed, water);
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

impl StandingWater {
    /// The nodes of each lake.
    fn lakes(
        &self,
        lattice: &Lattice,
        bed: &[f64],
        water: &[f64],
    ) -> Result<Vec<Vec<usize>>, GridError> {
        let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2])?;
        let filled = fill_depressions(&grid, bed)?;
        let stands = |node: usize| water[node] > self.least_depth_m && filled[node] > bed[node];
        let mut lakes = patches(lattice, stands);
        lakes.retain(|lake| lake.len() >= self.least_nodes as usize);
        Ok(lakes)
    }
}

/// The connected patches of the nodes that are `inside`.
fn patches(lattice: &Lattice, inside: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let mut seen = vec![false; lattice.node_count()];
    let mut search = BreadthFirst::new();
    let mut patches = Vec::new();
    for node in (0..lattice.node_count()).filter(|&node| inside(node)) {
        if !seen[node] {
            let within = |_, edge: &landform_graph::Edge| inside(edge.node);
            let visits = search.collect(lattice, &[node], Reach::UNLIMITED, within);
            visits.iter().for_each(|visit| seen[visit.node] = true);
            patches.push(visits.iter().map(|visit| visit.node).collect());
        }
    }
    patches
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn patches_hang_together_over_diagonals_with_eight_neighbours_only() {
        let inside = [true, false, false, false, true, false, false, false, false];
        let found = |connectivity| {
            let lattice = Lattice::plane([3, 3], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            patches(&lattice, |node| inside[node])
        };
        assert_eq!(found(Connectivity::Eight), [vec![0, 4]]);
        assert_eq!(found(Connectivity::Four), [vec![0], vec![4]]);
    }

    #[test]
    fn lakes_are_depressions_with_water_and_drained_when_they_are_gone() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([5, 5], 1.0, Connectivity::Eight, open).unwrap();
        let bed: Vec<f64> = (0..25).map(|node| if node == 12 { 0.0 } else { 2.0 }).collect();
        let metric = StandingWater { least_nodes: 1, ..Default::default() };
        // Water on the rim is no lake.
        let lakes = |depth| metric.lakes(&lattice, &bed, &[depth; 25]).unwrap();
        assert_eq!((lakes(0.5), lakes(0.05)), (vec![vec![12]], vec![]));
        let mut memory = Lakes::default();
        for (depth, drained) in [(0.5, 0), (0.5, 0), (0.0, 1), (0.0, 1)] {
            memory.follow(lakes(depth), 25);
            assert_eq!(memory.drained, drained);
        }
    }
}
