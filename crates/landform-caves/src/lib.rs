//! Caves that dissolving water makes (thesis, sections 2.3.4 and 2.4.2 and chapter 5).
//!
//! [`rock`] makes the porosity of voxels. [`stage_one`] lets protochannels grow from sources before
//! anything breaks through ([`Protochannels`]). Then channels grow ([`CaveGrowth`]): [`pressure`]
//! keeps pressure at what rock and channels allow, [`water`] flows down the pressure, [`erosion`]
//! dissolves rock where it flows, [`passages`] knows what hangs together, [`courses`] how water gets
//! from sources to sinks, and [`record`] what happened. [`growth`] puts them together.
//!
//! Everything runs on volumes and on planes, which are sections through the rock.

pub mod courses;
pub mod erosion;
mod error;
pub mod growth;
pub mod passages;
mod place;
mod plugin;
pub mod pressure;
pub mod record;
pub mod rock;
mod sparse;
pub mod stage_one;
pub mod water;

pub use error::CaveError;
pub use place::{CaveSink, CaveSource, box_nodes, displacement, height, separation};
pub use plugin::{
    CaveCourses, CaveGrowth, CaveHistory, CavePlaces, CaveWater, Passages, Porosity, Pressure,
    PressureZone, PressureZones, ProtochannelCount, ProtochannelSystems, Protochannels,
    WaterMotion,
};

use landform_sim::registry::Registry;

/// Registers the initial conditions, processes and metrics of this crate.
pub fn register(registry: &mut Registry) {
    registry
        .initial::<rock::BeddingPlanes>()
        .initial::<rock::Fractures>()
        .initial::<rock::HardRegions>()
        .initial::<rock::Strata>()
        .initial::<rock::ChannelLines>();
    registry.process::<Protochannels>().process::<CaveGrowth>();
    registry.metric::<Passages>().metric::<CaveCourses>();
    registry.metric::<PressureZones>().metric::<ProtochannelSystems>();
}
