//! Domain distortion: a surface on bent ground.

use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scratch;
use super::basis::{Basis, Octave, Placement};
use super::frame::Frame;
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
    /// `names` are those of amplitude, wavelength and octaves in messages.
    pub(crate) fn check(
        &self,
        checks: &Checks,
        names: [&'static str; 3],
        frame: &Frame,
    ) -> Result<(), SynthError> {
        checks.range(names[0], self.amplitude_m, 0.0..=1e6 * frame.spacing)?;
        checks.length(names[1], self.wavelength_m, frame.spacing)?;
        checks.range(names[2], f64::from(self.octaves), 1.0..=32.0)
    }
}

/// The shifts of a warp, as octaves of noise.
#[derive(Debug)]
pub(crate) struct WarpField {
    /// Those to the east, and those to the north.
    octaves: [Vec<Octave>; 2],
}

impl WarpField {
    pub fn new(warp: Warp, frame: &Frame, seed: u64) -> Self {
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
                .take_while(|placement| placement.wavelength >= frame.spacing)
                .map(|place| Octave::new(Basis::Gradient, frame, &stream, place))
                .collect()
        });
        Self { octaves }
    }

    /// Moves `positions`; `scratch` has room for as many.
    pub fn bend(&self, positions: &mut [[f64; 2]], scratch: &mut Scratch) {
        let Scratch { points, noise, moved, weights } = scratch;
        for (octaves, shifts) in self.octaves.iter().zip([&mut *moved, &mut *weights]) {
            shifts.fill(0.0);
            for octave in octaves {
                octave.fill(positions, [0.0; 2], points, noise);
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

    /// Largest shift along an axis.
    pub fn farthest(&self) -> f64 {
        let farthest = |octaves: &Vec<Octave>| octaves.iter().map(|octave| octave.amplitude).sum();
        self.octaves.iter().map(farthest).fold(0.0, f64::max)
    }

    /// Bound of the distance by which two shifts differ, over the distance of their places.
    pub fn steepest(&self) -> f64 {
        let steepest = |octaves: &Vec<Octave>| -> f64 {
            octaves.iter().map(|octave| octave.amplitude * octave.steepest).sum()
        };
        let [east, north] = self.octaves.each_ref().map(steepest);
        east.hypot(north)
    }
}
