//! Fractional Brownian surfaces by spectral synthesis.

use std::f64::consts::TAU;

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rand::RngExt;
use rand_distr::StandardNormal;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use rustfft::FftPlanner;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
        let mut heights = sum_of_waves(self.half_spectrum(size, seed), size);
        heights.par_iter_mut().for_each(|height| *height += self.mean_m);
        Ok(heights)
    }
}

impl SpectralFbm {
    /// Coefficients of the waves with 0 to `width / 2` periods across the width, column after
    /// column. Those with none or the most possible are made symmetric, as a real surface needs.
    fn half_spectrum(&self, [width, height]: [usize; 2], seed: u64) -> Vec<Complex<f64>> {
        let stream = RandomStream::new(seed, "spectral fbm");
        let half = width / 2 + 1;
        let mut columns = vec![Complex::default(); half * height];
        columns.par_chunks_mut(height).enumerate().for_each(|(column, line)| {
            let own_mirror = column == 0 || 2 * column == width;
            for (row, entry) in line.iter_mut().enumerate() {
                let mirrored = own_mirror && 2 * row > height;
                let drawn = if mirrored { height - row } else { row };
                let wave = self.wave(&stream, [column, drawn], [width, height]);
                let alone = own_mirror && (row == 0 || 2 * row == height);
                *entry = match (alone, mirrored) {
                    (true, _) => Complex::new(wave.re, 0.0),
                    (_, true) => wave.conj(),
                    _ => wave,
                };
            }
        });
        columns
    }

    /// Coefficient of one wave.
    fn wave(
        &self,
        stream: &RandomStream,
        [column, row]: [usize; 2],
        [width, height]: [usize; 2],
    ) -> Complex<f64> {
        if column == 0 && row == 0 {
            return Complex::default();
        }
        let side = (width as f64 * height as f64).sqrt();
        let x = column as f64 * (side / width as f64);
        let y = row.min(height - row) as f64 * (side / height as f64);
        let scale = self.amplitude_m * (x * x + y * y).sqrt().powf(-(self.hurst + 1.0));
        let mut random = stream.at(0, column + (width / 2 + 1) * row);
        let gaussian: f64 = random.sample(StandardNormal);
        match self.amplitude_law {
            AmplitudeLaw::RealGaussian => {
                Complex::from_polar(scale, TAU * random.random::<f64>()) * gaussian
            }
            AmplitudeLaw::ComplexGaussian => {
                let other: f64 = random.sample(StandardNormal);
                Complex::new(gaussian, other) * (scale * std::f64::consts::FRAC_1_SQRT_2)
            }
        }
    }
}

/// Adds up the waves whose coefficients are given for half of the plane, column after column.
fn sum_of_waves(mut columns: Vec<Complex<f64>>, [width, height]: [usize; 2]) -> Vec<f64> {
    let along_columns = FftPlanner::<f64>::new().plan_fft_inverse(height);
    columns.par_chunks_mut(height).for_each(|column| along_columns.process(column));
    let along_rows = RealFftPlanner::<f64>::new().plan_fft_inverse(width);
    let mut heights = vec![0.0; width * height];
    heights.par_chunks_mut(width).enumerate().for_each(|(row, line)| {
        let mut waves: Vec<Complex<f64>> =
            (0..=width / 2).map(|column| columns[column * height + row]).collect();
        // Symmetry makes these real; what rounding left would be refused.
        waves[0].im = 0.0;
        if width % 2 == 0 {
            waves[width / 2].im = 0.0;
        }
        along_rows.process(&mut waves, line).expect("the plan was made for rows of this length");
    });
    heights
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    /// The readable reference of [`sum_of_waves`]: every wave and its mirror image, one by one.
    fn sum_by_definition(columns: &[Complex<f64>], [width, height]: [usize; 2]) -> Vec<f64> {
        let mut heights = vec![0.0; width * height];
        for (index, coefficient) in columns.iter().enumerate() {
            let [column, row] = [index / height, index % height];
            let own_mirror = column == 0 || 2 * column == width;
            let share = if own_mirror { 1.0 } else { 2.0 };
            for (node, value) in heights.iter_mut().enumerate() {
                let x = (column * (node % width)) as f64 / width as f64;
                let y = (row * (node / width)) as f64 / height as f64;
                *value += share * (coefficient * Complex::from_polar(1.0, TAU * (x + y))).re;
            }
        }
        heights
    }

    #[test]
    fn the_fast_sum_agrees_with_the_definition() {
        for size in [[8, 8], [7, 5], [6, 9], [16, 3], [2, 5], [1, 6], [6, 1], [1, 1]] {
            let columns = SpectralFbm::default().half_spectrum(size, 3);
            let expected = sum_by_definition(&columns, size);
            let found = sum_of_waves(columns, size);
            let worst = expected.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-12, "{size:?}: {worst}");
        }
    }

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
