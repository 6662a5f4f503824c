//! Fractal surfaces made of octaves of noise.

mod basis;
mod cascade;
mod cells;
mod cellular;
mod gradient;
#[cfg(test)]
mod tests;
mod warp;

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use basis::Basis;
pub use cascade::{Cascade, OctaveShape};
pub use warp::Warp;

use crate::error::Checks;
use crate::{Generator, SynthError};
use basis::{Octave, Placement};
use gradient::Directions;
use warp::WarpField;

/// How many cells apart the two surfaces of crossed ridges are.
const CROSSING: [f64; 2] = [37.0, 17.0];

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
        self.check(lattice)?;
        let directions = Directions::new();
        let octaves = self.octaves(lattice, seed, &directions);
        let warp = self.warp.map(|warp| WarpField::new(warp, lattice, seed, &directions));
        let width = lattice.width();
        let mut heights = vec![0.0; lattice.node_count()];
        let rows = heights.par_chunks_mut(width).enumerate();
        rows.for_each_init(
            || Scratch::new(width),
            |scratch, (row, heights)| {
                scratch.place(lattice, row);
                if let Some(warp) = &warp {
                    warp.bend(scratch);
                }
                self.row(&octaves, scratch, heights);
            },
        );
        Ok(heights)
    }
}

impl FractalNoise {
    fn check(&self, lattice: &Lattice) -> Result<(), SynthError> {
        let checks = Checks("FractalNoise");
        checks.plane(lattice)?;
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.length("wavelength_m", self.wavelength_m, lattice.spacing())?;
        checks.range("octaves", f64::from(self.octaves), 1.0..=32.0)?;
        checks.range("lacunarity", self.lacunarity, 1.01..=8.0)?;
        checks.range("hurst", self.hurst, 0.0..=2.0)?;
        checks.range("rotation_deg", self.rotation_deg, -360.0..=360.0)?;
        if let Some((name, value)) = self.cascade.parameter() {
            checks.range(name, value, 0.0..=10.0)?;
        }
        self.warp.map_or(Ok(()), |warp| warp.check(&checks, lattice))
    }

    /// The octaves that the lattice can show.
    fn octaves<'a>(
        &self,
        lattice: &Lattice,
        seed: u64,
        directions: &'a Directions,
    ) -> Vec<Octave<'a>> {
        let stream = RandomStream::new(seed, "fractal noise");
        (0..self.octaves)
            .map(|number| Placement {
                number: u64::from(number),
                wavelength: self.wavelength_m / self.lacunarity.powi(number as i32),
                turn_deg: self.rotation_deg * f64::from(number),
                amplitude: self.lacunarity.powf(-self.hurst * f64::from(number)),
            })
            .take_while(|placement| placement.wavelength >= lattice.spacing())
            .map(|placement| Octave::new(self.basis, lattice, &stream, placement, directions))
            .collect()
    }

    /// Heights of a row whose positions are in `scratch`.
    fn row(&self, octaves: &[Octave<'_>], scratch: &mut Scratch, heights: &mut [f64]) {
        let Scratch { positions, points, noise, moved, weights } = scratch;
        let [height, weight] = self.cascade.start();
        heights.fill(height);
        weights.fill(weight);
        for octave in octaves {
            octave.row(positions, [0.0; 2], points, noise);
            if self.shape == OctaveShape::CrossedRidges {
                octave.row(positions, CROSSING, points, moved);
            }
            self.shape.apply(noise, moved);
            self.cascade.add(octave.amplitude, noise, heights, weights);
        }
        for height in heights {
            *height = self.mean_m + self.amplitude_m * *height;
        }
    }
}

/// Memory for the work on a row of nodes.
struct Scratch {
    /// Metres east and north of the south-western node.
    positions: Vec<[f64; 2]>,
    /// The same in cells of an octave.
    points: Vec<[f64; 2]>,
    noise: Vec<f64>,
    moved: Vec<f64>,
    weights: Vec<f64>,
}

impl Scratch {
    fn new(width: usize) -> Self {
        let [noise, moved, weights] = [(); 3].map(|()| vec![0.0; width]);
        let [positions, points] = [(); 2].map(|()| vec![[0.0; 2]; width]);
        Self { positions, points, noise, moved, weights }
    }

    /// Takes the positions of a row of nodes.
    fn place(&mut self, lattice: &Lattice, row: usize) {
        let north = (lattice.height() - 1 - row) as f64 * lattice.spacing();
        for (column, position) in self.positions.iter_mut().enumerate() {
            *position = [column as f64 * lattice.spacing(), north];
        }
    }
}
