//! Single hills.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::place::offset_from;
use crate::{Generator, SynthError};

/// A cone on level ground, as sand poured on one spot makes. In volumes all layers are alike.
/// On periodic axes it reaches across the border.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Cone {
    /// Height of the ground.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub base_m: f64,
    /// Height of the top above the ground; negative for a pit.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Distance from the top to the foot.
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub radius_m: f64,
    /// Place of the top: share of the width from west to east, of the height from south to
    /// north.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub center: [f64; 2],
}

impl Default for Cone {
    fn default() -> Self {
        Self { base_m: 0.0, height_m: 50.0, radius_m: 100.0, center: [0.5; 2] }
    }
}

impl Generator for Cone {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("Cone");
        checks.elevation("base_m", self.base_m)?;
        checks.elevation("height_m", self.height_m)?;
        checks.length("radius_m", self.radius_m, 1e-9)?;
        let share = |distance: f64| (1.0 - distance / self.radius_m).max(0.0);
        hill(&checks, lattice, self.center, |d| self.base_m + self.height_m * share(d))
    }
}

/// A hill with the profile of a bell curve. In volumes all layers are alike. On periodic axes it
/// reaches across the border, with a crease where a wide hill meets its own other side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GaussianHill {
    /// Height of the ground far away.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub base_m: f64,
    /// Height of the top above the ground; negative for a hollow.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Distance from the top to where 61 % of the height is left (one standard deviation).
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub radius_m: f64,
    /// Place of the top: share of the width from west to east, of the height from south to
    /// north.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub center: [f64; 2],
}

impl Default for GaussianHill {
    fn default() -> Self {
        Self { base_m: 0.0, height_m: 50.0, radius_m: 100.0, center: [0.5; 2] }
    }
}

impl Generator for GaussianHill {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("GaussianHill");
        checks.elevation("base_m", self.base_m)?;
        checks.elevation("height_m", self.height_m)?;
        checks.length("radius_m", self.radius_m, 1e-9)?;
        let share = |distance: f64| (-0.5 * (distance / self.radius_m).powi(2)).exp();
        hill(&checks, lattice, self.center, |d| self.base_m + self.height_m * share(d))
    }
}

/// A field that depends on the distance in metres to `center` alone.
fn hill(
    checks: &Checks,
    lattice: &Lattice,
    center: [f64; 2],
    height: impl Fn(f64) -> f64,
) -> Result<Vec<f64>, SynthError> {
    for share in center {
        checks.range("center", share, 0.0..=1.0)?;
    }
    let value = |node| {
        let [east, north] = offset_from(lattice, center, node);
        height(east.hypot(north))
    };
    Ok((0..lattice.node_count()).map(value).collect())
}
