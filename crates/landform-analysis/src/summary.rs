//! The numbers of a spectrum, in one record.

use serde::Serialize;

use crate::{AnalysisError, RadialSpectrum, SpectralFit, Spectrum};

/// What a spectrum says about a terrain, as reports give it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SpectralSummary {
    /// Scatter about the fall-off (thesis, section 2.1.6): [`SpectralFit::rms`].
    pub rms: f64,
    /// Coefficient of determination of the fall-off: [`SpectralFit::r_squared`].
    pub r2: f64,
    /// Exponent of the power: [`crate::RadialExponent::beta`].
    pub beta: f64,
    /// Standard error of beta.
    pub beta_error: f64,
}

impl SpectralSummary {
    /// Fits both lines.
    ///
    /// # Errors
    /// [`AnalysisError::TooFewPoints`] for a flat terrain or a lattice of less than 36 x 36
    /// nodes or so, which has too few frequencies between 8 periods a side and half Nyquist.
    pub fn new(spectrum: &Spectrum) -> Result<Self, AnalysisError> {
        let fit = SpectralFit::new(spectrum)?;
        let exponent = RadialSpectrum::usual(spectrum).exponent()?;
        let (beta, beta_error) = (exponent.beta, exponent.beta_error);
        Ok(Self { rms: fit.rms, r2: fit.r_squared, beta, beta_error })
    }
}
