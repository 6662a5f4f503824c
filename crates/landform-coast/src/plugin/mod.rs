//! Coasts as processes, metrics and initial conditions that scenarios may name.

mod erosion;
mod groups;
mod heights;
mod image;
mod image_device;
mod interior;
mod level_sets;
mod metrics;
mod pruning;
mod starting_land;

pub use erosion::{CoastErosion, CoastRecord};
pub use groups::{
    CoastAgents, CoastMarks, CoastRegion, Eroded, Land, LevelSetNumber, OnLevelSet, Resistance,
};
pub use heights::{HeightsRecord, Interpolation, LevelSetHeights};
pub use image::{ImageCoastErosion, ImageCoastRecord};
pub use image_device::CoastDevice;
pub use interior::{InteriorRecord, IslandInterior};
pub use level_sets::{ImageCoastActivity, LevelSetActivity};
pub use metrics::{CoastActivity, CoastFront, Islands};
pub use pruning::IslandPruning;
pub use starting_land::{LandShape, StartingLand};

use landform_sim::registry::Registry;

/// Registers the processes, metrics and initial conditions of this crate.
pub fn register(registry: &mut Registry) {
    registry.process::<CoastErosion>().process::<IslandPruning>();
    registry.process::<IslandInterior>().process::<LevelSetHeights>();
    registry.process::<ImageCoastErosion>();
    registry.metric::<LevelSetActivity>().metric::<ImageCoastActivity>();
    registry.metric::<CoastActivity>().metric::<CoastFront>().metric::<Islands>();
    registry.initial::<StartingLand>();
}
