//! A raster in memory.

use std::path::Path;

use crate::georeference::SpacingError;
use crate::{Fault, Georeference, IoError, Place};

/// A grid of numbers with its place on the map.
///
/// `values[x + width * y]` is the cell of column `x` (from the west) and row `y` (row 0 is the
/// **north**): the node order of `landform_graph::Lattice`. A cell without data is NaN,
/// whatever its file writes there; every other cell is finite. A simulation wants a
/// [`complete`](Self::complete) raster.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// `width * height` values, row by row from the north-west; NaN where there are no data.
    pub values: Vec<f64>,
    /// The number that stands for missing data in the file; it is used again on writing.
    pub no_data: Option<f64>,
    /// Where the raster lies; `None` when its file does not say.
    pub georeference: Option<Georeference>,
}

/// Larger magnitudes are no measurement: undeclared no-data marks, or bytes in wrong order.
const ABSURD: f64 = 1e30;

impl Raster {
    /// A raster of a simulated field on square cells of `spacing_m` metres.
    pub fn local(width: usize, height: usize, spacing_m: f64, values: Vec<f64>) -> Self {
        let georeference = Some(Georeference::local(height, spacing_m));
        Self { width, height, values, no_data: None, georeference }
    }

    /// Number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The spacing of square cells in metres.
    ///
    /// # Errors
    /// See [`SpacingError`]; [`Georeference::ground_cell_size_m`] helps with degrees.
    pub fn spacing_m(&self) -> Result<f64, SpacingError> {
        self.georeference.as_ref().ok_or(SpacingError::Unknown)?.spacing_m(self.size())
    }

    /// Number of cells without data.
    pub fn missing_count(&self) -> usize {
        self.values.iter().filter(|value| value.is_nan()).count()
    }

    /// Least and greatest value, without missing cells; `None` when all are missing.
    pub fn range(&self) -> Option<[f64; 2]> {
        let first = self.values.iter().copied().find(|value| !value.is_nan())?;
        Some(
            self.values
                .iter()
                .fold([first; 2], |[least, most], &value| [least.min(value), most.max(value)]),
        )
    }

    /// Passes when no cell is missing.
    ///
    /// # Errors
    /// Names the first missing cell, how many there are and what to do.
    pub fn complete(&self, path: &Path) -> Result<(), IoError> {
        let Some(first) = self.values.iter().position(|value| value.is_nan()) else {
            return Ok(());
        };
        let problem = format!("no data here and in {} cells in all", self.missing_count());
        let advice = "fill the gaps, or cut out a part without gaps";
        let fault = Fault::new(problem, "a value in every cell", advice);
        Err(fault.at(self.place(first)).reading(path))
    }

    /// Checks what was read: sizes, at least one value, no infinite or absurd ones.
    pub(crate) fn checked(self) -> Result<Self, Fault> {
        self.check_size()?;
        let absurd = |value: &f64| value.abs() > ABSURD;
        if let Some(cell) = self.values.iter().position(absurd) {
            let problem = format!("the value is {:e}", self.values[cell]);
            let advice = "declare it as no data, or correct it";
            let expected = format!("magnitudes up to {ABSURD:e}");
            return Err(Fault::new(problem, expected, advice).at(self.place(cell)));
        }
        if self.values.iter().all(|value| value.is_nan()) {
            let problem = format!("all {} cells are without data", self.values.len());
            let advice = "check the no-data value and the conversion that made the file";
            return Err(Fault::new(problem, "at least one number", advice));
        }
        Ok(self)
    }

    /// Checks that the values fill the size, which has at least one cell.
    pub(crate) fn check_size(&self) -> Result<(), Fault> {
        let [width, height] = self.size();
        if self.values.is_empty() || width.checked_mul(height) != Some(self.values.len()) {
            let problem = format!("{width} x {height} cells with {} values", self.values.len());
            let advice = "make the sizes agree";
            return Err(Fault::new(problem, "one value a cell, and at least one", advice));
        }
        Ok(())
    }

    pub(crate) fn place(&self, cell: usize) -> Place {
        Place::Cell(cell % self.width.max(1), cell / self.width.max(1))
    }
}
