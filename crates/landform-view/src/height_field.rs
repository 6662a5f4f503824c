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
    water_depths: Option<&'a [f64]>,
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
        Ok(Self { width, height, spacing_m, heights, water_depths: None })
    }

    /// The field with depths of water on it, in metres, a node each: 0 where it is dry.
    ///
    /// # Errors
    /// [`ViewError::Length`], and [`ViewError::NotFinite`] with the first node whose depth is
    /// below 0, no number, or beyond 1e12 m.
    pub fn with_water(self, depths: &'a [f64]) -> Result<Self, ViewError> {
        let (width, height) = (self.width, self.height);
        if depths.len() != width * height {
            let (what, found) = ("the depths of water", depths.len());
            return Err(ViewError::Length { what, found, width, height });
        }
        if let Some(node) = depths.iter().position(|depth| !(0.0..=1e12).contains(depth)) {
            let (what, value) = ("the depth of water", depths[node]);
            let (column, row) = (node % width, node / width);
            return Err(ViewError::NotFinite { what, value, column, row });
        }
        Ok(Self { water_depths: Some(depths), ..self })
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

    /// Depths of the water on it in metres, in node order, if it has any.
    pub fn water_depths(&self) -> Option<&'a [f64]> {
        self.water_depths
    }

    /// Lowest and highest height in metres.
    pub fn range(&self) -> [f64; 2] {
        self.heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &height| {
            [low.min(height), high.max(height)]
        })
    }
}
