//! Metrics of water and of its channels.

use landform_analysis::grid::Grid;
use landform_analysis::hydrology::fill_depressions;
use landform_graph::{BreadthFirst, Connectivity, Lattice, Reach};
use landform_sim::field::{Bed, Water, stored_values};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::Flow;
use crate::water::{Side, border_nodes};

/// Water on the ground: `wet_percent` of the nodes with more than `least_depth_m`; `water_m3`, its
/// volume; `lakes`, the depressions that hold as much on `least_nodes` nodes and more, and
/// `lakes_percent`, their share of the area. A depression is what a flood that drains over the borders
/// of the domain would fill.
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

impl Metric for StandingWater {
    type Memory = ();
    const NAME: &'static str = "StandingWater";

    fn fields(&self) -> Vec<String> {
        vec!["bed".to_owned(), "water".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let lattice = snapshot.lattice();
        let bed = stored_values::<Bed>(snapshot.world());
        let water = stored_values::<Water>(snapshot.world());
        let refused =
            |error: landform_analysis::grid::GridError| Problem::new("", error.to_string(), "");
        let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2]);
        let filled = fill_depressions(&grid.map_err(refused)?, bed).map_err(refused)?;
        let is_wet = |node: usize| water[node] > self.least_depth_m;
        let lakes = patches(lattice, |node| is_wet(node) && filled[node] > bed[node]);
        let large = lakes.iter().filter(|&&nodes| nodes >= u64::from(self.least_nodes));
        let (count, nodes) = large.fold((0, 0), |(count, all), nodes| (count + 1, all + nodes));
        let percent = |nodes: usize| 100.0 * nodes as f64 / bed.len() as f64;
        Ok(named([
            ("wet_percent", percent((0..bed.len()).filter(|&node| is_wet(node)).count())),
            ("water_m3", sum(water) * lattice.spacing().powi(2)),
            ("lakes", f64::from(count)),
            ("lakes_percent", percent(nodes as usize)),
        ]))
    }
}

/// Channels: `flow_top_percent`, the share of all flow that passes the hundredth of the nodes with the
/// most; `channels_at_foot`, how many channels reach a side of the map: runs of its nodes with more
/// than `times_mean` of its mean flow. Nothing while no water flows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Channels {
    /// The side that channels reach.
    pub foot: Side,
    /// Flow of a channel, as a multiple of the mean over the side.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub times_mean: f64,
}

impl Default for Channels {
    fn default() -> Self {
        Self { foot: Side::South, times_mean: 2.0 }
    }
}

impl Metric for Channels {
    type Memory = ();
    const NAME: &'static str = "Channels";

    fn fields(&self) -> Vec<String> {
        vec!["flow".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let flow = stored_values::<Flow>(snapshot.world());
        let total = sum(flow);
        if total == 0.0 {
            return Ok(Vec::new());
        }
        let mut most = flow.to_vec();
        let count = (flow.len() / 100).max(1);
        most.select_nth_unstable_by(count - 1, |a, b| b.total_cmp(a));
        let side = border_nodes(snapshot.lattice(), self.foot);
        let at_foot: Vec<f64> = side.iter().map(|&node| flow[node]).collect();
        let least = self.times_mean * sum(&at_foot) / at_foot.len() as f64;
        let runs = at_foot.chunk_by(|a, b| (*a > least) == (*b > least));
        let channels = runs.filter(|run| run[0] > least).count();
        most.truncate(count);
        most.sort_unstable_by(f64::total_cmp);
        Ok(named([
            ("flow_top_percent", 100.0 * sum(&most) / total),
            ("channels_at_foot", channels as f64),
        ]))
    }
}

fn named<const N: usize>(values: [(&str, f64); N]) -> Vec<(String, f64)> {
    values.map(|(name, value)| (name.to_owned(), value)).into()
}

fn check_plane(lattice: &Lattice) -> Result<(), Problem> {
    match lattice.connectivity() {
        Connectivity::Four | Connectivity::Eight | Connectivity::FourEight => Ok(()),
        volume => {
            let message = format!("the lattice joins {volume:?}");
            Err(Problem::new("", message, "a 2-D lattice"))
        }
    }
}

/// Numbers of nodes of the connected patches of the nodes that are `inside`.
fn patches(lattice: &Lattice, inside: impl Fn(usize) -> bool) -> Vec<u64> {
    let mut seen = vec![false; lattice.node_count()];
    let mut search = BreadthFirst::new();
    let mut sizes = Vec::new();
    for node in (0..lattice.node_count()).filter(|&node| inside(node)) {
        if !seen[node] {
            let visits =
                search.collect(lattice, &[node], Reach::UNLIMITED, |_, edge| inside(edge.node));
            visits.iter().for_each(|visit| seen[visit.node] = true);
            sizes.push(visits.len() as u64);
        }
    }
    sizes
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::Boundary;

    #[test]
    fn patches_hang_together_over_diagonals_with_eight_neighbours_only() {
        let inside = [true, false, false, false, true, false, false, false, false];
        let sizes = |connectivity| {
            let lattice = Lattice::plane([3, 3], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            patches(&lattice, |node| inside[node])
        };
        assert_eq!(sizes(Connectivity::Eight), [2]);
        assert_eq!(sizes(Connectivity::Four), [1, 1]);
    }
}
