//! Metrics that need more than the framework: spectra.

mod spectral;

pub use spectral::SpectralFalloff;
