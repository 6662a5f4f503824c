//! A straight ridge of sand.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::place::offset_from;
use crate::{Generator, SynthError};

/// Which way a ridge runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum RidgeCourse {
    /// From north to south: across a west or east wind.
    #[default]
    NorthSouth,
    /// From west to east: across a north or south wind.
    EastWest,
}

/// A straight ridge with two plane faces on level ground, from border to border. In volumes all
/// layers are alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Ridge {
    /// Height of the ground.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub base_m: f64,
    /// Height of the crest above the ground; negative for a trench.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Distance from one foot to the other.
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub width_m: f64,
    /// Which way the crest runs.
    pub course: RidgeCourse,
    /// Place of the crest as a share of the lattice, from west to east or from south to north.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub place: f64,
}

impl Default for Ridge {
    fn default() -> Self {
        Self {
            base_m: 0.0,
            height_m: 50.0,
            width_m: 200.0,
            course: RidgeCourse::NorthSouth,
            place: 0.5,
        }
    }
}

impl Generator for Ridge {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("Ridge");
        checks.elevation("base_m", self.base_m)?;
        checks.elevation("height_m", self.height_m)?;
        checks.length("width_m", self.width_m, 1e-9)?;
        checks.range("place", self.place, 0.0..=1.0)?;
        let value = |node| {
            let [east, north] = offset_from(lattice, [self.place; 2], node);
            let across = match self.course {
                RidgeCourse::NorthSouth => east,
                RidgeCourse::EastWest => north,
            };
            self.base_m + self.height_m * (1.0 - 2.0 * across.abs() / self.width_m).max(0.0)
        };
        Ok((0..lattice.node_count()).map(value).collect())
    }
}
