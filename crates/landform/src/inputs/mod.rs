//! Scenario inputs that come from raster files.

mod domain;
mod raster;

pub use domain::{Gaps, RasterDomain};
pub use raster::{DomainRaster, RasterFile};
