//! Analysis of files: everything that [`crate::analysis`] measures of a raster or of lines, in one
//! call.
//!
//! [`analyze`] reads a file and measures it; what comes out is printed by [`Analysis::table`]
//! and written by [`Analysis::json`]. The program `landform analyze` does no more than call these.
//!
//! ```no_run
//! use landform::analyze::{Analysis, Settings, analyze};
//!
//! let analysis = analyze("valley.tif".as_ref(), &Settings::default())?;
//! if let Analysis::Raster(raster) = &analysis {
//!     println!("integral {:?}", raster.numbers.hypsometry.map(|found| found.integral));
//! }
//! print!("{}", analysis.table());
//! # Ok::<(), landform::analyze::AnalyzeError>(())
//! ```
//!
//! What cannot be measured of a file (the spectrum of a flat terrain, a law of drainage of ten
//! cells) is absent, and [`RasterNumbers::notes`] says why.

mod notes;
mod raster;
mod shore;
mod slope;
mod spectral;
mod table;
mod terrain;
mod window;

use std::path::{Path, PathBuf};

use landform_analysis::PolylineError;
use landform_analysis::ScaleRange;
use landform_analysis::grid::GridError;
use landform_io::IoError;
use serde::Serialize;
use thiserror::Error;

pub use raster::{Dimensions, Heights, RasterAnalysis, RasterNumbers};
pub use shore::Shore;
pub use slope::SlopeQuantiles;
pub use spectral::{PREPARATION, Spectral, SpectralNumbers};
pub use terrain::{BYTES_A_CELL, Terrain};
pub use window::Window;

/// What may be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Rulers of dividers and sides of boxes, for lines; without them [`ScaleRange::usual`].
    pub rulers: Option<ScaleRange>,
    /// Side of the cells in metres, for rasters that do not say it or say something else.
    pub spacing_m: Option<f64>,
    /// Largest memory that the analysis of a file may take, in bytes: larger rasters are refused.
    pub memory_bytes: u64,
}

impl Default for Settings {
    /// Usual rulers, the rasters' own cells, 8 GiB.
    fn default() -> Self {
        Self { rulers: None, spacing_m: None, memory_bytes: 8 << 30 }
    }
}

/// Why a file cannot be analysed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnalyzeError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] IoError),
    /// More cells than memory allows.
    #[error(
        "{source}: analysis takes some {BYTES_A_CELL} bytes a cell, and {:.1} GiB may be used; \
         raise it with --memory-limit-gib",
        *memory_bytes as f64 / f64::from(1 << 30)
    )]
    Memory {
        /// Which file, and how many cells it has.
        source: IoError,
        /// Largest memory that may be used.
        memory_bytes: u64,
    },
    /// The cells of a raster have no size in metres.
    #[error("{}: {source}; give the side of its cells with --spacing-m", path.display())]
    Grid {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: GridError,
    },
    /// The points of a file are no lines.
    #[error("{}: {source}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: PolylineError,
    },
}

/// What was found out about a file.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Analysis {
    /// A raster of heights.
    Raster(Box<RasterAnalysis>),
}

impl Analysis {
    /// The numbers as a JSON object; the book lists its keys.
    pub fn json(&self) -> serde_json::Value {
        // Records of numbers and texts always have a JSON form.
        serde_json::to_value(self).unwrap_or_default()
    }

    /// The numbers for people: a heading and a line for each measure.
    pub fn table(&self) -> String {
        match self {
            Self::Raster(raster) => table::raster(&raster.numbers),
        }
    }
}

/// Measures the raster or the lines of a file.
///
/// # Errors
/// See [`AnalyzeError`].
pub fn analyze(path: &Path, settings: &Settings) -> Result<Analysis, AnalyzeError> {
    let terrain = Terrain::read(path, settings)?;
    Ok(Analysis::Raster(Box::new(RasterAnalysis::new(terrain))))
}
