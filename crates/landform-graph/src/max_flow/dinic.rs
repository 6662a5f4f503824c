//! The search for paths and the flow along them.

use super::{FlowError, Terminal};
use crate::marching::Relaxation;
use crate::{Edge, Lattice};

/// A flow on its way to the maximum.
pub(super) struct Dinic<'a, C> {
    lattice: &'a Lattice,
    /// What edges cost, and the width of the buckets in which nodes are ranked.
    cost: (C, f64),
    /// Capacity that directed edges have left, by slot.
    residual: Vec<i32>,
    /// Cost from the nearest source that has flow left; infinite where none reaches.
    rank: Vec<f64>,
    /// First direction of each node that the phase has not found useless.
    next: Vec<u8>,
    relaxation: Relaxation,
    starts: Vec<usize>,
    /// Sources by node, with what they have left.
    supply: Vec<(usize, u64)>,
    /// Sinks in the order given, with what they still want.
    demand: Vec<(usize, u64)>,
    /// The way from the present node to the sink, the sink first.
    path: Vec<Step>,
}

/// An edge of a path.
struct Step {
    /// The node that it enters.
    node: usize,
    /// Its slot.
    slot: usize,
    /// Slot of its reverse.
    reverse: usize,
}

impl<'a, C: Fn(usize, &Edge) -> f64> Dinic<'a, C> {
    pub(super) fn new(
        lattice: &'a Lattice,
        residual: Vec<i32>,
        cost: (C, f64),
        sources: &[Terminal],
        sinks: &[Terminal],
    ) -> Self {
        let amounts = |terminals: &[Terminal]| -> Vec<(usize, u64)> {
            terminals.iter().map(|terminal| (terminal.node, terminal.most)).collect()
        };
        let mut supply = amounts(sources);
        supply.sort_unstable();
        let nodes = lattice.node_count();
        Self {
            lattice,
            cost,
            residual,
            rank: vec![f64::INFINITY; nodes],
            next: vec![0; nodes],
            relaxation: Relaxation::new(),
            starts: Vec::new(),
            supply,
            demand: amounts(sinks),
            path: Vec::new(),
        }
    }

    /// Raises the flow until it is a maximum.
    pub(super) fn solve(&mut self) -> Result<(), FlowError> {
        let wanted = |demand: &[(usize, u64)]| {
            demand.iter().map(|(_, wanted)| u128::from(*wanted)).sum::<u128>()
        };
        while self.rank_nodes()? {
            let before = wanted(&self.demand);
            for sink in 0..self.demand.len() {
                self.serve(sink);
            }
            if wanted(&self.demand) == before {
                // A step so cheap beside the way so far that it is lost in rounding.
                return Err(FlowError::Precision);
            }
        }
        Ok(())
    }

    /// Capacity left by slot, and what the sinks still want.
    pub(super) fn finish(self) -> (Vec<i32>, Vec<u64>) {
        (self.residual, self.demand.into_iter().map(|(_, wanted)| wanted).collect())
    }

    /// Ranks all nodes that more can flow to; false if no sink that wants flow is among them.
    fn rank_nodes(&mut self) -> Result<bool, FlowError> {
        let Self { lattice, cost: (cost, width), residual, rank, starts, .. } = self;
        rank.fill(f64::INFINITY);
        starts.clear();
        starts.extend(self.supply.iter().filter(|(_, left)| *left > 0).map(|&(node, _)| node));
        starts.iter().for_each(|&node| rank[node] = 0.0);
        let directions = lattice.directions();
        let open_cost = |from: usize, edge: &Edge| match residual
            [from * directions + usize::from(edge.direction)]
            > 0
        {
            true => cost(from, edge),
            false => f64::INFINITY,
        };
        self.relaxation.relax(lattice, rank, starts, *width, open_cost)?;
        self.next.fill(0);
        let wanting = self.demand.iter().filter(|(_, wanted)| *wanted > 0);
        Ok(wanting.into_iter().any(|&(node, _)| self.rank[node].is_finite()))
    }

    /// Leads flow to a sink over paths of falling ranks until it has enough or none is left.
    fn serve(&mut self, sink: usize) {
        let (end, _) = self.demand[sink];
        self.path.clear();
        let mut node = end;
        while self.demand[sink].1 > 0 && self.rank[end].is_finite() {
            if self.rank[node] == 0.0 && self.send(node, sink) {
                self.path.clear();
                node = end;
            } else if let Some(edge) = self.feeder(node) {
                let reverse = self.lattice.slot(node, &edge);
                self.path.push(Step { node, slot: self.lattice.reverse_slot(&edge), reverse });
                node = edge.node;
            } else if let Some(step) = self.path.pop() {
                // A dead end.
                self.next[step.node] += 1;
                node = step.node;
            } else {
                return;
            }
        }
    }

    /// The edge to a neighbour on the cheapest way from a source, from which more can flow to this node.
    fn feeder(&mut self, node: usize) -> Option<Edge> {
        let rank = self.rank[node];
        while rank > 0.0 && usize::from(self.next[node]) < self.lattice.directions() {
            if let Some(edge) = self.lattice.edge(node, self.next[node])
                && self.residual[self.lattice.reverse_slot(&edge)] > 0
                && let Some(back) = self.lattice.edge(edge.node, self.lattice.opposite(edge.direction))
                // The rank is the least of these sums, so one of them is it to the last bit.
                && self.rank[edge.node] < rank
                && self.rank[edge.node] + (self.cost.0)(edge.node, &back) == rank
            {
                return Some(edge);
            }
            self.next[node] += 1;
        }
        None
    }

    /// Sends what the source at `node` has and the path can carry; false if that is nothing.
    fn send(&mut self, node: usize, sink: usize) -> bool {
        let Ok(source) = self.supply.binary_search_by_key(&node, |supply| supply.0) else {
            return false;
        };
        let carried = self.path.iter().map(|step| self.residual[step.slot] as u64).min();
        let most = self.supply[source].1.min(self.demand[sink].1);
        let amount = carried.unwrap_or(0).min(most);
        self.supply[source].1 -= amount;
        self.demand[sink].1 -= amount;
        for step in &self.path {
            // At most a capacity, which fits.
            self.residual[step.slot] -= amount as i32;
            self.residual[step.reverse] += amount as i32;
        }
        amount > 0
    }
}
