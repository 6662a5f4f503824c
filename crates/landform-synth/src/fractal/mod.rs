//! Fractal surfaces made of octaves of noise.

mod basis;
mod cascade;
mod cells;
mod cellular;
mod frame;
mod gradient;
mod patch;
mod slope;
mod surface;
#[cfg(test)]
mod tests;
mod warp;

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use basis::Basis;
pub use cascade::{Cascade, OctaveShape};
pub use warp::Warp;

pub(crate) use frame::Frame;
pub(crate) use surface::{NoiseSurface, Scratch};
pub(crate) use warp::WarpField;

use crate::error::Checks;
use crate::place::fill_by_tiles;
use crate::{Generator, SynthError};

/// Octaves of noise: fractional Brownian motion by noise-summing (thesis, section 2.1.5, figure
/// 2.7), ridged noise, and the multifractals of Musgrave (Ebert et al., Texturing and Modeling).
///
/// Octave `k` has the wavelength `wavelength_m / lacunarity^k` and the amplitude
/// `lacunarity^(-hurst k)`. `basis` is its noise, `shape` what is done to it, `cascade` how the
/// octaves are put together; the outcome is multiplied with `amplitude_m` and added to `mean_m`.
/// Every octave has random numbers and a random shift of its own. The surface is a function of
/// the place: a larger lattice with the same seed and spacing shows more of the same.
///
/// # Limits
/// 2-D only. Octaves shorter than the spacing are left out, since they would be white noise. On
/// periodic axes wavelengths are rounded so that whole cells fit, and no octave is turned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FractalNoise {
    /// Height where the noise is 0.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Height of a noise of 1. A single octave rises and sinks by this at most.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Size of a cell of the first octave, about the distance from hill to hill: at least the
    /// spacing.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub wavelength_m: f64,
    /// Number of octaves.
    #[schemars(range(min = 1, max = 32))]
    pub octaves: u32,
    /// Wavelength of an octave over that of the next.
    #[schemars(range(min = 1.01, max = 8.0))]
    pub lacunarity: f64,
    /// Hurst exponent H: near 0 rough, near 1 smooth.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub hurst: f64,
    /// Angle between the cells of an octave and those of the next, which hides their grids.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub rotation_deg: f64,
    /// The noise of an octave.
    pub basis: Basis,
    /// What is done to the noise of an octave.
    pub shape: OctaveShape,
    /// How octaves are put together.
    pub cascade: Cascade,
    /// Bends the ground on which the surface is drawn.
    pub warp: Option<Warp>,
}

impl Default for FractalNoise {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            amplitude_m: 100.0,
            wavelength_m: 1000.0,
            octaves: 8,
            lacunarity: 2.0,
            hurst: 1.0,
            rotation_deg: 37.0,
            basis: Basis::Gradient,
            shape: OctaveShape::Plain,
            cascade: Cascade::Sum,
            warp: None,
        }
    }
}

impl Generator for FractalNoise {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        Checks("FractalNoise").plane(lattice)?;
        let surface = NoiseSurface::new(*self, &Frame::of(lattice), seed)?;
        Ok(fill_by_tiles(lattice, Scratch::new, |scratch, positions, heights| {
            surface.heights(positions, scratch, heights);
        }))
    }
}

impl FractalNoise {
    fn check(&self, frame: &Frame) -> Result<(), SynthError> {
        let checks = Checks("FractalNoise");
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.length("wavelength_m", self.wavelength_m, frame.spacing)?;
        checks.range("octaves", f64::from(self.octaves), 1.0..=32.0)?;
        checks.range("lacunarity", self.lacunarity, 1.01..=8.0)?;
        checks.range("hurst", self.hurst, 0.0..=2.0)?;
        checks.range("rotation_deg", self.rotation_deg, -360.0..=360.0)?;
        if let Some((name, value)) = self.cascade.parameter() {
            checks.range(name, value, 0.0..=10.0)?;
        }
        let names = ["warp.amplitude_m", "warp.wavelength_m", "warp.octaves"];
        self.warp.map_or(Ok(()), |warp| warp.check(&checks, names, frame))
    }
}
