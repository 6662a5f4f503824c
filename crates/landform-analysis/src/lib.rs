//! Measures of terrain: spectra and their fits.
