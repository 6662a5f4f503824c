//! One wave.

use std::f64::consts::TAU;

use landform_graph::{Boundary, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Generator, SynthError};

/// A sine wave. In volumes all layers are alike.
///
/// # Limits
/// A periodic axis holds a whole number of periods, so wavelength and direction are rounded
/// there to fit. A wave that is much too long for the lattice is refused.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sinusoid {
    /// Mean height.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Height of the crests above the mean.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Distance from crest to crest: at least two spacings of the lattice.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub wavelength_m: f64,
    /// Direction across the crests, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub direction_deg: f64,
    /// Phase at the south-west corner: 0 is mean height on the way up.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub phase_deg: f64,
}

impl Default for Sinusoid {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            amplitude_m: 1.0,
            wavelength_m: 200.0,
            direction_deg: 0.0,
            phase_deg: 0.0,
        }
    }
}

impl Generator for Sinusoid {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("Sinusoid");
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.length("wavelength_m", self.wavelength_m, 2.0 * lattice.spacing())?;
        checks.range("direction_deg", self.direction_deg, -360.0..=360.0)?;
        checks.range("phase_deg", self.phase_deg, -360.0..=360.0)?;
        let [east, north] = self.periods_a_node(lattice)?;
        let phase = self.phase_deg.to_radians();
        let value = |node| {
            let [x, row, _] = lattice.coordinates(node);
            let y = lattice.height() - 1 - row;
            let periods = (east * x as f64).fract() + (north * y as f64).fract();
            self.mean_m + self.amplitude_m * (TAU * periods + phase).sin()
        };
        Ok((0..lattice.node_count()).map(value).collect())
    }
}

impl Sinusoid {
    /// Periods from node to node to the east and to the north; whole numbers of them on
    /// periodic axes.
    fn periods_a_node(&self, lattice: &Lattice) -> Result<[f64; 2], SynthError> {
        let (north, east) = self.direction_deg.to_radians().sin_cos();
        let asked = [east, north].map(|share| share * lattice.spacing() / self.wavelength_m);
        let periods = [0, 1].map(|axis| {
            let nodes = lattice.size()[axis] as f64;
            match lattice.boundary()[axis] {
                Boundary::Open => asked[axis],
                Boundary::Periodic => (asked[axis] * nodes).round() / nodes,
            }
        });
        if periods == [0.0; 2] {
            let axis = if east.abs() >= north.abs() { 'x' } else { 'y' };
            let remedy = "less than half a period fits: shorten wavelength_m";
            return Err(SynthError::DoesNotClose { generator: "Sinusoid", axis, remedy });
        }
        Ok(periods)
    }
}
