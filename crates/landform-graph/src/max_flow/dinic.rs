//! The search for paths and the flow along them.

use std::cell::Cell;

use super::residual::Residual;
use super::{FlowError, Terminal};
use crate::marching::Relaxation;
use crate::{Edge, Lattice};

/// A flow on its way to the maximum.
pub(super) struct Dinic<'a, K, C> {
    lattice: &'a Lattice,
    residual: Residual<'a, K>,
    /// What edges cost, and the width of the buckets in which nodes are ranked.
    cost: (C, f64),
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
    /// The node that it leaves.
    from: usize,
    edge: Edge,
}

impl<'a, K: Fn(usize, &Edge) -> u32, C: Fn(usize, &Edge) -> f64> Dinic<'a, K, C> {
    pub(super) fn new(
        lattice: &'a Lattice,
        (capacity, cost): (K, C),
        sources: &[Terminal],
        sinks: &[Terminal],
    ) -> Self {
        let amounts = |terminals: &[Terminal]| -> Vec<(usize, u64)> {
            terminals.iter().map(|terminal| (terminal.node, terminal.most)).collect()
        };
        let mut supply = amounts(sources);
        supply.sort_unstable();
        let nodes = lattice.node_count();
        let width = bucket_width(lattice, &capacity, &cost);
        Self {
            lattice,
            residual: Residual::new(lattice, capacity),
            cost: (cost, width),
            rank: vec![f64::INFINITY; nodes],
            next: vec![0; nodes],
            relaxation: Relaxation::new(),
            starts: Vec::new(),
            supply,
            demand: amounts(sinks),
            path: Vec::new(),
        }
    }

    /// Raises the flow until it is a maximum: first a unit for every sink, as many as can have one at
    /// once, then all that they want. What a sink has is not taken from it again.
    pub(super) fn solve(&mut self) -> Result<(), FlowError> {
        let later: Vec<u64> =
            self.demand.iter().map(|(_, wanted)| wanted.saturating_sub(1)).collect();
        self.demand.iter_mut().for_each(|(_, wanted)| *wanted = (*wanted).min(1));
        self.fill()?;
        self.demand.iter_mut().zip(later).for_each(|((_, wanted), later)| *wanted += later);
        self.fill()
    }

    /// Raises the flow until no sink can get more of what it wants.
    fn fill(&mut self) -> Result<(), FlowError> {
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

    /// Flow by slot, and what the sinks still want.
    pub(super) fn finish(self) -> (Vec<i32>, Vec<u64>) {
        let wanted = self.demand.into_iter().map(|(_, wanted)| wanted).collect();
        (self.residual.into_flow(), wanted)
    }

    /// Ranks all nodes that more can flow to; false if no sink that wants flow is among them.
    fn rank_nodes(&mut self) -> Result<bool, FlowError> {
        let Self { lattice, residual, cost: (cost, width), rank, starts, .. } = self;
        rank.fill(f64::INFINITY);
        starts.clear();
        starts.extend(self.supply.iter().filter(|(_, left)| *left > 0).map(|&(node, _)| node));
        starts.iter().for_each(|&node| rank[node] = 0.0);
        let refused = Cell::new(None);
        let open_cost = |from: usize, edge: &Edge| {
            if residual.left(from, edge) == 0 {
                return f64::INFINITY;
            }
            let cost = cost(from, edge);
            if !(cost > 0.0 && cost.is_finite()) {
                refused.set(Some(FlowError::Cost { from, to: edge.node, cost }));
                return f64::INFINITY;
            }
            cost
        };
        self.relaxation.relax(lattice, rank, starts, *width, open_cost)?;
        residual.check()?;
        refused.take().map_or(Ok(()), Err)?;
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
            } else if let Some(step) = self.feeder(node) {
                node = step.from;
                self.path.push(step);
            } else if let Some(step) = self.path.pop() {
                // A dead end.
                node = step.edge.node;
                self.next[node] += 1;
            } else {
                return;
            }
        }
    }

    /// The edge from a neighbour on the cheapest way from a source, over which more can flow to this
    /// node.
    fn feeder(&mut self, node: usize) -> Option<Step> {
        let rank = self.rank[node];
        while rank > 0.0 && usize::from(self.next[node]) < self.lattice.directions() {
            if let Some(back) = self.lattice.edge(node, self.next[node])
                && self.rank[back.node] < rank
                && let Some(edge) = self.lattice.edge(back.node, self.lattice.opposite(back.direction))
                && self.residual.left(back.node, &edge) > 0
                // The rank is the least of these sums, so one of them is it to the last bit.
                && self.rank[back.node] + (self.cost.0)(back.node, &edge) == rank
            {
                return Some(Step { from: back.node, edge });
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
        let left = |step: &Step| self.residual.left(step.from, &step.edge);
        let carried = self.path.iter().map(left).min().unwrap_or(0);
        let most = self.supply[source].1.min(self.demand[sink].1);
        let amount = most.min(u64::from(carried));
        self.supply[source].1 -= amount;
        self.demand[sink].1 -= amount;
        for step in &self.path {
            // At most what an edge has left, which fits.
            self.residual.add(step.from, &step.edge, amount as u32);
        }
        amount > 0
    }
}

/// About twice the mean cost of the edges with a capacity, by those of a thousand nodes: the width of
/// buckets that makes ranking fast, and changes nothing else.
fn bucket_width(
    lattice: &Lattice,
    capacity: &impl Fn(usize, &Edge) -> u32,
    cost: &impl Fn(usize, &Edge) -> f64,
) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for from in (0..lattice.node_count()).step_by(lattice.node_count().div_ceil(1000)) {
        for edge in lattice.neighbours(from).filter(|edge| capacity(from, edge) > 0) {
            let cost = cost(from, &edge);
            if cost > 0.0 && cost.is_finite() {
                sum += cost;
                count += 1.0;
            }
        }
    }
    let width = 2.0 * (sum / count);
    if width > 0.0 && width.is_finite() { width } else { 1.0 }
}
