//! Rivers that erode terrain.
//!
//! [`slope_area`] is the erosion model of Rodriguez-Iturbe and Rinaldo: a network of rivers,
//! known by the area that each site drains, that cuts down where the stress of its water is too
//! large, and captures tributaries as it does.

pub mod slope_area;

pub use slope_area::{DrainageArea, ErodingSites, Pits, SlopeAreaErosion};

use landform_sim::registry::Registry;

/// Registers the processes of this crate.
pub fn register(registry: &mut Registry) {
    registry.process::<SlopeAreaErosion>();
}
