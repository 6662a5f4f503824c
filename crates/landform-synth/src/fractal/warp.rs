//! Domain distortion: a surface on bent ground.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scratch;
use super::basis::{Basis, Octave, Placement};
use super::gradient::Directions;
use crate::SynthError;
use crate::error::Checks;

/// Moves every point by smooth noise before the surface is looked up there (domain distortion,
/// or warping): straight things bend, cells get torn.
///
/// East and north shift are sums of octaves of gradient noise, each with half the wavelength
/// and half the amplitude of the one before.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Warp {
    /// Distance along an axis by which the first octave moves a point at most: up to a million
    /// spacings.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Size of a cell of the first octave: at least the spacing.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub wavelength_m: f64,
    /// Number of octaves.
    #[schemars(range(min = 1, max = 32))]
    pub octaves: u32,
}

impl Default for Warp {
    fn default() -> Self {
        Self { amplitude_m: 300.0, wavelength_m: 1000.0, octaves: 3 }
    }
}

impl Warp {
    pub(super) fn check(&self, checks: &Checks, lattice: &Lattice) -> Result<(), SynthError> {
        let spacing = lattice.spacing();
        checks.range("warp.amplitude_m", self.amplitude_m, 0.0..=1e6 * spacing)?;
        checks.length("warp.wavelength_m", self.wavelength_m, spacing)?;
        checks.range("warp.octaves", f64::from(self.octaves), 1.0..=32.0)
    }
}

/// The shifts of a warp, as octaves of noise.
pub(super) struct WarpField<'a> {
    /// Those to the east, and those to the north.
    octaves: [Vec<Octave<'a>>; 2],
}

impl<'a> WarpField<'a> {
    pub fn new(warp: Warp, lattice: &Lattice, seed: u64, directions: &'a Directions) -> Self {
        let octaves = ["warp east", "warp north"].map(|name| {
            let stream = RandomStream::new(seed, name);
            (0..warp.octaves)
                .map(|number| (number, 0.5_f64.powi(number as i32)))
                .map(|(number, share)| Placement {
                    number: u64::from(number),
                    wavelength: warp.wavelength_m * share,
                    turn_deg: 0.0,
                    amplitude: warp.amplitude_m * share,
                })
                .take_while(|placement| placement.wavelength >= lattice.spacing())
                .map(|place| Octave::new(Basis::Gradient, lattice, &stream, place, directions))
                .collect()
        });
        Self { octaves }
    }

    /// Moves the positions of a row.
    pub fn bend(&self, scratch: &mut Scratch) {
        let Scratch { positions, points, noise, moved, weights } = scratch;
        for (octaves, shifts) in self.octaves.iter().zip([&mut *moved, &mut *weights]) {
            shifts.fill(0.0);
            for octave in octaves {
                octave.row(positions, [0.0; 2], points, noise);
                shifts
                    .iter_mut()
                    .zip(&*noise)
                    .for_each(|(shift, n)| *shift += octave.amplitude * n);
            }
        }
        for (position, (east, north)) in positions.iter_mut().zip(moved.iter().zip(&*weights)) {
            *position = [position[0] + east, position[1] + north];
        }
    }
}
