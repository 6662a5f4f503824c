//! Edmonds and Karp (1972): the shortest path with capacity left, again and again, on an ordinary
//! network with a node that feeds all sources and one that all sinks lead to.

use super::Terminal;
use crate::{Edge, Lattice};

/// Value of the maximum flow.
pub(super) fn maximum_flow_value(
    lattice: &Lattice,
    capacity: impl Fn(usize, &Edge) -> u32,
    sources: &[Terminal],
    sinks: &[Terminal],
) -> u64 {
    let (start, end) = (lattice.node_count(), lattice.node_count() + 1);
    // Head and capacity left of each arc; the reverse of arc `n` is `n ^ 1`.
    let mut arcs: Vec<(usize, u64)> = Vec::new();
    let mut leaving = vec![Vec::new(); end + 1];
    let mut add = |from: usize, to: usize, most: u64| {
        leaving[from].push(arcs.len());
        arcs.push((to, most));
        leaving[to].push(arcs.len());
        arcs.push((from, 0));
    };
    for node in 0..lattice.node_count() {
        for edge in lattice.neighbours(node) {
            add(node, edge.node, u64::from(capacity(node, &edge)));
        }
    }
    sources.iter().for_each(|source| add(start, source.node, source.most));
    sinks.iter().for_each(|sink| add(sink.node, end, sink.most));
    let mut value = 0;
    loop {
        let mut arrived = vec![None; end + 1];
        let mut queue = std::collections::VecDeque::from([start]);
        while let Some(node) = queue.pop_front() {
            for &arc in &leaving[node] {
                let (to, left) = arcs[arc];
                if left > 0 && to != start && arrived[to].is_none() {
                    arrived[to] = Some(arc);
                    queue.push_back(to);
                }
            }
        }
        let mut path = Vec::new();
        let mut node = end;
        while let Some(arc) = arrived[node] {
            path.push(arc);
            node = arcs[arc ^ 1].0;
        }
        let Some(amount) = path.iter().map(|&arc| arcs[arc].1).min() else { return value };
        for arc in path {
            arcs[arc].1 -= amount;
            arcs[arc ^ 1].1 += amount;
        }
        value += amount;
    }
}
