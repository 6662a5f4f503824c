//! GeoTIFF: TIFF 6.0 with the georeference of OGC 19-008r4 and the metadata of GDAL.
//!
//! Read: one band of whole numbers or floating point, in strips or tiles, bare or compressed
//! (deflate, LZW, PackBits), any predictor, both byte orders, BigTIFF. Rotated rasters and
//! ground control points are refused. Written: deflated strips of f64, f32 or i16, BigTIFF
//! from 3.5 GB on. The coordinate system's keys are kept as they are.

mod gdal;
mod place;
mod read;
mod write;

pub use read::read;
pub use write::{Options, write};
