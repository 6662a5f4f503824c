//! Sets of voxels: topology, thinning, surfaces, centrelines and the shape of caves.

mod fans;
mod set;
mod simple;
mod smooth;
mod surface;
#[cfg(test)]
mod tests;
mod thinning;
mod topology;

pub use set::VoxelSet;
pub use smooth::smooth_surface;
pub use surface::{Surface, surface};
pub use thinning::{Rule, Turns, centreline, plan_sheet};
