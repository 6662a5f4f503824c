//! How flow gathers in channels.

use landform_graph::Lattice;
use landform_sim::field::stored_values;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, named};
use crate::plugin::Flow;
use crate::water::{Side, nodes_beside};

/// Channels of a map that falls to one side: `flow_top_percent`, the share of all flow that passes the
/// hundredth of the nodes with the most; `channels_at_foot`, how many channels reach the side;
/// `channel_width_upper_m` and `channel_width_lower_m`, their mean width along lines parallel to the
/// side, in the quarter of the map farthest from it and nearest to it. A channel is a run of nodes of
/// such a line with more than `times_mean` of its mean flow. Nothing while no water flows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Channels {
    /// The side that channels reach.
    pub foot: Side,
    /// Flow of a channel, as a multiple of the mean over the line.
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
        let lattice = snapshot.lattice();
        let lines = self.foot.depth(lattice);
        let widths = |line: usize| self.widths(lattice, flow, line);
        let mean_width_m = |lines: std::ops::Range<usize>| {
            let all: Vec<usize> = lines.flat_map(widths).collect();
            let nodes: usize = all.iter().sum();
            (nodes > 0).then(|| lattice.spacing() * nodes as f64 / all.len() as f64)
        };
        Ok(named([
            ("flow_top_percent", Some(100.0 * sum(&largest_hundredth(flow)) / total)),
            ("channels_at_foot", Some(widths(0).len() as f64)),
            ("channel_width_upper_m", mean_width_m(lines - lines.div_ceil(4)..lines)),
            ("channel_width_lower_m", mean_width_m(0..lines.div_ceil(4))),
        ]))
    }
}

impl Channels {
    /// Widths in nodes of the channels on the line of nodes at so many rows or columns from the foot.
    fn widths(&self, lattice: &Lattice, flow: &[f64], distance: usize) -> Vec<usize> {
        let line = nodes_beside(lattice, self.foot, distance);
        let flow: Vec<f64> = line.iter().map(|&node| flow[node]).collect();
        let least = self.times_mean * sum(&flow) / flow.len() as f64;
        let runs = flow.chunk_by(|a, b| (*a > least) == (*b > least));
        runs.filter(|run| run[0] > least).map(<[f64]>::len).collect()
    }
}

/// The hundredth of the values that is largest, in order.
fn largest_hundredth(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(|a, b| b.total_cmp(a));
    sorted.truncate((values.len() / 100).max(1));
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn channels_are_runs_above_the_mean_of_their_line() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([6, 2], 1.0, Connectivity::Eight, open).unwrap();
        let flow = [9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 4.0, 4.0, 0.0, 0.0, 0.0, 4.0];
        let channels = Channels { times_mean: 1.5, ..Default::default() };
        assert_eq!(channels.widths(&lattice, &flow, 0), [2, 1]);
        assert_eq!(channels.widths(&lattice, &flow, 1), [1]);
        let west = Channels { foot: Side::West, ..channels };
        assert_eq!(west.widths(&lattice, &flow, 0), Vec::<usize>::new());
        assert_eq!(largest_hundredth(&flow), [9.0]);
    }
}
