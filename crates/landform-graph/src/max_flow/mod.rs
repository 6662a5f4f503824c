//! Maximum flow between nodes of a lattice (thesis, section 5.2.1: flow through porous rock).
//!
//! [`maximum_flow`] finds how much can flow from sources to sinks when every edge carries at most
//! its capacity, and a flow that does. The graph is the lattice itself, whose edges are computed:
//! only the flow on them is stored, four bytes a slot ([`Lattice::slot`]).
//!
//! Scheme: Dinic (1970). A breadth-first search from the sources ranks nodes by their distance
//! over edges with capacity left; then every sink that still wants flow searches backwards from
//! rank to rank, where it seldom meets a dead end, until no path of falling ranks is left. Ranks go
//! on to the farthest sink, so that a phase serves sinks at all distances. When no sink can be
//! reached any more the flow is a maximum (Ford and Fulkerson 1956): what was reached and what was
//! not are a cut without capacity left.
//!
//! Cost: a phase is a search over the nodes, and there are few phases in porous rock; the bound is
//! one a node. All of it runs in a fixed order: the same flow on every run.

mod dinic;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::{Edge, Lattice};
use dinic::Dinic;

/// Largest capacity of an edge: the capacities of both directions add up in 32 bits.
pub const MOST_CAPACITY: u32 = 1 << 30;

/// A node where flow begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terminal {
    /// The node.
    pub node: usize,
    /// Most flow that it gives or takes, in the unit of the capacities.
    pub most: u64,
}

/// A flow between sources and sinks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaximumFlow {
    /// All that flows from sources to sinks.
    pub value: u64,
    /// What each sink takes, in the order in which they were given.
    pub taken: Vec<u64>,
    /// Flow on directed edges by slot ([`Lattice::slot`]); less than 0 when it comes in, so that
    /// an edge and its reverse have opposite values.
    pub flow: Vec<i32>,
}

/// Why a maximum flow cannot be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum FlowError {
    /// A source or a sink is not a node of the lattice.
    #[error("terminal {node} does not exist; the lattice has nodes 0 to {}", nodes - 1)]
    Node {
        /// The node given.
        node: usize,
        /// Number of nodes of the lattice.
        nodes: usize,
    },
    /// A node is named twice among sources and sinks.
    #[error("node {node} is named twice; a node is one source or one sink")]
    Twice {
        /// The node.
        node: usize,
    },
    /// A capacity is too large to be added to that of the reverse edge.
    #[error(
        "the capacity of the edge from node {from} to node {to} is {capacity}; at most {MOST_CAPACITY}"
    )]
    Capacity {
        /// Node that the edge leaves.
        from: usize,
        /// Node that it enters.
        to: usize,
        /// Capacity that was given.
        capacity: u32,
    },
}

/// The largest flow from `sources` to `sinks` over edges of a capacity each.
///
/// `capacity(from, edge)` is what may flow from `from` over the edge; it is asked twice for each
/// directed edge and must answer the same. Flow may pass through sources and sinks.
///
/// ```
/// use landform_graph::max_flow::{Terminal, maximum_flow};
/// use landform_graph::{Boundary, Connectivity, Lattice};
/// let lattice = Lattice::plane([4, 1], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
/// let porosity = [9, 7, 3, 9];
/// let source = Terminal { node: 0, most: 100 };
/// let sink = Terminal { node: 3, most: 100 };
/// let capacity = |from: usize, edge: &landform_graph::Edge| porosity[from].min(porosity[edge.node]);
/// let flow = maximum_flow(&lattice, capacity, &[source], &[sink])?;
/// assert_eq!(flow.value, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`FlowError`].
pub fn maximum_flow(
    lattice: &Lattice,
    capacity: impl Fn(usize, &Edge) -> u32,
    sources: &[Terminal],
    sinks: &[Terminal],
) -> Result<MaximumFlow, FlowError> {
    check_terminals(lattice, sources, sinks)?;
    let residual = capacities(lattice, &capacity)?;
    let mut dinic = Dinic::new(lattice, residual, sources, sinks);
    dinic.solve();
    let (mut flow, wanted) = dinic.finish();
    for node in 0..lattice.node_count() {
        for edge in lattice.neighbours(node) {
            let slot = lattice.slot(node, &edge);
            flow[slot] = capacity(node, &edge) as i32 - flow[slot];
        }
    }
    let taken: Vec<u64> = sinks.iter().zip(wanted).map(|(sink, left)| sink.most - left).collect();
    Ok(MaximumFlow { value: taken.iter().sum(), taken, flow })
}

fn check_terminals(
    lattice: &Lattice,
    sources: &[Terminal],
    sinks: &[Terminal],
) -> Result<(), FlowError> {
    let nodes = lattice.node_count();
    let mut named: Vec<usize> = sources.iter().chain(sinks).map(|terminal| terminal.node).collect();
    if let Some(&node) = named.iter().find(|&&node| node >= nodes) {
        return Err(FlowError::Node { node, nodes });
    }
    named.sort_unstable();
    match named.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(FlowError::Twice { node: pair[0] }),
        None => Ok(()),
    }
}

/// The capacity of every directed edge by slot; 0 for slots without an edge.
fn capacities(
    lattice: &Lattice,
    capacity: &impl Fn(usize, &Edge) -> u32,
) -> Result<Vec<i32>, FlowError> {
    let mut capacities = vec![0; lattice.slots()];
    for from in 0..lattice.node_count() {
        for edge in lattice.neighbours(from) {
            let capacity = capacity(from, &edge);
            if capacity > MOST_CAPACITY {
                return Err(FlowError::Capacity { from, to: edge.node, capacity });
            }
            capacities[lattice.slot(from, &edge)] = capacity as i32;
        }
    }
    Ok(capacities)
}
