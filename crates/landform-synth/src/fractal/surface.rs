//! Fractal noise made ready for one seed: heights at any points.

use landform_sim::random::RandomStream;

use super::basis::{Octave, Placement};
use super::frame::Frame;
use super::slope::Bound;
use super::warp::WarpField;
use super::{FractalNoise, OctaveShape};
use crate::SynthError;

/// How many cells apart the two surfaces of crossed ridges are.
const CROSSING: [f64; 2] = [37.0, 17.0];

/// The octaves of a [`FractalNoise`], with their random numbers.
#[derive(Debug)]
pub(crate) struct NoiseSurface {
    noise: FractalNoise,
    octaves: Vec<Octave>,
    warp: Option<WarpField>,
}

impl NoiseSurface {
    /// The surface of `noise`, with the octaves that `frame` can show.
    ///
    /// # Errors
    /// [`SynthError::OutOfRange`].
    pub fn new(noise: FractalNoise, frame: &Frame, seed: u64) -> Result<Self, SynthError> {
        noise.check(frame)?;
        let stream = RandomStream::new(seed, "fractal noise");
        let octaves = (0..noise.octaves)
            .map(|number| Placement {
                number: u64::from(number),
                wavelength: noise.wavelength_m / noise.lacunarity.powi(number as i32),
                turn_deg: noise.rotation_deg * f64::from(number),
                amplitude: noise.lacunarity.powf(-noise.hurst * f64::from(number)),
            })
            .take_while(|placement| placement.wavelength >= frame.spacing)
            .map(|placement| Octave::new(noise.basis, frame, &stream, placement))
            .collect();
        let warp = noise.warp.map(|warp| WarpField::new(warp, frame, seed));
        Ok(Self { noise, octaves, warp })
    }

    /// Heights at `positions`, in metres east and north of the south-western node, which a warp
    /// moves. `scratch` has room for as many.
    pub fn heights(&self, positions: &mut [[f64; 2]], scratch: &mut Scratch, heights: &mut [f64]) {
        if let Some(warp) = &self.warp {
            warp.bend(positions, scratch);
        }
        let Scratch { points, noise, moved, weights } = scratch;
        let FractalNoise { shape, cascade, .. } = self.noise;
        let [height, weight] = cascade.start();
        heights.fill(height);
        weights.fill(weight);
        for octave in &self.octaves {
            octave.fill(positions, [0.0; 2], points, noise);
            if shape == OctaveShape::CrossedRidges {
                octave.fill(positions, CROSSING, points, moved);
            }
            shape.apply(noise, moved);
            cascade.add(octave.amplitude, noise, heights, weights);
        }
        for height in heights {
            *height = self.noise.mean_m + self.noise.amplitude_m * *height;
        }
    }

    /// Least and greatest height that there can be, and the steepest slope.
    pub fn bound(&self) -> Bound {
        let FractalNoise { shape, cascade, mean_m, amplitude_m, .. } = self.noise;
        let slope = |octave: &Octave| shape.steepness() * octave.steepest;
        let octaves = self.octaves.iter().map(|octave| (octave.amplitude, slope(octave)));
        let Bound { range, slope } = cascade.bound(octaves);
        let bent = 1.0 + self.warp.as_ref().map_or(0.0, WarpField::steepest);
        Bound {
            range: range.map(|height| mean_m + amplitude_m * height),
            slope: amplitude_m * slope * bent,
        }
    }
}

/// Memory for the work on many points.
pub(crate) struct Scratch {
    /// Positions in cells of an octave.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) noise: Vec<f64>,
    pub(super) moved: Vec<f64>,
    pub(super) weights: Vec<f64>,
}

impl Scratch {
    /// Memory for `count` points.
    pub fn new(count: usize) -> Self {
        let [noise, moved, weights] = [(); 3].map(|()| vec![0.0; count]);
        Self { points: vec![[0.0; 2]; count], noise, moved, weights }
    }
}
