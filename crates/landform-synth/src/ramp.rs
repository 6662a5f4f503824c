//! A tilted plane.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Generator, SynthError};

/// A plane of constant slope whose lowest corner is at `lowest_m`. In volumes all layers are
/// alike.
///
/// # Limits
/// A periodic axis must run along the contours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Ramp {
    /// Height of the lowest node.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub lowest_m: f64,
    /// Angle of the plane to the horizontal.
    #[schemars(range(min = 0.0, max = 89.0), extend("x-unit" = "deg"))]
    pub tilt_deg: f64,
    /// Direction in which the plane rises, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub uphill_deg: f64,
}

impl Default for Ramp {
    fn default() -> Self {
        Self { lowest_m: 0.0, tilt_deg: 5.0, uphill_deg: 90.0 }
    }
}

impl Generator for Ramp {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("Ramp");
        checks.elevation("lowest_m", self.lowest_m)?;
        checks.range("tilt_deg", self.tilt_deg, 0.0..=89.0)?;
        checks.range("uphill_deg", self.uphill_deg, -360.0..=360.0)?;
        let [east, north] = self.rise(lattice)?;
        let [width, height, _] = lattice.size();
        let extent = |nodes: usize| (nodes - 1) as f64 * lattice.spacing();
        let start =
            self.lowest_m - (east * extent(width)).min(0.0) - (north * extent(height)).min(0.0);
        let value = |node| {
            let position = lattice.position(node);
            start + east * position.x + north * position.y
        };
        Ok((0..lattice.node_count()).map(value).collect())
    }
}

impl Ramp {
    /// Rise a metre to the east and to the north, checked against the periodic axes.
    fn rise(&self, lattice: &Lattice) -> Result<[f64; 2], SynthError> {
        let steepness = self.tilt_deg.to_radians().tan();
        let (north, east) = self.uphill_deg.to_radians().sin_cos();
        // A right angle in degrees is not quite one in radians.
        let rise =
            [east, north].map(|share| if share.abs() < 1e-12 { 0.0 } else { share * steepness });
        for (axis, name) in ['x', 'y'].into_iter().enumerate() {
            if lattice.is_periodic(axis) && rise[axis] != 0.0 {
                let remedy = "turn uphill_deg across it, set tilt_deg to 0 or make the axis open";
                return Err(SynthError::DoesNotClose { generator: "Ramp", axis: name, remedy });
            }
        }
        Ok(rise)
    }
}
