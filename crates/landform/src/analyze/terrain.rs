//! The terrain of a raster file: heights on a grid of metres.

use std::path::Path;

use landform_analysis::grid::Grid;
use landform_io::{RasterFile, ReadLimits, read_raster_file};

use super::notes::Notes;
use super::{AnalyzeError, Settings};

/// Memory that the analysis of a raster takes at most, in bytes a cell, the raster itself
/// included; measured, and rounded up.
pub const BYTES_A_CELL: u64 = 80;

/// Heights of a raster file and the size of its cells on the ground.
#[derive(Clone, Debug)]
pub struct Terrain {
    /// The file as it was named.
    pub file: String,
    /// Shape, and size of a cell in metres: for rasters in degrees at the middle.
    pub grid: Grid,
    /// Heights row by row from the north-west; NaN where there are no data.
    pub heights: Vec<f64>,
    /// Unit of the heights when the file names one.
    pub unit: Option<String>,
    /// Whether the raster lies in degrees.
    pub is_geographic: bool,
    /// What was taken for granted.
    pub(super) notes: Notes,
}

impl Terrain {
    /// Reads a raster file: any format that [`read_raster_file`] knows.
    ///
    /// # Errors
    /// [`AnalyzeError`]: a file that cannot be read, has more cells than memory allows, or whose
    /// cells have no size on the ground.
    pub fn read(path: &Path, settings: &Settings) -> Result<Self, AnalyzeError> {
        let memory_bytes = settings.memory_bytes;
        let most = (memory_bytes / BYTES_A_CELL).min(Grid::MOST_CELLS as u64);
        let file = read_raster_file(path, &ReadLimits { max_cells: most });
        let file = file.map_err(|error| AnalyzeError::of(error, memory_bytes))?;
        Self::of(path, file, settings.spacing_m)
    }

    /// The terrain of a raster that was read; `spacing_m` replaces what it says of its cells.
    ///
    /// # Errors
    /// [`AnalyzeError::Grid`].
    pub fn of(path: &Path, file: RasterFile, spacing_m: Option<f64>) -> Result<Self, AnalyzeError> {
        let mut notes = Notes::default();
        let size = file.raster.size();
        let cell = cell_size_m(&file, spacing_m, &mut notes);
        let grid = Grid::new(size, cell)
            .map_err(|source| AnalyzeError::Grid { path: path.into(), source })?;
        let unit = file.metadata.unit;
        if let Some(unit) = unit.as_ref().filter(|unit| *unit != "m") {
            notes.add("heights", format!("the values are in {unit}, and are taken for metres"));
        }
        let plain = file.encoding.scale == 1.0 && file.encoding.offset == 0.0;
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        if is_png && plain {
            notes.add("heights", "the picture does not say what a grey means, so a step is 1 m");
        }
        let place = file.raster.georeference.as_ref();
        Ok(Self {
            file: path.display().to_string(),
            grid,
            is_geographic: place.is_some_and(|place| place.is_geographic(size)),
            heights: file.raster.values,
            unit,
            notes,
        })
    }
}

impl Terrain {
    /// The level of the sea, if heights lie on both sides of it.
    pub fn sea_m(&self) -> Option<f64> {
        let any = |test: fn(&f64) -> bool| self.heights.iter().any(test);
        (any(|height| *height < 0.0) && any(|height| *height > 0.0)).then_some(0.0)
    }
}

/// Width and height of a cell on the ground.
fn cell_size_m(file: &RasterFile, asked: Option<f64>, notes: &mut Notes) -> [f64; 2] {
    if let Some(spacing) = asked {
        return [spacing; 2];
    }
    let size = file.raster.size();
    let Some(place) = &file.raster.georeference else {
        return [file.metadata.spacing_m.unwrap_or_else(|| {
            notes.add(
                "cells",
                "the raster does not say how large they are, and they are taken for 1 m; \
                 --spacing-m tells",
            );
            1.0
        }); 2];
    };
    let cell = place.ground_cell_size_m(size);
    if place.is_geographic(size) {
        note_narrowing(place.north, place.cell_size[1] * size[1] as f64, notes);
    }
    cell
}

/// Says how much the width of cells in degrees changes from north to south, from 1 % on.
fn note_narrowing(north: f64, height: f64, notes: &mut Notes) {
    let width = |latitude: f64| latitude.to_radians().cos();
    let [top, middle, bottom] = [north, north - 0.5 * height, north - height].map(width);
    let off = (top / middle - 1.0).abs().max((bottom / middle - 1.0).abs());
    if off >= 0.01 {
        notes.add(
            "cells",
            format!(
                "degrees are measured on the ground at the middle latitude; at the northern or \
                 southern edge cells are {:.1} % wider or narrower",
                100.0 * off
            ),
        );
    }
}
