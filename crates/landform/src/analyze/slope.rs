//! How steep a terrain is.

use landform_analysis::derivatives::{Scheme, derivatives};
use landform_analysis::grid::{Grid, GridError};
use serde::Serialize;

/// Rows that are derived at a time: the derivatives of a whole raster would take four times its
/// memory.
const STRIP: usize = 256;

/// Slopes after Horn, in degrees, of the cells with all eight neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SlopeQuantiles {
    /// Mean.
    pub mean: f64,
    /// 5 % of the cells are less steep.
    pub p5: f64,
    /// A quarter of the cells are less steep.
    pub p25: f64,
    /// Half of the cells are less steep.
    pub median: f64,
    /// Three quarters of the cells are less steep.
    pub p75: f64,
    /// 95 % of the cells are less steep.
    pub p95: f64,
    /// The steepest cell.
    pub steepest: f64,
}

impl SlopeQuantiles {
    /// Measures a terrain; `None` if no cell has all eight neighbours.
    pub(super) fn measure(grid: &Grid, heights: &[f64]) -> Result<Option<Self>, GridError> {
        let mut slopes = slopes_deg(grid, heights)?;
        if slopes.is_empty() {
            return Ok(None);
        }
        let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
        slopes.sort_unstable_by(f64::total_cmp);
        let [p5, p25, median, p75, p95, steepest] =
            [0.05, 0.25, 0.5, 0.75, 0.95, 1.0].map(|share| quantile(&slopes, share));
        Ok(Some(Self { mean, p5, p25, median, p75, p95, steepest }))
    }
}

/// The slopes that exist, strip by strip.
fn slopes_deg(grid: &Grid, heights: &[f64]) -> Result<Vec<f64>, GridError> {
    let [columns, rows] = [grid.columns(), grid.rows()];
    let mut slopes = Vec::with_capacity(heights.len());
    for start in (0..rows).step_by(STRIP) {
        // A row beyond either end, for the neighbours.
        let (first, last) = (start.saturating_sub(1), (start + STRIP + 1).min(rows));
        let strip = Grid::new([columns, last - first], grid.cell_size())?;
        let found = derivatives(&strip, &heights[first * columns..last * columns], Scheme::Horn)?;
        let slope = found.iter().map(|found| found.slope.atan().to_degrees());
        slopes.extend(slope.filter(|slope| !slope.is_nan()));
    }
    Ok(slopes)
}

/// Value at a share of sorted values, between two of them by interpolation.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let lower = place.floor() as usize;
    let upper = (lower + 1).min(sorted.len() - 1);
    sorted[lower] + (place - lower as f64) * (sorted[upper] - sorted[lower])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strips must neither lose nor repeat a row.
    #[test]
    fn strips_give_the_slopes_of_the_whole() {
        for rows in [1, 2, 3, STRIP - 1, STRIP, STRIP + 1, 2 * STRIP + 1] {
            let grid = Grid::new([5, rows], [10.0, 20.0]).unwrap();
            let heights: Vec<f64> =
                (0..grid.cell_count()).map(|cell| (cell * cell % 97) as f64).collect();
            let whole = derivatives(&grid, &heights, Scheme::Horn).unwrap();
            let whole: Vec<f64> = whole
                .iter()
                .map(|found| found.slope.atan().to_degrees())
                .filter(|slope| !slope.is_nan())
                .collect();
            assert_eq!(slopes_deg(&grid, &heights).unwrap(), whole, "{rows} rows");
        }
    }

    #[test]
    fn a_plane_is_as_steep_everywhere() {
        let grid = Grid::new([6, 6], [10.0; 2]).unwrap();
        let heights: Vec<f64> = (0..36).map(|cell| f64::from(cell % 6) * 10.0).collect();
        let found = SlopeQuantiles::measure(&grid, &heights).unwrap().unwrap();
        for slope in [found.mean, found.p5, found.p25, found.median, found.p95, found.steepest] {
            assert!((slope - 45.0).abs() < 1e-9);
        }
        let line = Grid::new([6, 1], [10.0; 2]).unwrap();
        assert_eq!(SlopeQuantiles::measure(&line, &heights[..6]).unwrap(), None);
    }
}
