//! Maximum flow between nodes of a lattice (thesis, section 5.2.1: flow through porous rock).
//!
//! [`maximum_flow`] finds how much can flow from sources to sinks when every edge carries at most
//! its capacity, and a flow that does. The graph is the lattice itself: its edges and their capacities
//! are computed, only the flow on them is stored, four bytes a slot ([`Lattice::slot`]), of which
//! slots without flow take no memory where the system hands out pages when they are first written.
//!
//! Scheme: Dinic (1970), with distances that may be costs. Nodes are ranked by the cost of the
//! cheapest way from a source over edges with capacity left; then every sink that still wants flow
//! searches backwards along cheapest ways, where it seldom meets a dead end, until none is left. When no
//! sink can be reached any more the flow is a maximum (Ford and Fulkerson 1956): what was reached and
//! what was not are a cut without capacity left.
//!
//! Every sink gets a unit first, before any gets more, so that those which are reached first leave
//! something to the others: a flow once at a sink stays there, whatever is changed on the way, so the flow
//! is the largest in the end, and no other gives something to more of the sinks.
//!
//! The value of the flow does not depend on costs, but its ways do. When every edge costs 1 this is
//! Dinic's algorithm; when edges cost their length over the porosity, flow keeps to good rock.
//!
//! Cost: a phase is a relaxation over the nodes ([`crate::marching::Relaxation`]). With edges of equal
//! cost there are few phases, one a node at most; with costs that all differ every phase leads flow
//! over one way to each sink. All of it runs in a fixed order: the same flow on every run.

mod dinic;
#[cfg(test)]
mod reference;
mod residual;
#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::marching::MarchError;
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
    /// What each sink takes, in the order in which they were given; nothing only if no flow could
    /// bring a unit to it and to all the others that have one.
    pub taken: Vec<u64>,
    /// Flow on directed edges by slot ([`Lattice::slot`]); less than 0 when it comes in, so that
    /// an edge and its reverse have opposite values.
    pub flow: Vec<i32>,
}

/// Why a maximum flow cannot be found.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
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
    /// An edge costs nothing, less than nothing or no number.
    #[error("the edge from node {from} to node {to} costs {cost}; give a positive number")]
    Cost {
        /// Node that the edge leaves.
        from: usize,
        /// Node that it enters.
        to: usize,
        /// Cost that was given.
        cost: f64,
    },
    /// The costs of edges lie too far apart for their sums.
    #[error("the costs of edges differ by more than 15 decimal places; give costs of like size")]
    Precision,
    /// Nodes cannot be ranked.
    #[error(transparent)]
    March(#[from] MarchError),
}

/// The largest flow from `sources` to `sinks` over edges of a capacity each.
///
/// `capacity(from, edge)` is what may flow from `from` over the edge; it is asked again and again and
/// must answer the same. `cost(from, edge)` is what the way over the edge costs, more than 0. What lies
/// where no flow can come to is not asked about. Flow may pass through sources and sinks. As many sinks
/// as possible take something.
///
/// ```
/// use landform_graph::max_flow::{Terminal, maximum_flow};
/// use landform_graph::{Boundary, Connectivity, Lattice};
/// let lattice = Lattice::plane([4, 1], 1.0, Connectivity::Four, [Boundary::Open; 2])?;
/// let porosity = [9, 7, 3, 9];
/// let source = Terminal { node: 0, most: 100 };
/// let sink = Terminal { node: 3, most: 100 };
/// let capacity = |from: usize, edge: &landform_graph::Edge| porosity[from].min(porosity[edge.node]);
/// let flow = maximum_flow(&lattice, capacity, |_, _| 1.0, &[source], &[sink])?;
/// assert_eq!(flow.value, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`FlowError`].
pub fn maximum_flow(
    lattice: &Lattice,
    capacity: impl Fn(usize, &Edge) -> u32,
    cost: impl Fn(usize, &Edge) -> f64,
    sources: &[Terminal],
    sinks: &[Terminal],
) -> Result<MaximumFlow, FlowError> {
    check_terminals(lattice, sources, sinks)?;
    let mut dinic = Dinic::new(lattice, (capacity, cost), sources, sinks);
    dinic.solve()?;
    let (flow, wanted) = dinic.finish();
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
