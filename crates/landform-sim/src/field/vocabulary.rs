//! Fields that several processes share. Processes that agree on these compose.

use super::NodeField;

/// Elevation of the ground that wind and water cannot move as loose grains.
pub struct Bed;

impl NodeField for Bed {
    type Value = f64;
    const NAME: &'static str = "bed";
    const UNIT: &'static str = "m";
    const MEANING: &'static str = "elevation of the hard ground under loose material";
}

/// Thickness of the loose sand on the bed.
pub struct Sand;

impl NodeField for Sand {
    type Value = f64;
    const NAME: &'static str = "sand";
    const UNIT: &'static str = "m";
    const MEANING: &'static str = "thickness of the loose sand on the bed";
    const LEAST: f64 = 0.0;
}

/// Thickness of the water on the ground.
pub struct Water;

impl NodeField for Water {
    type Value = f64;
    const NAME: &'static str = "water";
    const UNIT: &'static str = "m";
    const MEANING: &'static str = "thickness of the water on the ground";
    const LEAST: f64 = 0.0;
}
