//! Fast marching: fronts that advance in the order of their arrival (thesis, sections 3.2.3,
//! 5.2 and 5.4.1 and appendix A.5; Sethian 1996).
//!
//! | what is wanted | type |
//! |---|---|
//! | travel times, `abs(grad T) F = 1`; distance maps | [`FastMarching`] |
//! | any update from neighbour to neighbour (listings 5.1 and 5.2) | [`Front`] |
//! | listing 5.2 with a cost an edge, at full speed | [`Relaxation`] |
//!
//! All three give the same bits on every run: nodes that are due at the same time are taken in
//! node order.

mod distance;
mod eikonal;
mod front;
mod onward;
mod queue;
mod relaxation;
mod upwind;

use thiserror::Error;

use crate::Lattice;

pub use self::distance::interface_starts;
pub use self::eikonal::{Arrivals, FastMarching, MarchOptions, Order, Speed};
pub use self::front::Front;
pub use self::relaxation::Relaxation;

/// Why a front cannot march.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum MarchError {
    /// A start is not a node of the lattice.
    #[error("start node {node} does not exist; the lattice has nodes 0 to {}", nodes - 1)]
    Start {
        /// The node given.
        node: usize,
        /// Number of nodes of the lattice.
        nodes: usize,
    },
    /// A start time is not a finite number.
    #[error("the start time of node {node} is {time}; give a finite number")]
    StartTime {
        /// The node that starts.
        node: usize,
        /// The time given.
        time: f64,
    },
    /// A field does not hold one value a node.
    #[error("the {field} field has {found} values; the lattice has {expected} nodes")]
    Length {
        /// Which field.
        field: &'static str,
        /// Number of nodes.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// A speed is negative or not finite.
    #[error("the speed at node {node} is {speed}; give a finite number, 0 for an obstacle")]
    Speed {
        /// The node that the front reached.
        node: usize,
        /// Its speed.
        speed: f64,
    },
    /// A level set or a value to relax means nothing.
    #[error("the {field} field is {value} at node {node}; give numbers")]
    Value {
        /// Which field.
        field: &'static str,
        /// The first such node.
        node: usize,
        /// Its value.
        value: f64,
    },
    /// An edge has a cost that would make a front run backwards.
    #[error("the cost of the edge from node {from} to node {to} is {cost}; give 0 or more")]
    Cost {
        /// Node that the edge leaves.
        from: usize,
        /// Node that it enters.
        to: usize,
        /// Cost that was given.
        cost: f64,
    },
    /// The width of the buckets of a relaxation is not a positive finite number.
    #[error("the bucket width is {0}; give about the cost of two edges, a positive number")]
    Width(f64),
}

fn check_start(lattice: &Lattice, node: usize, time: f64) -> Result<(), MarchError> {
    let nodes = lattice.node_count();
    if node >= nodes {
        return Err(MarchError::Start { node, nodes });
    }
    if !time.is_finite() {
        return Err(MarchError::StartTime { node, time });
    }
    Ok(())
}

fn check_length(lattice: &Lattice, field: &'static str, found: usize) -> Result<(), MarchError> {
    let expected = lattice.node_count();
    if found == expected { Ok(()) } else { Err(MarchError::Length { field, expected, found }) }
}
