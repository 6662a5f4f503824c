//! The simulation space of Landform.
//!
//! A [`Lattice`] is the graph that agents live on (thesis, sections 2.5 and 3.2.3): the
//! nodes of a 2-D grid or the voxels of a volume, joined to their neighbours by edges that
//! are computed and never stored. This crate knows nothing of time, of agents or of files.
//!
//! | thesis, section 3.2.3 | here |
//! |---|---|
//! | graph of a terrain mesh, degrees 8 and 4 in turn | [`Lattice::plane`] with [`Connectivity::FourEight`] |
//! | graph of voxels, 26 neighbours | [`Lattice::volume`] with [`Connectivity::Voxel26`] |
//! | two directed edges for each pair of neighbours | [`Edge`]; [`LatticeEdge`] to petgraph |
//! | extra data on edges | [`Lattice::slot`], [`Lattice::reverse_slot`]: values in slices |
//! | neighbour search | [`Lattice::neighbours`] |
//! | search along a ray with a given direction | [`Lattice::ray`]; over edges [`Lattice::walk`] |
//! | breadth-first search, radius, filter on edges | [`BreadthFirst`] |
//! | search based on a distance map | [`marching::FastMarching`] |
//! | fast marching as an iteration scheme (A.5) | [`marching::Front`], [`marching::Relaxation`] |
//! | largest flow through porous rock (5.2.1) | [`max_flow::maximum_flow`] |
//! | quadratic fitting | [`Quadric`]; whole fields in [`quadric`] |
//!
//! Nodes are numbered by rows, and a field is a slice of one value a node in that order: every
//! function here takes the lattice and the slices that it reads and writes. Searches keep
//! their memory in a value of their own ([`BreadthFirst`], [`marching::FastMarching`] and
//! others), so that to search again costs no allocation.
//!
//! Every algorithm of petgraph runs on a lattice as it is, the length of an edge in metres
//! being its weight:
//!
//! ```
//! use landform_graph::{Boundary, Connectivity, Lattice};
//! use petgraph::algo::astar;
//! let lattice = Lattice::plane([40, 30], 5.0, Connectivity::FourEight, [Boundary::Open; 2])?;
//! let goal = lattice.node([39, 29, 0]);
//! let straight = |node| lattice.position(node).distance(lattice.position(goal));
//! let path = astar(&lattice, 0, |node| node == goal, |_| 5.0, straight);
//! assert_eq!(path.map(|(_, nodes)| nodes.len()), Some(40));
//! # Ok::<(), landform_graph::LatticeError>(())
//! ```
//!
//! Everything is deterministic: neighbours come in a fixed order, ties are broken by node,
//! and kernels that use threads write each node from its own window only.

mod breadth_first;
mod lattice;
pub mod marching;
pub mod max_flow;
mod neighbours;
pub mod quadric;
mod ray;
mod slots;
#[cfg(test)]
mod testing;
mod visit;

pub use breadth_first::{BreadthFirst, Reach, Visit};
pub use lattice::{Boundary, Connectivity, Lattice, LatticeError};
pub use neighbours::{Edge, Neighbours};
pub use quadric::Quadric;
pub use ray::{Ray, RayStep, Walk, WalkStep};
pub use visit::{EdgeReferences, LatticeEdge, NeighbourNodes, NodeEdges};
