//! Rasters, series of fields, meshes and lines, in and out.
//!
//! | format | read | written | metadata stand in |
//! |---|---|---|---|
//! | GeoTIFF `.tif` ([`geotiff`]) | yes | f64, f32, i16 | the file |
//! | ESRI ASCII `.asc` ([`esri_ascii`]) | yes | every digit | a sidecar |
//! | NumPy `.npy` ([`npy`]) | yes | f64, f32, i32, i16, u8 | a sidecar |
//! | NumPy archive `.npz` ([`npz`]) | its own | whole numbers, f32, f64, texts | the archive |
//! | grey `.png` ([`png16`]) | 8 and 16 bits | 16 bits | the file |
//! | bare f32 `.raw` ([`raw`]) | no | yes | a sidecar |
//! | NetCDF `.nc`, series of fields ([`netcdf`]) | no | f64 | the file |
//! | VTK image data `.vti`, planes and volumes ([`vtk`]) | no | f64 | the file |
//! | OBJ, PLY, GLB, STL ([`mesh`]) | no | yes | the file |
//! | cave surveys `.csv` ([`read_survey`]) | stations, legs | no | - |
//! | CSV `.csv`, GeoJSON `.geojson` ([`lines`]) | lines | no | - |
//!
//! The sidecar of `height.npy` is `height.npy.json` ([`Sidecar`]). Every reader takes
//! [`ReadLimits`], checks sizes before it takes memory, and turns cells without data into NaN;
//! every writer fills a temporary file and renames it, so that no half-written file bears the
//! name ([`atomic`]). Errors name the file, the place in it, what was expected and what to do.
//!
//! ```
//! use landform_io::{IfExists, Metadata, Raster, read_raster, write_raster};
//!
//! let folder = std::env::temp_dir().join(format!("landform_io_doc_{}", std::process::id()));
//! std::fs::create_dir_all(&folder)?;
//! let path = folder.join("height.tif");
//! let raster = Raster::local(3, 2, 10.0, vec![1.0, 2.0, 3.0, 4.0, f64::NAN, 6.0]);
//! let metadata = Metadata { unit: Some("m".into()), seed: Some(7), ..Metadata::default() };
//! write_raster(&path, &raster, &metadata, IfExists::Refuse)?;
//! let again = read_raster(&path)?;
//! assert_eq!(again.spacing_m()?, 10.0);
//! assert_eq!(again.missing_count(), 1);
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod atomic;
mod error;
pub mod esri_ascii;
mod files;
pub mod georeference;
pub mod geotiff;
mod limits;
pub mod lines;
pub mod mesh;
pub mod metadata;
pub mod netcdf;
pub mod npy;
pub mod npz;
#[cfg(feature = "exr")]
pub mod open_exr;
pub mod png16;
mod raster;
pub mod raw;
mod sample;
#[cfg(test)]
#[path = "../tests/support/mod.rs"]
mod scratch;
mod stored;
mod survey;
pub mod vtk;

pub use atomic::{IfExists, write_atomically};
pub use error::{Fault, IoError, Place};
pub use files::{RasterFile, read_raster, read_raster_file, write_raster};
pub use georeference::{
    CoordinateKind, CoordinateSystem, Georeference, Registration, SpacingError,
};
pub use limits::ReadLimits;
pub use lines::{
    Feature, FeatureSystem, Geometry, LineCoordinates, LineFile, LocalPlane, read_lines,
    write_features,
};
pub use mesh::{Body, Mesh, write_mesh, write_meshes};
pub use metadata::{Encoding, Metadata, Sidecar};
pub use raster::Raster;
pub use sample::SampleType;
pub use survey::{SurveyFile, is_survey, read_survey};
