//! Everything that is measured of a raster.

use landform_analysis::hydrology::{Depressions, Drainage, FlowDirections, fill_depressions};
use landform_analysis::{Dimension, HypsometricCurve, Hypsometry, Spectrum, variogram_dimension};
use serde::Serialize;

use super::figure::Streams;
use super::notes::Notes;
use super::{Shore, SlopeQuantiles, Spectral, Terrain, Window, shore};

/// The analysis of a raster.
#[derive(Clone, Debug, Serialize)]
pub struct RasterAnalysis {
    /// What was measured.
    #[serde(flatten)]
    pub numbers: RasterNumbers,
    /// The raster.
    #[serde(skip)]
    pub terrain: Terrain,
    /// What figures show beside it.
    #[serde(skip)]
    pub(super) drawn: Drawn,
}

/// What only figures need.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawn {
    /// The hypsometric curve.
    pub curve: Option<HypsometricCurve>,
    /// The prepared spectrum.
    pub spectrum: Option<Spectrum>,
    /// Streams.
    pub streams: Streams,
}

/// The numbers of a raster. What it is too small, too flat or too full of gaps for is `None`.
#[derive(Clone, Debug, Serialize)]
pub struct RasterNumbers {
    /// The file as it was named.
    pub file: String,
    /// `raster`.
    pub kind: &'static str,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Width and height of a cell on the ground; for rasters in degrees at the middle.
    pub cell_m: [f64; 2],
    /// Whether the raster lies in degrees.
    pub geographic: bool,
    /// Cells without data, in per cent.
    pub no_data_percent: f64,
    /// Heights of the cells with data.
    pub heights: Option<Heights>,
    /// The hypsometric curve.
    pub hypsometry: Option<Hypsometry>,
    /// The spectrum.
    pub spectrum: Option<Spectral>,
    /// Fractal dimensions.
    pub dimension: Dimensions,
    /// Slopes in degrees.
    pub slope_deg: Option<SlopeQuantiles>,
    /// Depressions.
    pub depressions: Option<Depressions>,
    /// Laws of drainage over the filled terrain.
    pub drainage: Option<Drainage>,
    /// What is missing and why, what was taken for granted: `part: remark`.
    pub notes: Vec<String>,
}

/// Heights in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Heights {
    /// The lowest.
    pub lowest_m: f64,
    /// The highest.
    pub highest_m: f64,
    /// Mean.
    pub mean_m: f64,
    /// Standard deviation.
    pub deviation_m: f64,
}

/// Fractal dimensions of a terrain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dimensions {
    /// Of the surface, from 2 to 3, by its variogram.
    pub variogram: Option<Dimension>,
    /// Of its shore, or of the line at its median height, from 1 to 2.
    pub shore: Option<Shore>,
}

impl Heights {
    fn of(values: &[f64]) -> Option<Self> {
        let known = || values.iter().copied().filter(|value| !value.is_nan());
        let count = known().count() as f64;
        let mean_m = known().sum::<f64>() / count;
        let variance = known().map(|value| (value - mean_m).powi(2)).sum::<f64>() / count;
        let heights = Self {
            lowest_m: known().fold(f64::INFINITY, f64::min),
            highest_m: known().fold(f64::NEG_INFINITY, f64::max),
            mean_m,
            deviation_m: variance.sqrt(),
        };
        (count > 0.0).then_some(heights)
    }
}

impl RasterAnalysis {
    /// Measures a terrain.
    pub fn new(mut terrain: Terrain) -> Self {
        let mut notes = std::mem::take(&mut terrain.notes);
        let (grid, heights) = (terrain.grid, &terrain.heights);
        let missing = heights.iter().filter(|height| height.is_nan()).count();
        let curve = notes.found("hypsometry", HypsometricCurve::new(heights));
        let window = complete_window(&terrain, missing, &mut notes);
        let water = Water::measure(&terrain, &mut notes);
        let dimension = dimensions(&terrain, window, &mut notes);
        let slope_deg = slope(&terrain, &mut notes);
        // Last, because it takes the most memory and stays.
        let spectrum = window.and_then(|window| {
            let part = window.cut(heights, grid.columns());
            Spectral::measure(&grid, window, part, &mut notes)
        });
        let (found, spectrum) = spectrum.unzip();
        let numbers = RasterNumbers {
            file: terrain.file.clone(),
            kind: "raster",
            size: [grid.columns(), grid.rows()],
            cell_m: grid.cell_size(),
            geographic: terrain.is_geographic,
            no_data_percent: 100.0 * missing as f64 / heights.len() as f64,
            heights: Heights::of(heights),
            hypsometry: curve.as_ref().map(Hypsometry::new),
            spectrum: found,
            dimension,
            slope_deg,
            depressions: water.depressions,
            drainage: water.drainage,
            notes: notes.into_inner(),
        };
        let drawn = Drawn { curve, spectrum, streams: water.streams };
        Self { numbers, terrain, drawn }
    }
}

