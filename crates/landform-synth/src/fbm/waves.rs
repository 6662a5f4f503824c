//! Random coefficients of the waves of a spectrum.

use landform_sim::random::RandomStream;
use rayon::prelude::*;
use realfft::num_complex::Complex;

use super::draw::{circle, radius};
use super::power::Power;
use super::{AmplitudeLaw, SpectralFbm};

/// Blocks of random words that are made into waves together, two waves a block.
const BLOCKS: usize = 32;

/// The waves of a surface with a power law, by their periods across the width and the height.
#[derive(Debug)]
pub(super) struct Waves {
    size: [usize; 2],
    /// Frequency of one period across the width and the height, in periods a side.
    unit: [f64; 2],
    amplitude: f64,
    law: AmplitudeLaw,
    /// From the square of a frequency to the amplitude.
    fall: Power,
    stream: RandomStream,
}

impl Waves {
    pub fn new(fbm: &SpectralFbm, size: [usize; 2], seed: u64) -> Self {
        let side = (size[0] as f64 * size[1] as f64).sqrt();
        Self {
            size,
            unit: size.map(|count| side / count as f64),
            amplitude: fbm.amplitude_m,
            law: fbm.amplitude_law,
            fall: Power::new(-0.5 * (fbm.hurst + 1.0)),
            stream: RandomStream::new(seed, "spectral fbm"),
        }
    }

    /// Coefficients of the waves with 0 to `width / 2` periods across the width, column after
    /// column. Those with none or the most possible are made symmetric, as a real surface needs.
    pub fn columns(&self) -> Vec<Vec<Complex<f64>>> {
        let [width, height] = self.size;
        let column = |column: usize| {
            let mut waves = self.column(column);
            if column == 0 {
                waves[0] = Complex::default();
            }
            if column == 0 || 2 * column == width {
                for row in 0..=height / 2 {
                    match row == 0 || 2 * row == height {
                        true => waves[row].im = 0.0,
                        false => waves[height - row] = waves[row].conj(),
                    }
                }
            }
            waves
        };
        (0..width / 2 + 1).into_par_iter().map(column).collect()
    }

    /// Coefficients of a column, each independent of all others.
    fn column(&self, column: usize) -> Vec<Complex<f64>> {
        let height = self.size[1];
        let scales = self.scales(column);
        let blocks = height.div_ceil(2);
        let mut waves = Vec::with_capacity(height);
        let mut drawn = [[0.0; 4]; BLOCKS];
        for first in (0..blocks).step_by(BLOCKS) {
            let count = BLOCKS.min(blocks - first);
            let words: [[u32; 4]; BLOCKS] = std::array::from_fn(|block| {
                self.stream.block(0, column * blocks + first + block, 0)
            });
            self.draw(&words, &mut drawn);
            let entries = drawn[..count].iter().flat_map(|&[a, b, c, d]| [[a, b], [c, d]]);
            waves.extend(
                entries
                    .zip(2 * first..height)
                    .map(|([re, im], row)| Complex::new(re, im) * scales[row.min(height - row)]),
            );
        }
        waves
    }

    /// Root mean square amplitudes of the waves of a column with 0 to `height / 2` periods.
    fn scales(&self, column: usize) -> Vec<f64> {
        let x = column as f64 * self.unit[0];
        let square = |row: usize| x * x + (row as f64 * self.unit[1]).powi(2);
        (0..=self.size[1] / 2).map(|row| self.amplitude * self.fall.of(square(row))).collect()
    }

    /// Two complex numbers of a mean square of 1 from each block of words.
    fn draw(&self, words: &[[u32; 4]; BLOCKS], drawn: &mut [[f64; 4]; BLOCKS]) {
        let pairs = words.iter().zip(drawn);
        match self.law {
            // The coordinates of one normal point are the amplitudes of both waves.
            AmplitudeLaw::RealGaussian => pairs.for_each(|(words, drawn)| {
                let length = radius(words[0]);
                let [first, second] = circle(words[1]).map(|share| length * share);
                let [a, b] = circle(words[2]);
                let [c, d] = circle(words[3]);
                *drawn = [first * a, first * b, second * c, second * d];
            }),
            AmplitudeLaw::ComplexGaussian => pairs.for_each(|(words, drawn)| {
                let [first, second] =
                    [words[0], words[2]].map(|word| radius(word) * std::f64::consts::FRAC_1_SQRT_2);
                let [a, b] = circle(words[1]);
                let [c, d] = circle(words[3]);
                *drawn = [first * a, first * b, second * c, second * d];
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// The readable reference of [`Waves::columns`] where a wave is no mirror image, by the
    /// library's functions.
    fn by_definition(waves: &Waves, hurst: f64, column: usize, row: usize) -> Complex<f64> {
        let [width, height] = waves.size.map(|count| count as f64);
        let side = (width * height).sqrt();
        let x = column as f64 * side / width;
        let y = (row as f64).min(height - row as f64) * side / height;
        let scale = waves.amplitude * x.hypot(y).powf(-hurst - 1.0);
        let block = column * waves.size[1].div_ceil(2) + row / 2;
        let words = waves.stream.block(0, block, 0);
        let normal = |word: u32| (-2.0 * ((f64::from(word) + 0.5) / 2.0_f64.powi(32)).ln()).sqrt();
        let angle = |word: u32| {
            let place = (f64::from(word & 0x3FFF_FFFF) + 0.5) / 2.0_f64.powi(30) - 0.5;
            let quarter = if word >> 30 & 1 == 0 { place } else { 1.0 - place };
            FRAC_PI_2 * quarter + if word >> 31 == 0 { 0.0 } else { TAU / 2.0 }
        };
        let odd = row % 2;
        match waves.law {
            AmplitudeLaw::RealGaussian => {
                let turn = angle(words[1]) - FRAC_PI_2 * odd as f64;
                let gaussian = normal(words[0]) * turn.cos();
                Complex::from_polar(scale * gaussian, angle(words[2 + odd]))
            }
            AmplitudeLaw::ComplexGaussian => {
                let length = normal(words[2 * odd]) / 2.0_f64.sqrt();
                Complex::from_polar(scale * length, angle(words[2 * odd + 1]))
            }
        }
    }

    #[test]
    fn waves_are_those_of_the_definition() {
        for law in [AmplitudeLaw::RealGaussian, AmplitudeLaw::ComplexGaussian] {
            for size in [[7, 5], [12, 150], [3, 64]] {
                let fbm = SpectralFbm { hurst: 0.7, amplitude_law: law, ..Default::default() };
                let waves = Waves::new(&fbm, size, 5);
                for (column, drawn) in waves.columns().iter().enumerate() {
                    if column == 0 || 2 * column == size[0] {
                        continue;
                    }
                    for (row, wave) in drawn.iter().enumerate() {
                        let expected = by_definition(&waves, 0.7, column, row);
                        let error = (wave - expected).norm();
                        assert!(error < 1e-12 * (1.0 + expected.norm()), "{column}, {row}");
                    }
                }
            }
        }
    }

    /// Waves without periods across the width, or with the most, are their own mirror images.
    #[test]
    fn the_surface_is_real() {
        for size in [[6, 5], [6, 8], [5, 8], [1, 1]] {
            let columns = Waves::new(&SpectralFbm::default(), size, 2).columns();
            assert_eq!(columns[0][0], Complex::default());
            for column in (0..columns.len()).filter(|&c| c == 0 || 2 * c == size[0]) {
                for (row, wave) in columns[column].iter().enumerate() {
                    assert_eq!(columns[column][(size[1] - row) % size[1]], wave.conj());
                }
            }
        }
    }
}
