//! All measures of drainage in one structure.

use serde::Serialize;

use super::{
    AreaRange, FlowDirections, Horton, PowerLaw, SlopeArea, area_exceedance, hack_exponent,
    slope_area, stream_orders,
};
use crate::grid::{Grid, GridError};

/// The drainage of a terrain in numbers. Laws that it is too small or too flat for are `None`.
///
/// Judge whether a terrain is drained like a natural one by exceedance, Hack's law and concavity
/// together. Fractional Brownian surfaces (Hurst 0.8, filled, 512 to 2048 cells a side) have
/// Horton's ratios of river basins and h of 0.40 to 0.51, but beta of 0.55 to 0.59 and, clearest,
/// a concavity of 0.05 to 0.07.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drainage {
    /// Area of the largest basin, in square metres.
    pub largest_basin_m2: f64,
    /// Exceedance of contributing area: see [`area_exceedance`].
    pub exceedance: Option<PowerLaw>,
    /// Hack's law: see [`hack_exponent`].
    pub hack: Option<PowerLaw>,
    /// Slope against area: see [`slope_area`].
    pub slope_area: Option<SlopeArea>,
    /// Contributing cells from which on a cell counts as a channel.
    pub channel_cells: u32,
    /// Length of channels a unit of area, in 1/m.
    pub density: f64,
    /// Horton's ratios.
    pub horton: Option<Horton>,
}

impl Drainage {
    /// Contributing cells that make a channel.
    pub const CHANNEL_CELLS: u32 = 100;

    /// Measures the drainage over a surface without depressions, as
    /// [`fill_depressions`](super::fill_depressions) makes it, with usual ranges and thresholds.
    ///
    /// # Errors
    /// See [`GridError`].
    ///
    /// # Example
    /// ```
    /// use landform_analysis::grid::Grid;
    /// use landform_analysis::hydrology::{Drainage, fill_depressions};
    ///
    /// let grid = Grid::new([64, 64], [30.0; 2])?;
    /// let heights: Vec<f64> = (0..64 * 64).map(|cell| f64::from(cell * 7919 % 997)).collect();
    /// let drainage = Drainage::over_filled(&grid, &fill_depressions(&grid, &heights)?)?;
    /// assert!(drainage.largest_basin_m2 < 64.0 * 64.0 * grid.cell_area());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn over_filled(grid: &Grid, filled: &[f64]) -> Result<Self, GridError> {
        let directions = FlowDirections::over_filled(grid, filled)?;
        Ok(Self::along(&directions, &directions.contributing_cells(), filled))
    }

    /// Measures the drainage along `directions` with their `contributing_cells`; both were made of
    /// the surface `filled`.
    pub fn along(directions: &FlowDirections, contributing_cells: &[u32], filled: &[f64]) -> Self {
        let cells = contributing_cells;
        let range = AreaRange::usual(cells);
        let orders = stream_orders(directions, cells, Self::CHANNEL_CELLS);
        let largest = cells.iter().copied().max().unwrap_or(0);
        Self {
            largest_basin_m2: f64::from(largest) * directions.grid().cell_area(),
            exceedance: area_exceedance(directions, cells, range),
            hack: hack_exponent(directions, cells, range),
            slope_area: slope_area(directions, filled, cells, range),
            channel_cells: Self::CHANNEL_CELLS,
            density: channel_density(directions, &orders),
            horton: Horton::new(directions, &orders, cells),
        }
    }
}

/// Length of channels over the area with data; 0 without data.
fn channel_density(directions: &FlowDirections, orders: &[u8]) -> f64 {
    let grid = directions.grid();
    let steps = grid.step_lengths();
    let mut length = 0.0;
    let mut area = 0.0;
    for (cell, &order) in orders.iter().enumerate() {
        area += f64::from(u8::from(directions.has_data(cell))) * grid.cell_area();
        if let Some(direction) = directions.direction(cell).filter(|_| order > 0) {
            length += steps[usize::from(direction)];
        }
    }
    if area > 0.0 { length / area } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane that falls to the south: 300 streams of one column each.
    #[test]
    fn a_plane_has_parallel_streams() {
        let grid = Grid::new([300, 400], [10.0, 20.0]).unwrap();
        let plane: Vec<f64> = (0..grid.cell_count()).map(|cell| -((cell / 300) as f64)).collect();
        let drainage = Drainage::over_filled(&grid, &plane).unwrap();
        assert_eq!(drainage.largest_basin_m2, 400.0 * 200.0);
        assert_eq!(drainage.horton, None);
        // Channels from the 100th row on, whose last cells lead over the edge.
        let expected = 300.0 * 20.0 * 300.0 / (300.0 * 400.0 * 200.0);
        assert!((drainage.density - expected).abs() < 1e-12, "{drainage:?}");
    }

    #[test]
    fn without_data_there_is_nothing() {
        let grid = Grid::new([3, 2], [1.0; 2]).unwrap();
        let drainage = Drainage::over_filled(&grid, &[f64::NAN; 6]).unwrap();
        assert_eq!([drainage.largest_basin_m2, drainage.density], [0.0; 2]);
        assert_eq!(drainage.hack, None);
    }
}
