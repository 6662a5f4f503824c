//! Rasters and meshes, in and out.

pub mod atomic;
mod error;
pub mod esri_ascii;
mod files;
pub mod georeference;
pub mod geotiff;
mod limits;
pub mod mesh;
pub mod metadata;
pub mod npy;
pub mod png16;
mod raster;
pub mod raw;
mod sample;
#[cfg(test)]
#[path = "../tests/support/mod.rs"]
mod scratch;
mod stored;

pub use atomic::{IfExists, write_atomically};
pub use error::{Fault, IoError, Place};
pub use files::{RasterFile, read_raster, read_raster_file, write_raster};
pub use georeference::{
    CoordinateKind, CoordinateSystem, Georeference, Registration, SpacingError,
};
pub use limits::ReadLimits;
pub use mesh::{Mesh, write_mesh};
pub use metadata::{Encoding, Metadata, Sidecar};
pub use raster::Raster;
pub use sample::SampleType;
