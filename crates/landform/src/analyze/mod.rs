//! Analysis of files: everything that [`crate::analysis`] measures of a raster, of lines or of a cave,
//! in one call.
//!
//! [`analyze`] reads a file and measures it; what comes out is printed by [`Analysis::table`],
//! written by [`Analysis::json`] and drawn by [`Analysis::figure`]. The program `landform analyze`
//! does no more than call these.
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

mod cave;
mod figure;
mod lines;
mod notes;
mod raster;
mod shore;
mod slope;
mod spectral;
mod table;
mod terrain;
mod window;

use std::path::{Path, PathBuf};

use landform_analysis::grid::GridError;
use landform_analysis::{DimensionError, PolylineError, ScaleRange};
use landform_io::{IoError, npy};
use landform_sim::code::Code;
use landform_view::ViewError;
use landform_view::plot::Figure;
use serde::Serialize;
use thiserror::Error;

use crate::explain::code_of_file;

pub use cave::{Beside, CaveAnalysis, CaveNumbers};
pub use lines::{LineAnalysis, LineNumbers};
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
    /// Side of the cells in metres, for rasters that do not say it or say something else, and for
    /// volumes, whose voxels have 1 m without it.
    pub spacing_m: Option<f64>,
    /// Least value of the passages of a volume.
    pub at_least: f64,
    /// Largest memory that the analysis of a file may take, in bytes: larger rasters are refused.
    pub memory_bytes: u64,
}

impl Default for Settings {
    /// Usual rulers, the rasters' own cells, passages from 0.5, 8 GiB.
    fn default() -> Self {
        Self { rulers: None, spacing_m: None, at_least: 0.5, memory_bytes: 8 << 30 }
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
        "{source} with --memory-limit-gib: {:.1} GiB may be used, and a cell takes up to \
         {BYTES_A_CELL} bytes",
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
    /// The rulers that were asked for do not suit the lines.
    #[error("{}: {source}", path.display())]
    Rulers {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: DimensionError,
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

impl AnalyzeError {
    /// Its number.
    pub fn code(&self) -> Code {
        match self {
            Self::Read(error) => code_of_file(error),
            Self::Memory { .. } => Code::Memory,
            Self::Grid { .. } => Code::NoSpacing,
            Self::Rulers { .. } => Code::Rulers,
            Self::Line { .. } => Code::DamagedFile,
        }
    }

    /// Why a file could not be read, with the limit if that was too low.
    fn of(error: IoError, memory_bytes: u64) -> Self {
        match error {
            source @ IoError::TooLarge { .. } => Self::Memory { source, memory_bytes },
            other => Self::Read(other),
        }
    }
}

/// What was found out about a file.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Analysis {
    /// A raster of heights.
    Raster(Box<RasterAnalysis>),
    /// Lines.
    Lines(Box<LineAnalysis>),
    /// A cave.
    Cave(Box<CaveAnalysis>),
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
            Self::Lines(lines) => table::lines(&lines.numbers),
            Self::Cave(cave) => table::cave(&cave.numbers),
        }
    }

    /// A figure laid out as figure 4.22 of the thesis: of a raster the map with its streams, a view,
    /// the spectral density and the hypsometric curve; of lines the map, the length by dividers and
    /// the number of boxes; of a cave its plan, its elevations and its measures.
    ///
    /// # Errors
    /// [`ViewError`] for terrains that no picture can show, such as heights beyond 1e12 m.
    pub fn figure(&self) -> Result<Figure, ViewError> {
        match self {
            Self::Raster(raster) => figure::raster_figure(raster),
            Self::Lines(lines) => Ok(figure::lines_figure(lines)),
            Self::Cave(cave) => Ok(figure::cave_figure(cave)),
        }
    }
}

/// Measures the lines of a `.csv`, `.geojson` or `.json` file, the cave of a survey in `.csv`
/// ([`landform_io::read_survey`]) or of a volume in `.npy`, or the raster of any other file.
///
/// # Errors
/// See [`AnalyzeError`].
pub fn analyze(path: &Path, settings: &Settings) -> Result<Analysis, AnalyzeError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if ending == "csv" && landform_io::is_survey(path) {
        return Ok(Analysis::Cave(Box::new(CaveAnalysis::survey(path, settings)?)));
    }
    if ["csv", "geojson", "json"].contains(&ending.as_str()) {
        return Ok(Analysis::Lines(Box::new(LineAnalysis::read(path, settings)?)));
    }
    if ending == "npy" && path.is_file() && npy::read_shape(path).is_ok_and(|axes| axes.len() == 3)
    {
        return Ok(Analysis::Cave(Box::new(CaveAnalysis::voxels(path, settings)?)));
    }
    let terrain = Terrain::read(path, settings)?;
    Ok(Analysis::Raster(Box::new(RasterAnalysis::new(terrain))))
}
