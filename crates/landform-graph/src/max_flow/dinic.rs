//! The search for paths and the flow along them.

use super::Terminal;
use crate::{Edge, Lattice};

/// Rank of nodes that no source reaches.
const UNREACHED: u32 = u32::MAX;

/// A flow on its way to the maximum.
pub(super) struct Dinic<'a> {
    lattice: &'a Lattice,
    /// Capacity that directed edges have left, by slot.
    residual: Vec<i32>,
    /// Edges from the nearest source that has flow left.
    rank: Vec<u32>,
    /// First direction of each node that the phase has not found useless.
    next: Vec<u8>,
    /// Nodes of the search by rank.
    queue: Vec<u32>,
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

impl<'a> Dinic<'a> {
    pub(super) fn new(
        lattice: &'a Lattice,
        residual: Vec<i32>,
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
            residual,
            rank: vec![UNREACHED; nodes],
            next: vec![0; nodes],
            queue: Vec::new(),
            supply,
            demand: amounts(sinks),
            path: Vec::new(),
        }
    }

    /// Raises the flow until it is a maximum.
    pub(super) fn solve(&mut self) {
        while self.rank_nodes() {
            for sink in 0..self.demand.len() {
                self.serve(sink);
            }
        }
    }

    /// Capacity left by slot, and what the sinks still want.
    pub(super) fn finish(self) -> (Vec<i32>, Vec<u64>) {
        (self.residual, self.demand.into_iter().map(|(_, wanted)| wanted).collect())
    }

    /// Ranks nodes until all sinks that want flow have a rank, or nothing is left to reach; false
    /// if none of them can be reached.
    fn rank_nodes(&mut self) -> bool {
        self.rank.fill(UNREACHED);
        self.next.fill(0);
        self.queue.clear();
        for &(node, _) in self.supply.iter().filter(|(_, left)| *left > 0) {
            self.rank[node] = 0;
            self.queue.push(node as u32);
        }
        let wanting = self.demand.iter().filter(|(_, wanted)| *wanted > 0);
        let mut missing: Vec<usize> = wanting.map(|&(node, _)| node).collect();
        let sought = missing.len();
        let mut head = 0;
        while let Some(&node) = self.queue.get(head) {
            if head == 0 || self.rank[node as usize] != self.rank[self.queue[head - 1] as usize] {
                // A rank is complete: those below are all known.
                missing.retain(|&sink| self.rank[sink] == UNREACHED);
                if missing.is_empty() {
                    break;
                }
            }
            self.reach_from(node as usize);
            head += 1;
        }
        missing.retain(|&sink| self.rank[sink] == UNREACHED);
        missing.len() < sought
    }

    /// Ranks the neighbours to which more can flow.
    fn reach_from(&mut self, node: usize) {
        let rank = self.rank[node] + 1;
        let first = node * self.lattice.directions();
        for edge in self.lattice.neighbours(node) {
            let left = self.residual[first + usize::from(edge.direction)];
            if left > 0 && self.rank[edge.node] == UNREACHED {
                self.rank[edge.node] = rank;
                self.queue.push(edge.node as u32);
            }
        }
    }

    /// Leads flow to a sink over paths of falling ranks until it has enough or none is left.
    fn serve(&mut self, sink: usize) {
        let (end, _) = self.demand[sink];
        self.path.clear();
        let mut node = end;
        while self.demand[sink].1 > 0 && self.rank[end] != UNREACHED {
            if self.rank[node] == 0 && self.send(node, sink) {
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

    /// The edge to a neighbour one rank lower from which more can flow to this node.
    fn feeder(&mut self, node: usize) -> Option<Edge> {
        let below = self.rank[node].checked_sub(1)?;
        while usize::from(self.next[node]) < self.lattice.directions() {
            if let Some(edge) = self.lattice.edge(node, self.next[node])
                && self.rank[edge.node] == below
                && self.residual[self.lattice.reverse_slot(&edge)] > 0
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
