//! Sets of voxels: topology, thinning, surfaces, centrelines and the shape of caves.

mod set;
mod simple;
#[cfg(test)]
mod tests;
mod thinning;
mod topology;

pub use set::VoxelSet;
pub use thinning::{Rule, Turns, centreline, plan_sheet};
