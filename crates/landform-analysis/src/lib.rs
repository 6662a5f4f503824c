//! Measures of terrain: spectra and their fits.
//!
//! A [`Spectrum`] holds the amplitude of every wave of a height field. From it come
//! - [`SpectralFit`]: the two numbers that the thesis prints under each of its spectral plots
//!   (section 2.1.6), with scale-free ones beside them;
//! - [`Spectrum::triple_log_plot`]: the picture that those numbers belong to;
//! - [`RadialSpectrum`]: power by frequency in logarithmic bins and the exponent beta of its
//!   fall-off, which measures the Hurst exponent without bias.
//!
//! A lattice that does not repeat has a step at its borders, which a Fourier transform takes
//! for roughness: [`remove_plane`] and [`taper`] lessen it.

mod detrend;
mod fit;
mod line;
mod radial;
mod spectrum;

pub use detrend::{remove_plane, taper};
pub use fit::SpectralFit;
pub use radial::{PowerBin, RadialExponent, RadialSpectrum};
pub use spectrum::{AnalysisError, Spectrum, Wave};
