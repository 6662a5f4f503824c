//! Rivers that erode terrain.
//!
//! [`slope_area`] is the erosion model of Rodriguez-Iturbe and Rinaldo: a network of rivers,
//! known by the area that each site drains, that cuts down where the stress of its water is too
//! large, and captures tributaries as it does.
//!
//! [`water`] is water with a depth: columns that stand on the ground and flow to lower neighbours.
//! [`erosion`] is the thesis' hydraulic erosion by that flow; [`area_map`] the model that it starts
//! from, with the area that a node drains in place of flow. [`stream_power`] solves that model in years
//! and for time steps of any length, as landscape evolution models do.

pub mod area_map;
pub mod captures;
pub mod erosion;
mod error;
mod frame;
pub mod lakes;
mod plugin;
pub mod slope_area;
pub mod stream_power;
pub mod water;

pub use area_map::AreaMapErosion;
pub use erosion::HydraulicErosion;
pub use error::RiverError;
pub use plugin::{
    Channels, Flow, FlowDensity, Lakes, PipeFlow, Rain, Source, StandingWater, TributaryCaptures,
    WaterColumn,
};
pub use slope_area::{DrainageArea, ErodingSites, Pits, SlopeAreaErosion};
pub use stream_power::{ErosionRate, StreamPowerErosion, Uplift};

use landform_sim::registry::Registry;

/// Registers the processes of this crate.
pub fn register(registry: &mut Registry) {
    registry.process::<SlopeAreaErosion>();
    registry.process::<WaterColumn>().process::<HydraulicErosion>();
    registry.process::<AreaMapErosion>().process::<StreamPowerErosion>();
    registry.metric::<StandingWater>().metric::<Channels>().metric::<FlowDensity>();
    registry.metric::<TributaryCaptures>();
}
