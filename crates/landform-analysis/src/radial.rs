//! Power by frequency in logarithmic bins, and the exponent of its fall-off.

use crate::line::Line;
use crate::{AnalysisError, Spectrum, Wave};

/// The waves of one range of frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerBin {
    /// Geometric mean of their frequencies, in periods per side: see [`Wave::frequency`].
    pub frequency: f64,
    /// Mean of their powers, in the squared unit of the heights. The powers of all waves add up
    /// to the mean square of the heights.
    pub power: f64,
    /// Number of independent waves.
    pub waves: usize,
}

/// Power of a terrain by frequency, averaged over all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialSpectrum {
    /// Bins with at least one wave, by increasing frequency.
    pub bins: Vec<PowerBin>,
}

/// Fall-off of power with frequency: `power ~ frequency^-beta`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialExponent {
    /// Exponent: 0 for white noise, 2H + 2 for fractional Brownian surfaces.
    pub beta: f64,
    /// Standard error of beta, from the scatter of the bins about the line.
    pub beta_error: f64,
    /// Coefficient of determination of the line through the bins.
    pub r_squared: f64,
}

impl RadialExponent {
    /// Hurst exponent H of a fractional Brownian surface with this fall-off. Values outside 0
    /// to 1 say that the terrain is none.
    pub fn hurst(&self) -> f64 {
        self.beta / 2.0 - 1.0
    }
}

impl RadialSpectrum {
    /// Number of bins that is usual for a fit.
    pub const USUAL_BINS: usize = 15;

    /// Sorts the waves with frequencies from `lowest` to `highest` (periods per side) into `bins`
    /// bins of equal logarithmic width. Waves outside the range are left out; a range that holds
    /// none gives no bins.
    pub fn new(spectrum: &Spectrum, bins: usize, [lowest, highest]: [f64; 2]) -> Self {
        let ranged = lowest > 0.0 && highest > lowest && highest.is_finite();
        let bins = if ranged { bins } else { 0 };
        let nodes = spectrum.size().iter().product::<usize>() as f64;
        let width = (highest / lowest).ln() / bins as f64;
        let mut sums = vec![Sums::default(); bins];
        for wave in spectrum.waves() {
            if bins > 0 && (lowest..=highest).contains(&wave.frequency) {
                let bin = ((wave.frequency / lowest).ln() / width) as usize;
                sums[bin.min(bins - 1)].add(wave, nodes);
            }
        }
        Self { bins: sums.iter().filter(|sums| sums.waves > 0).map(Sums::mean).collect() }
    }

    /// The bins that measure the exponent of fractional Brownian surfaces best: 15 from 8
    /// periods per side to half the Nyquist frequency. Below, single waves decide; above, the
    /// lattice does.
    pub fn usual(spectrum: &Spectrum) -> Self {
        Self::new(spectrum, Self::USUAL_BINS, [8.0, spectrum.half_nyquist()])
    }

    /// Fits the exponent by least squares through the logarithms of the bins, each counting
    /// the same.
    ///
    /// # Errors
    /// [`AnalysisError::TooFewPoints`] if fewer than three bins hold any power.
    pub fn exponent(&self) -> Result<RadialExponent, AnalysisError> {
        let logarithms: Vec<[f64; 2]> = self
            .bins
            .iter()
            .filter(|bin| bin.power > 0.0)
            .map(|bin| [bin.frequency.ln(), bin.power.ln()])
            .collect();
        let points = logarithms.len();
        let line = Line::through(&logarithms).ok_or(AnalysisError::TooFewPoints { points })?;
        let Line { slope, slope_error, r_squared, .. } = line;
        Ok(RadialExponent { beta: -slope, beta_error: slope_error, r_squared })
    }
}

/// What the mean of a bin is made of.
#[derive(Clone, Debug, Default)]
struct Sums {
    log_frequency: f64,
    power: f64,
    waves: usize,
}

impl Sums {
    fn add(&mut self, wave: Wave, nodes: f64) {
        self.log_frequency += wave.frequency.ln();
        self.power += wave.amplitude * wave.amplitude / nodes;
        self.waves += 1;
    }

    fn mean(&self) -> PowerBin {
        let count = self.waves as f64;
        let frequency = (self.log_frequency / count).exp();
        PowerBin { frequency, power: self.power / count, waves: self.waves }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    fn spectrum(size: [usize; 2]) -> Spectrum {
        let lattice =
            Lattice::plane(size, 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap();
        let spike: Vec<f64> =
            (0..lattice.node_count()).map(|node| f64::from(u8::from(node == 3))).collect();
        Spectrum::new(&lattice, &spike).unwrap()
    }

    /// All waves of a spike of height 1 have the power 1 / nodes^2.
    #[test]
    fn a_spike_has_the_same_power_everywhere() {
        let radial = RadialSpectrum::usual(&spectrum([128, 96]));
        assert_eq!(radial.bins.len(), RadialSpectrum::USUAL_BINS);
        let nodes: f64 = 128.0 * 96.0;
        assert!(radial.bins.iter().all(|bin| (bin.power * nodes * nodes - 1.0).abs() < 1e-9));
        let exponent = radial.exponent().unwrap();
        assert!(exponent.beta.abs() < 1e-9, "{exponent:?}");
    }

    #[test]
    fn useless_ranges_give_no_bins() {
        let spectrum = spectrum([16, 16]);
        for range in [[0.0, 4.0], [4.0, 2.0], [-1.0, 4.0], [f64::NAN, 4.0], [1.0, f64::INFINITY]] {
            let radial = RadialSpectrum::new(&spectrum, 5, range);
            assert!(radial.bins.is_empty(), "{range:?}");
            assert_eq!(radial.exponent(), Err(AnalysisError::TooFewPoints { points: 0 }));
        }
        assert!(RadialSpectrum::new(&spectrum, 0, [1.0, 4.0]).bins.is_empty());
    }
}
