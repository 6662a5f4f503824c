//! Heights on a regular grid, checked once.

use crate::ViewError;

/// Heights of the nodes of a grid: row by row, row 0 the northernmost, columns from the west.
///
/// It borrows the heights, so a field of a simulation is drawn without a copy. Gaps (no-data,
/// NaN) have to be filled by the caller, who knows with what.
#[derive(Clone, Copy, Debug)]
pub struct HeightField<'a> {
    width: usize,
    height: usize,
    spacing_m: f64,
    heights: &'a [f64],
}

impl<'a> HeightField<'a> {
    /// A field of `width` columns and `height` rows, `spacing_m` metres apart, with heights in
    /// metres.
    ///
    /// # Errors
    /// [`ViewError::TooSmall`] without at least 2 x 2 nodes (a surface needs a cell),
    /// [`ViewError::TooLarge`], [`ViewError::Length`], [`ViewError::Option`] for a spacing out
    /// of range, [`ViewError::NotFinite`] with the first node that is no height (beyond 1e12 m
    /// nothing is).
    pub fn new(
        width: usize,
        height: usize,
        spacing_m: f64,
        heights: &'a [f64],
    ) -> Result<Self, ViewError> {
        ViewError::check_size("a height field", [width, height], 2)?;
        if heights.len() != width * height {
            let (what, found) = ("a height field", heights.len());
            return Err(ViewError::Length { what, found, width, height });
        }
        let range = [1e-6, 1e9];
        ViewError::check_option("spacing_m", spacing_m, range, "from 1e-6 to 1e9 metres")?;
        if let Some(node) = heights.iter().position(|height| height.abs().total_cmp(&1e12).is_gt())
        {
            let (column, row) = (node % width, node / width);
            let value = heights[node];
            return Err(ViewError::NotFinite { what: "the height", value, column, row });
        }
        Ok(Self { width, height, spacing_m, heights })
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Distance between nodes in metres.
    pub fn spacing_m(&self) -> f64 {
        self.spacing_m
    }

    /// Heights in metres, in node order.
    pub fn heights(&self) -> &'a [f64] {
        self.heights
    }

    /// Lowest and highest height in metres.
    pub fn range(&self) -> [f64; 2] {
        self.heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &height| {
            [low.min(height), high.max(height)]
        })
    }
}
