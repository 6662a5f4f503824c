//! Measures of terrain and of lines.
//!
//! # Spectra
//!
//! A [`Spectrum`] holds the amplitude of every wave of a height field. From it come
//! - [`SpectralFit`]: the two numbers that the thesis prints under each of its spectral plots
//!   (section 2.1.6), with scale-free ones beside them;
//! - [`TripleLogPlot`]: the picture that those numbers belong to;
//! - [`RadialSpectrum`]: power by frequency in logarithmic bins and the exponent beta of its
//!   fall-off, which measures the Hurst exponent without bias.
//!
//! A lattice that does not repeat has a step at its borders, which a Fourier transform takes
//! for roughness: [`remove_plane`] and [`taper`] lessen it.
//!
//! # Hypsometry
//! A [`HypsometricCurve`] holds how much of a terrain lies above each height; [`Hypsometry`]
//! fits Strahler's family of curves to it and names the stage of erosion.
//!
//! # Fractal dimension
//! Of lines, by [`divider_dimension`] and [`box_dimension`]; of the boundary of a set of cells,
//! by [`perimeter_dimension`]; of a height field, by [`variogram_dimension`]; of what grows particle
//! by particle, by [`gyration_dimension`]. The coasts of a raster are [`level_sets`]. Whether a line
//! meets itself say [`self_crossings`].
//!
//! # Drainage
//! [`hydrology`] follows water over a [`grid`](grid::Grid): depressions, flow directions,
//! contributing areas and their scaling laws. [`derivatives`] measures slope, aspect and curvature.
//!
//! # Voxels
//! [`voxels`] thins sets of voxels to centrelines and sheets, tells their topology and makes surfaces of
//! them. [`caves`] measures networks of passages, and indices of the shape of caves.

pub mod caves;
mod creases;
mod crossings;
pub mod derivatives;
mod detrend;
mod dimension;
mod fit;
mod framed;
pub mod grid;
pub mod hydrology;
mod hypsometry;
mod level_set;
mod line;
mod polyline;
mod projection;
mod radial;
mod spectrum;
mod summary;
mod triple_log;
mod valleys;
pub mod voxels;

pub use creases::Creases;
pub use crossings::self_crossings;
pub use detrend::{remove_plane, taper};
pub use dimension::{
    Dimension, DimensionError, RangeError, ScalePoint, ScaleRange, box_dimension,
    divider_dimension, gyration_dimension, perimeter_dimension, variogram_dimension,
};
pub use fit::SpectralFit;
pub use hypsometry::{
    FamilyFit, HypsometricCurve, HypsometricForm, HypsometricStage, Hypsometry, HypsometryError,
    StrahlerCurve,
};
pub use level_set::{LevelSet, LevelSetEdge, LevelSetError, level_sets};
pub use polyline::{Polyline, PolylineError};
pub use projection::on_plane;
pub use radial::{PowerBin, RadialExponent, RadialSpectrum};
pub use spectrum::{AnalysisError, Spectrum, Wave};
pub use summary::SpectralSummary;
pub use triple_log::TripleLogPlot;
pub use valleys::{ValleySpacing, valley_spacing};
