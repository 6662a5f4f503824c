//! Fractional Brownian surfaces by spectral synthesis.

mod draw;
mod power;
mod sum;
mod waves;

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sum::sum_of_waves;
use waves::Waves;

use crate::error::Checks;
use crate::{Generator, SynthError};

/// How the amplitude of a wave scatters about its mean. Both laws give the same mean power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum AmplitudeLaw {
    /// One Gaussian number times a random phase (Saupe 1988, and the thesis): many waves are
    /// very weak, the logarithm of the amplitude scatters by 1.11.
    #[default]
    RealGaussian,
    /// Two Gaussian numbers as real and imaginary part, as the definition of fractional
    /// Brownian motion demands: the logarithm scatters by 0.64.
    ComplexGaussian,
}

/// A fractional Brownian surface by Saupe's spectral synthesis (thesis, section 2.1.5, figures
/// 2.2 and 2.3).
///
/// The wave of `r` periods per side has an amplitude of `amplitude_m * r^-(H + 1)` times a
/// random number with a mean square of 1, so power falls off as `r^-(2H + 2)`. The heights are
/// the plain sum of the waves: they are not scaled to a range. `side` is that of a square of
/// the same area.
///
/// # Limits
/// 2-D only. The surface repeats along both axes even where the lattice is open: for a surface
/// that does not, take a part of a larger one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpectralFbm {
    /// Mean height.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Root mean square amplitude of a wave of one period per side.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Hurst exponent H: near 0 rough, near 1 smooth. Coastlines at a level have the
    /// dimension 2 - H.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub hurst: f64,
    /// How amplitudes scatter.
    pub amplitude_law: AmplitudeLaw,
}

impl Default for SpectralFbm {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            amplitude_m: 1.0,
            hurst: 0.8,
            amplitude_law: AmplitudeLaw::RealGaussian,
        }
    }
}

impl Generator for SpectralFbm {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("SpectralFbm");
        checks.plane(lattice)?;
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.range("hurst", self.hurst, 0.0..=1.0)?;
        let size = [lattice.width(), lattice.height()];
        Ok(sum_of_waves(Waves::new(self, size, seed).columns(), size, self.mean_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn both_laws_have_the_power_that_the_exponent_says() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([64, 48], 1.0, Connectivity::Four, open).unwrap();
        let size = [64.0_f64, 48.0];
        let side = (size[0] * size[1]).sqrt();
        let signed = |i: usize, n: f64| if i as f64 > n / 2.0 { i as f64 - n } else { i as f64 };
        let expected: f64 = (1..lattice.node_count())
            .map(|i| {
                let x = signed(i % 64, size[0]) * side / size[0];
                let y = signed(i / 64, size[1]) * side / size[1];
                x.hypot(y).powf(-2.0 * (0.5 + 1.0))
            })
            .sum();
        for amplitude_law in [AmplitudeLaw::RealGaussian, AmplitudeLaw::ComplexGaussian] {
            let fbm = SpectralFbm { hurst: 0.5, amplitude_law, ..Default::default() };
            let mean_square: f64 = (0..400)
                .map(|seed| fbm.generate(&lattice, seed).unwrap())
                .map(|heights| heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64)
                .sum::<f64>()
                / 400.0;
            // Ten standard errors: the four longest waves decide.
            assert!((mean_square / expected - 1.0).abs() < 0.35, "{amplitude_law:?}");
        }
    }
}
