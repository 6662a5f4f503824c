//! The shape of caves: networks of centrelines, surveyed or of voxels, and morphometric indices.

mod indices;
mod network;
mod of_voxels;
mod passage;
mod paths;
mod reduced;
mod shape;
mod surveyed;

pub use indices::{CaveField, CaveIndices, CaveTotals};
pub use network::{Branch, CaveNetwork, CaveNetworkError};
pub use passage::PassageSize;
pub use shape::{NetworkShape, OBSERVED, Observed};
