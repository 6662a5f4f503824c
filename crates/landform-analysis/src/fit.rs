//! The spectral fit of the thesis: how straight the fall-off of a spectrum is.

use crate::line::Line;
use crate::{AnalysisError, Spectrum, Wave};

/// How well the spectrum of a terrain falls off along a straight line in the triple-log plot
/// (thesis, section 2.1.6).
///
/// 1. The data are `x = ln r`, `y = ln z` for every independent wave, with `r` its frequency
///    and `z` its amplitude. The nine waves in the centre of the plot (at most one period across
///    either axis) are left out, and so are those with `z` below [`SpectralFit::FLOOR`].
/// 2. `y = A + B x` is fitted by least squares, every wave counting the same.
/// 3. Scaling both axes (`y / A`, `-x B / A`) takes that line to `1 - x`.
/// 4. The line is fitted again: because a scaling keeps least squares, it is `1 - x` itself.
/// 5. RMS is the root mean square distance from it and R2 the coefficient of determination.
///
/// The thesis found RMS in 0.199-0.223 and R2 in 0.331-0.526 for 33 fractional Brownian
/// surfaces with Hurst exponents of 0.5 to 0.98. Those ranges hold for one amplitude law: a real
/// Gaussian number times a random phase. Terrains made in other ways scatter less, and look
/// "less noisy".
///
/// # Limits
/// RMS depends on the unit of the heights (it is `scatter_nats / intercept`), so compare it only
/// between terrains with the same standard deviation. R2 depends on the unit only through the
/// floor, [`SpectralFit::r_squared_unfloored`] and the slope not at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralFit {
    /// Root mean square distance from the line, in units of its height at frequency 1.
    pub rms: f64,
    /// Coefficient of determination, 0 for no fall-off to 1 for a perfect one.
    pub r_squared: f64,
    /// Number of waves that the line was fitted to.
    pub points: usize,
    /// Waves left out because of the floor, as a share of those outside the centre.
    pub rejected_share: f64,
    /// `A`: natural logarithm of the line's amplitude at frequency 1.
    pub intercept: f64,
    /// `B`: slope of amplitude against frequency; -(H + 1) for fractional Brownian surfaces.
    pub slope: f64,
    /// Root mean square of the residuals of `ln z`: 1.11 for a real Gaussian amplitude law, 0.64
    /// for a complex one.
    pub scatter_nats: f64,
    /// Coefficient of determination when every wave with an amplitude above 0 counts.
    pub r_squared_unfloored: f64,
}

impl SpectralFit {
    /// Amplitudes below this are left out of the fit (the thesis' epsilon).
    pub const FLOOR: f64 = 0.001;

    /// Fits the line.
    ///
    /// # Errors
    /// [`AnalysisError::TooFewPoints`] if fewer than three waves are left or they all have the
    /// same frequency, as for a flat terrain.
    ///
    /// # Example
    /// ```
    /// use landform_analysis::{SpectralFit, Spectrum};
    /// use landform_graph::{Boundary, Connectivity, Lattice};
    ///
    /// let lattice = Lattice::plane([64, 64], 1.0, Connectivity::Eight, [Boundary::Periodic; 2])?;
    /// let spike: Vec<f64> = (0..64 * 64).map(|node| f64::from(node == 0)).collect();
    /// let fit = SpectralFit::new(&Spectrum::new(&lattice, &spike)?)?;
    /// assert!(fit.r_squared < 1e-6, "a spike has all frequencies alike");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(spectrum: &Spectrum) -> Result<Self, AnalysisError> {
        let waves: Vec<Wave> = spectrum.waves().filter(outside_centre).collect();
        let kept = logarithms(&waves, Self::FLOOR);
        let points = kept.len();
        let line = Line::through(&kept).ok_or(AnalysisError::TooFewPoints { points })?;
        let unfloored = Line::through(&logarithms(&waves, f64::MIN_POSITIVE));
        Ok(Self {
            rms: line.scatter / line.intercept.abs(),
            r_squared: line.r_squared,
            points,
            rejected_share: (waves.len() - points) as f64 / waves.len() as f64,
            intercept: line.intercept,
            slope: line.slope,
            scatter_nats: line.scatter,
            r_squared_unfloored: unfloored.map_or(line.r_squared, |line| line.r_squared),
        })
    }
}

/// Whether a wave lies outside the 3 x 3 centre of the plot.
fn outside_centre(wave: &Wave) -> bool {
    wave.periods.iter().any(|periods| periods.abs() > 1)
}

fn logarithms(waves: &[Wave], floor: f64) -> Vec<[f64; 2]> {
    waves
        .iter()
        .filter(|wave| wave.amplitude >= floor)
        .map(|wave| [wave.frequency.ln(), wave.amplitude.ln()])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    fn lattice() -> Lattice {
        Lattice::plane([32, 32], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap()
    }

    #[test]
    fn a_flat_terrain_has_no_fit() {
        let spectrum = Spectrum::new(&lattice(), &[7.0; 1024]).unwrap();
        let refused = SpectralFit::new(&spectrum).unwrap_err();
        assert_eq!(refused, AnalysisError::TooFewPoints { points: 0 });
    }

    #[test]
    fn a_change_of_unit_keeps_slope_and_scatter_and_moves_rms() {
        let heights: Vec<f64> = (0..1024).map(|i| f64::from(i * i * 7 % 101)).collect();
        let scaled: Vec<f64> = heights.iter().map(|height| height * 100.0).collect();
        let fit = |heights: &[f64]| {
            SpectralFit::new(&Spectrum::new(&lattice(), heights).unwrap()).unwrap()
        };
        let [metres, centimetres] = [fit(&heights), fit(&scaled)];
        assert!((metres.slope - centimetres.slope).abs() < 1e-9);
        assert!((metres.scatter_nats - centimetres.scatter_nats).abs() < 1e-9);
        let shift = centimetres.intercept - metres.intercept;
        assert!((shift - 100.0_f64.ln()).abs() < 1e-9);
        assert!(centimetres.rms < metres.rms);
    }
}
