//! Sandpiles: self-organised criticality and the erosion models that relax it.
//!
//! The classical models have exact results, and stand here as the measure of what
//! self-organised criticality is (thesis, section 2.2):
//! - [`AbelianSandpile`]: grains on a square topple to all four neighbours at once (Bak, Tang
//!   and Wiesenfeld 1987), with Dhar's exact results in [`exact`];
//! - [`OsloPile`]: one dimension, random thresholds, driven at a wall (Christensen et al. 1996);
//! - [`SlabPile`]: one dimension, a moving slab drags along the ones underneath (Duran).
//!
//! The two models of figure 3.1 of the thesis relax self-organised criticality by a radius
//! within which an event makes further ones likelier (definition 8, section 3.1.3):
//! - [`SandLike`]: slopes that are too steep slip, and shake the slopes around;
//! - [`CorrosionLike`]: exposed rock disintegrates, and weakens the rock around.

mod abelian;
mod burning;
mod corrosion_like;
mod disc;
pub mod exact;
mod oslo;
mod sand_like;
mod slab_pile;
mod statistics;

pub use abelian::{AbelianSandpile, Avalanche, GrainLedger, SandpileError};
pub use burning::is_recurrent;
pub use corrosion_like::{CorrosionLike, CorrosionState};
pub use oslo::OsloPile;
pub use sand_like::{SandLike, SandState};
pub use slab_pile::SlabPile;
pub use statistics::{SizeBin, SizeStatistics};

/// Refuses columns of grains so high that they would slide for hours.
fn check_heights(heights: &[u32]) -> Result<(), SandpileError> {
    const MOST: u32 = 1_000_000;
    match heights.iter().max() {
        Some(&height) if height > MOST => Err(SandpileError::Parameter {
            parameter: "grains",
            value: f64::from(height),
            expected: "at most 1000000 in a column",
        }),
        _ => Ok(()),
    }
}