/// The part of a terrain without gaps, and a remark if that is not the whole.
fn complete_window(terrain: &Terrain, missing: usize, notes: &mut Notes) -> Option<Window> {
    let cells = terrain.grid.cell_count();
    let window = Window::largest_complete(&terrain.grid, &terrain.heights)?;
    if missing > 0 {
        let share = 100.0 * window.cell_count() as f64 / cells as f64;
        let Window { column, row, columns, rows } = window;
        notes.add(
            "spectrum, shore",
            format!(
                "there are gaps; measured on the largest part without any, {columns} x {rows} \
                 cells from column {column}, row {row} ({share:.1} % of the raster)"
            ),
        );
    }
    Some(window)
}

fn dimensions(terrain: &Terrain, window: Option<Window>, notes: &mut Notes) -> Dimensions {
    let (grid, heights) = (&terrain.grid, &terrain.heights);
    let size = [grid.columns(), grid.rows()];
    let variogram = variogram_dimension(heights, size, grid.cell_size());
    let variogram = notes.found("dimension (variogram)", variogram);
    let shore = window.and_then(|window| {
        let mut part = window.cut(heights, grid.columns());
        let level_m = shore::level(&mut part.clone())?;
        let shore = Shore::measure(grid, window, &part, level_m);
        part.clear();
        notes.found("dimension (shore)", shore)
    });
    Dimensions { variogram, shore }
}

fn slope(terrain: &Terrain, notes: &mut Notes) -> Option<SlopeQuantiles> {
    let slope = SlopeQuantiles::measure(&terrain.grid, &terrain.heights);
    let slope = notes.found("slope", slope)?;
    if slope.is_none() {
        notes.add("slope", "no cell has all eight neighbours");
    }
    slope
}

/// Where water stands and flows.
#[derive(Default)]
struct Water {
    depressions: Option<Depressions>,
    drainage: Option<Drainage>,
    streams: Streams,
}

impl Water {
    fn measure(terrain: &Terrain, notes: &mut Notes) -> Self {
        let (grid, heights) = (&terrain.grid, &terrain.heights);
        let Some(filled) = notes.found("depressions", fill_depressions(grid, heights)) else {
            return Self::default();
        };
        let depressions = notes.found("depressions", Depressions::between(grid, heights, &filled));
        let directions = FlowDirections::over_filled(grid, &filled);
        let Some(directions) = notes.found("drainage", directions) else {
            return Self { depressions, ..Self::default() };
        };
        let cells = directions.contributing_cells();
        let drainage = Drainage::along(&directions, &cells, &filled);
        note_missing_laws(&drainage, notes);
        let streams = Streams::new(&directions, &cells, heights, terrain.sea_m());
        Self { depressions, drainage: Some(drainage), streams }
    }
}

/// Says which laws of drainage could not be fitted.
fn note_missing_laws(drainage: &Drainage, notes: &mut Notes) {
    let laws = [
        ("exceedance", drainage.exceedance.is_none()),
        ("hack", drainage.hack.is_none()),
        ("slope_area", drainage.slope_area.is_none()),
    ];
    let missing: Vec<&str> = laws.iter().filter(|(_, none)| *none).map(|(law, _)| *law).collect();
    if !missing.is_empty() {
        let why = "fewer than three bins of contributing area between 16 cells and 5 % of the \
                   largest basin: the terrain is too small, or has no slope";
        notes.add(&format!("drainage ({})", missing.join(", ")), why);
    }
    if drainage.horton.is_none() {
        notes.add("drainage (horton)", "fewer than four orders of streams");
    }
}
