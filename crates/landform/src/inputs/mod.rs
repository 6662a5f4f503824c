//! Scenario inputs that come from files, rasters and shorelines, and ground of known hypsometry.

mod domain;
mod hypsometric_ground;
mod land_above;
mod raster;
mod scanline;
mod shoreline;

pub use domain::{Gaps, RasterDomain};
pub use hypsometric_ground::{HypsometricGround, KnownCurve};
pub use land_above::LandAbove;
pub use raster::{DomainRaster, RasterFile};
pub use shoreline::ShorelineDomain;
