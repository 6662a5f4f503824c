//! Scenario inputs that come from files: rasters and shorelines.

mod domain;
mod land_above;
mod raster;
mod scanline;
mod shoreline;

pub use domain::{Gaps, RasterDomain};
pub use land_above::LandAbove;
pub use raster::{DomainRaster, RasterFile};
pub use shoreline::ShorelineDomain;
