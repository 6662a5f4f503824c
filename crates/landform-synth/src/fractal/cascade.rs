//! How octaves are shaped and put together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is done to the noise `n` of every octave. All shapes stay between -1 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum OctaveShape {
    /// Nothing: n.
    #[default]
    Plain,
    /// 2 |n| - 1, Perlin's turbulence: rounded tops and sharp valleys.
    Turbulence,
    /// 1 - 2 |n|: sharp ridges where the noise is 0.
    Ridges,
    /// 2 (1 - |n|)^2 - 1: sharper ridges, wider valleys.
    SharpRidges,
    /// The lesser of n and n moved by some cells: ridges where both meet.
    CrossedRidges,
}

impl OctaveShape {
    /// Shapes a row of noise. `moved` is the same noise elsewhere, for crossed ridges.
    pub(super) fn apply(self, noise: &mut [f64], moved: &[f64]) {
        let each = |noise: &mut [f64], shape: fn(f64) -> f64| {
            noise.iter_mut().for_each(|value| *value = shape(*value));
        };
        match self {
            Self::Plain => {}
            Self::Turbulence => each(noise, |n| 2.0 * n.abs() - 1.0),
            Self::Ridges => each(noise, |n| 1.0 - 2.0 * n.abs()),
            Self::SharpRidges => each(noise, |n| 2.0 * (1.0 - n.abs()).powi(2) - 1.0),
            Self::CrossedRidges => {
                noise.iter_mut().zip(moved).for_each(|(value, &other)| *value = value.min(other));
            }
        }
    }
}

/// How the octaves `s_k` with amplitudes `a_k = lacunarity^(-H k)` become one height.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Cascade {
    /// The sum of `a_k s_k`: fractional Brownian motion, equally rough everywhere.
    #[default]
    Sum,
    /// The product of `offset + a_k s_k`, a multiplicative multifractal: rough where it is high,
    /// smooth where it is low. Musgrave's listing has `a_k` outside of the bracket, where it
    /// scales the whole height and makes nothing smoother.
    Multiplicative {
        /// Mean of a factor: larger ones are closer to a sum.
        #[schemars(range(min = 0.0, max = 10.0))]
        offset: f64,
    },
    /// Musgrave's hybrid multifractal: the sum of `w_k a_k (s_k + offset)`, where the weight
    /// `w_k` is the product of the earlier terms' `a_k (s_k + offset)`, each product at most 1.
    /// Valleys are smooth and peaks rough at every scale.
    Hybrid {
        /// Added to every octave: 0.7 gives smooth valleys.
        #[schemars(range(min = 0.0, max = 10.0))]
        offset: f64,
    },
    /// Musgrave's ridged multifractal, with octaves of `SharpRidges`: the sum of `a_k g_k`, where
    /// `g_k = w_k (s_k + 1) / 2` and the weight `w_k` is `gain g_(k-1)`, from 0 to 1. Ridges
    /// carry smaller ridges, slopes and valleys few.
    Ridged {
        /// How far fine ridges reach down from coarse ones; Musgrave uses 2.
        #[schemars(range(min = 0.0, max = 10.0))]
        gain: f64,
    },
}

impl Cascade {
    /// Number to be checked, with its name.
    pub(super) fn parameter(self) -> Option<(&'static str, f64)> {
        match self {
            Self::Sum => None,
            Self::Multiplicative { offset } | Self::Hybrid { offset } => {
                Some(("cascade.offset", offset))
            }
            Self::Ridged { gain } => Some(("cascade.gain", gain)),
        }
    }

    /// Height and weight before the first octave.
    pub(super) fn start(self) -> [f64; 2] {
        match self {
            Self::Multiplicative { .. } => [1.0, 1.0],
            _ => [0.0, 1.0],
        }
    }

    /// Adds a row of an octave to heights and weights.
    pub(super) fn add(
        self,
        amplitude: f64,
        octave: &[f64],
        heights: &mut [f64],
        weights: &mut [f64],
    ) {
        let nodes = heights.iter_mut().zip(weights).zip(octave);
        match self {
            Self::Sum => nodes.for_each(|((height, _), s)| *height += amplitude * s),
            Self::Multiplicative { offset } => {
                nodes.for_each(|((height, _), s)| *height *= offset + amplitude * s);
            }
            Self::Hybrid { offset } => nodes.for_each(|((height, weight), s)| {
                let signal = amplitude * (s + offset);
                *height += *weight * signal;
                *weight = (*weight * signal).min(1.0);
            }),
            Self::Ridged { gain } => nodes.for_each(|((height, weight), s)| {
                let signal = *weight * 0.5 * (s + 1.0);
                *height += amplitude * signal;
                *weight = (gain * signal).clamp(0.0, 1.0);
            }),
        }
    }
}
