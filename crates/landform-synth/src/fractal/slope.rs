//! How high and how steep sums and cascades of octaves can be.

use super::cascade::{Cascade, OctaveShape};

/// Bounds of a function of the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bound {
    /// Least and greatest value that there can be.
    pub range: [f64; 2],
    /// Largest rise a metre: a Lipschitz constant.
    pub slope: f64,
}

impl OctaveShape {
    /// Bound of the slope of the shape, a function of the noise.
    pub(super) fn steepness(self) -> f64 {
        match self {
            Self::Plain | Self::CrossedRidges => 1.0,
            Self::Turbulence | Self::Ridges => 2.0,
            Self::SharpRidges => 4.0,
        }
    }
}

impl Cascade {
    /// Bounds of the cascade of octaves, given their amplitudes and the bounds of their slopes;
    /// octaves lie between -1 and 1. The rule of products gives slopes, octave by octave.
    pub(super) fn bound(self, octaves: impl Iterator<Item = (f64, f64)>) -> Bound {
        let [start, weight] = self.start();
        let mut height = Bound { range: [start; 2], slope: 0.0 };
        let mut weight = Bound { range: [weight; 2], slope: 0.0 };
        for (amplitude, slope) in octaves {
            let octave = |least: f64, most: f64| Bound {
                range: [amplitude * least, amplitude * most],
                slope: amplitude * slope,
            };
            match self {
                Self::Sum => height = height.plus(octave(-1.0, 1.0)),
                Self::Multiplicative { offset } => {
                    let Bound { range, slope } = octave(-1.0, 1.0);
                    let factor = Bound { range: range.map(|value| offset + value), slope };
                    height = height.times(factor);
                }
                Self::Hybrid { offset } => {
                    let signal = weight.times(octave(offset - 1.0, offset + 1.0));
                    height = height.plus(signal);
                    weight = Bound { range: signal.range.map(|value| value.min(1.0)), ..signal };
                }
                Self::Ridged { gain } => {
                    let signal = weight.times(Bound { range: [0.0, 1.0], slope: 0.5 * slope });
                    height = height.plus(signal.scaled(amplitude));
                    let gained = signal.scaled(gain);
                    weight = Bound { range: gained.range.map(|v| v.clamp(0.0, 1.0)), ..gained };
                }
            }
        }
        height
    }
}

impl Bound {
    /// Bounds of a sum.
    fn plus(self, other: Self) -> Self {
        let range = [0, 1].map(|end| self.range[end] + other.range[end]);
        Self { range, slope: self.slope + other.slope }
    }

    /// Bounds of a product.
    fn times(self, other: Self) -> Self {
        let [a, b] = [self.range, other.range];
        let ends = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
        let range =
            [ends.into_iter().fold(ends[0], f64::min), ends.into_iter().fold(ends[0], f64::max)];
        let most = |[low, high]: [f64; 2]| low.abs().max(high.abs());
        Self { range, slope: self.slope * most(b) + other.slope * most(a) }
    }

    /// Bounds of a multiple; `factor` is not negative.
    fn scaled(self, factor: f64) -> Self {
        Self { range: self.range.map(|value| factor * value), slope: factor * self.slope }
    }
}
