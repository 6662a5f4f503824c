//! The simulation space of Landform.
//!
//! A [`Lattice`] is the graph that agents live on (thesis, sections 2.5 and 3.2.3): the
//! nodes of a 2-D grid or the voxels of a volume, joined to their neighbours by edges that
//! are computed and never stored. This crate knows nothing of time, of agents or of files.

mod breadth_first;
mod lattice;
mod neighbours;
pub mod quadric;
mod ray;
#[cfg(test)]
mod testing;
mod visit;

pub use breadth_first::{BreadthFirst, Reach, Visit};
pub use lattice::{Boundary, Connectivity, Lattice, LatticeError};
pub use neighbours::{Edge, Neighbours};
pub use quadric::Quadric;
pub use ray::{Ray, RayStep, Walk, WalkStep};
pub use visit::{EdgeReferences, LatticeEdge, NeighbourNodes, NodeEdges};
