//! White noise: every node independent of every other.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rand::RngExt;
use rand_distr::StandardNormal;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Generator, SynthError};

/// How random values are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum Distribution {
    /// Evenly between the mean less and the mean plus the amplitude.
    #[default]
    Uniform,
    /// Along the bell curve, with the amplitude as standard deviation.
    Gaussian,
}

impl Distribution {
    /// A random number with mean 0: between -1 and 1, or of standard deviation 1.
    pub(crate) fn draw(self, stream: &RandomStream, index: usize) -> f64 {
        let mut random = stream.at(0, index);
        match self {
            Self::Uniform => 2.0 * random.random::<f64>() - 1.0,
            Self::Gaussian => random.sample(StandardNormal),
        }
    }

    /// Standard deviation of [`Distribution::draw`].
    pub(crate) fn standard_deviation(self) -> f64 {
        match self {
            Self::Uniform => 1.0 / 3.0_f64.sqrt(),
            Self::Gaussian => 1.0,
        }
    }
}

/// A random value at every node, independent of all others (thesis, figure 3.1: the initial
/// condition of the sand-like model). All frequencies are equally strong.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WhiteNoise {
    /// Mean value.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Greatest distance from the mean, or standard deviation, as the distribution says.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// How the values are spread about the mean.
    pub distribution: Distribution,
    /// Values are rounded to whole multiples of this, so that sand lies in whole slabs; 0 leaves
    /// them as they are.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub step_m: f64,
}

impl Default for WhiteNoise {
    fn default() -> Self {
        Self { mean_m: 0.0, amplitude_m: 1.0, distribution: Distribution::Uniform, step_m: 0.0 }
    }
}

impl Generator for WhiteNoise {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("WhiteNoise");
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.length("step_m", self.step_m, 0.0)?;
        let stream = RandomStream::new(seed, "white noise");
        let value = |node| {
            let value = self.mean_m + self.amplitude_m * self.distribution.draw(&stream, node);
            match self.step_m > 0.0 {
                true => (value / self.step_m).round() * self.step_m,
                false => value,
            }
        };
        Ok((0..lattice.node_count()).into_par_iter().map(value).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn values_are_whole_steps_when_asked() {
        let lattice = Lattice::plane([32, 32], 1.0, Connectivity::Four, [Boundary::Open; 2]);
        let noise = WhiteNoise { mean_m: 6.0, amplitude_m: 6.0, step_m: 3.0, ..Default::default() };
        let values = noise.generate(&lattice.unwrap(), 1).unwrap();
        assert!(values.iter().all(|value| [0.0, 3.0, 6.0, 9.0, 12.0].contains(value)));
        assert!((values.iter().sum::<f64>() / 1024.0 - 6.0).abs() < 0.5);
    }
}
