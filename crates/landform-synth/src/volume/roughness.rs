//! Octaves of gradient noise in space.

use landform_sim::random::{RandomStream, unit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::solid::Place3;
use crate::SynthError;
use crate::error::Checks;

/// Octaves of gradient noise in space (Perlin 1985): octave k has the amplitude `amplitude_m / 2^k`
/// and the wavelength `wavelength_m / 2^k`, and random gradients of length 1 at the corners of
/// cubes, blended by the quintic fade. `L_t = 10.75 octaves amplitude_m / wavelength_m` and `max
/// |t| = 2 sqrt 3 amplitude_m` at most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Roughness {
    /// Height of the first octave.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Size of a cube of the first octave.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub wavelength_m: f64,
    /// Number of octaves.
    #[schemars(range(min = 1, max = 12))]
    pub octaves: u32,
}

impl Default for Roughness {
    fn default() -> Self {
        Self { amplitude_m: 1.0, wavelength_m: 10.0, octaves: 3 }
    }
}

/// Largest slope of one octave of amplitude and wavelength 1, at most: 1 from the planes that are
/// blended, and along each axis the steepest fade, 15 / 8 in the middle, times the difference of
/// two planes there, whose corners are `sqrt(1/4 + 1 + 1)` away at most: `1 + sqrt 3 * 15/8 * 3`.
const STEEPEST: f64 = 10.743;

/// Largest value of one octave: the blend of planes through 0 no farther than the corners of a
/// cube.
const LARGEST: f64 = 1.732_050_807_568_877_2;

impl Roughness {
    pub(super) fn check(&self, generator: &'static str) -> Result<(), SynthError> {
        let checks = Checks(generator);
        checks.range("amplitude_m", self.amplitude_m, 0.0..=1e9)?;
        checks.range("wavelength_m", self.wavelength_m, 1e-6..=1e9)?;
        checks.range("octaves", f64::from(self.octaves), 1.0..=12.0)
    }

    /// No value of the noise is farther from 0.
    pub(super) fn largest(&self) -> f64 {
        LARGEST * self.amplitude_m * (2.0 - 0.5_f64.powi(self.octaves as i32 - 1))
    }

    /// Largest change of the noise a metre.
    pub(super) fn slope(&self) -> f64 {
        STEEPEST * self.amplitude_m / self.wavelength_m * f64::from(self.octaves)
    }

    /// The noise at a place.
    pub(super) fn at(&self, stream: &RandomStream, place: Place3) -> f64 {
        let octave = |number: u32| {
            let scale = f64::from(1_u32 << number);
            // No two octaves have their corners, where all are 0, at the same places.
            let [east, north, up, _] = stream.block(u64::MAX, 0, number).map(unit);
            let shift = [east, north, up];
            let place = [0, 1, 2].map(|axis| place[axis] * scale / self.wavelength_m + shift[axis]);
            self.amplitude_m / scale * gradient_noise(stream, number, place)
        };
        (0..self.octaves).map(octave).sum()
    }
}

/// One octave, with cubes of side 1.
fn gradient_noise(stream: &RandomStream, octave: u32, place: Place3) -> f64 {
    let cell = place.map(f64::floor);
    let offset = [0, 1, 2].map(|axis| place[axis] - cell[axis]);
    let fade = offset.map(|t| t * t * t * (t * (6.0 * t - 15.0) + 10.0));
    let mut sum = 0.0;
    for corner in 0..8_u32 {
        let step = [0, 1, 2].map(|axis| f64::from(corner >> axis & 1));
        let at = [0, 1, 2].map(|axis| (cell[axis] + step[axis]) as i64 as u32);
        let gradient = direction(stream, octave, at);
        let plane: f64 = (0..3).map(|axis| gradient[axis] * (offset[axis] - step[axis])).sum();
        let weight =
            (0..3).map(|axis| if step[axis] > 0.0 { fade[axis] } else { 1.0 - fade[axis] });
        sum += weight.product::<f64>() * plane;
    }
    sum
}

/// A random direction, evenly spread over the sphere.
fn direction(stream: &RandomStream, octave: u32, at: [u32; 3]) -> Place3 {
    let words = stream.block(u64::from(at[0]) | u64::from(at[1]) << 32, at[2] as usize, octave);
    let [height, turn] = [words[0], words[1]].map(unit);
    let up = 2.0 * height - 1.0;
    let level = (1.0 - up * up).max(0.0).sqrt();
    let (north, east) = (std::f64::consts::TAU * turn).sin_cos();
    [level * east, level * north, up]
}
