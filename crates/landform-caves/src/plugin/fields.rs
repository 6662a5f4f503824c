//! Fields of caves.

use landform_sim::field::NodeField;

/// Porosity: 0 for impermeable rock, 1 for a void.
pub struct Porosity;

impl NodeField for Porosity {
    type Value = f64;
    const NAME: &'static str = "porosity";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "share of the voxel that water may fill";
    const LEAST: f64 = 0.0;
}

/// Pressure of the water in the pores.
pub struct Pressure;

impl NodeField for Pressure {
    type Value = f64;
    const NAME: &'static str = "pressure";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "pressure of the water in the pores, 0 at sinks";
    const LEAST: f64 = 0.0;
}

/// Which source claims a voxel.
pub struct PressureZone;

impl NodeField for PressureZone {
    type Value = f64;
    const NAME: &'static str = "pressure_zone";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of the source that claims the voxel, from 1; 0 for none";
    const LEAST: f64 = 0.0;
}

/// Protochannels through a voxel.
pub struct ProtochannelCount;

impl NodeField for ProtochannelCount {
    type Value = f64;
    const NAME: &'static str = "protochannels";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of protochannels that pass the voxel";
    const LEAST: f64 = 0.0;
}
