//! The variogram: how much heights differ with distance.

use rayon::prelude::*;

use super::{Dimension, DimensionError, Rule};

/// Largest lag in cells.
const LAGS: usize = 16;

/// Squared differences and their numbers, by lag.
type Sums = [(f64, u64); LAGS];

/// Dimension of a height field by its variogram: half the mean squared difference of heights
/// grows as lag^(2 H), and D = 3 - H. Its level sets have one less.
///
/// `heights` holds one value a cell of `size` (columns, rows), NaN where there are no data;
/// `cell_m` is the size of a cell along both axes. Lags of 1 to 16 cells (at most a quarter of
/// the raster) along rows and columns count together, at the geometric mean of both distances.
///
/// # Limits
/// For fractional Brownian surfaces H comes out 0.10 high at 0.3 and 0.05 low at 0.9, true near
/// 0.7: [`crate::RadialSpectrum`] has no such bias, but needs a raster without gaps.
///
/// # Errors
/// [`DimensionError`]; [`DimensionError::TooFewScales`] also when all heights are alike.
///
/// # Source
/// Mark and Aronson 1984.
pub fn variogram_dimension(
    heights: &[f64],
    size: [usize; 2],
    cell_m: [f64; 2],
) -> Result<Dimension, DimensionError> {
    super::check_raster(heights.len(), size, cell_m)?;
    let lags = LAGS.min(size[0].min(size[1]) / 4);
    let rows: Vec<Sums> =
        (0..size[1]).into_par_iter().map(|row| row_sums(heights, size, row, lags)).collect();
    let distance_m = (cell_m[0] * cell_m[1]).sqrt();
    // Added up in the order of the rows, so that the number of threads does not matter.
    let semivariance = |lag: usize| {
        let sum: f64 = rows.iter().map(|sums| sums[lag - 1].0).sum();
        let pairs: u64 = rows.iter().map(|sums| sums[lag - 1].1).sum();
        if pairs == 0 { 0.0 } else { 0.5 * sum / pairs as f64 }
    };
    let measured: Vec<[f64; 2]> =
        (1..=lags).map(|lag| [lag as f64 * distance_m, semivariance(lag)]).collect();
    Dimension::fit(&measured, Rule::VARIANCE)
}

/// Pairs that start in one row and run east or south.
fn row_sums(heights: &[f64], [width, height]: [usize; 2], row: usize, lags: usize) -> Sums {
    let mut sums = [(0.0, 0); LAGS];
    let line = |row: usize| &heights[row * width..(row + 1) * width];
    let here = line(row);
    for lag in 1..=lags {
        add(&here[..width - lag], &here[lag..], &mut sums[lag - 1]);
        if row + lag < height {
            add(here, line(row + lag), &mut sums[lag - 1]);
        }
    }
    sums
}

fn add(from: &[f64], to: &[f64], (sum, pairs): &mut (f64, u64)) {
    for (a, b) in from.iter().zip(to) {
        let square = (a - b) * (a - b);
        if square.is_finite() {
            *sum += square;
            *pairs += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a plane the difference grows with the lag, so H = 1 and D = 2, with gaps or without.
    #[test]
    fn a_plane_has_dimension_two() {
        let mut heights: Vec<f64> =
            (0..64 * 64).map(|cell| 3.0 * (cell % 64) as f64 - (cell / 64) as f64).collect();
        let plane = variogram_dimension(&heights, [64, 64], [10.0, 10.0]).unwrap();
        assert!((plane.dimension - 2.0).abs() < 1e-9, "{plane:?}");
        assert_eq!((plane.range_m, plane.scales.len()), ([10.0, 160.0], 16));
        // Half the mean of 3^2 along rows and 1^2 along columns.
        assert!((plane.scales[0].measure - 2.5).abs() < 1e-9);
        heights.iter_mut().step_by(7).for_each(|height| *height = f64::NAN);
        let holed = variogram_dimension(&heights, [64, 64], [10.0, 10.0]).unwrap();
        assert!((holed.dimension - 2.0).abs() < 0.02, "{holed:?}");
    }

    #[test]
    fn flat_small_and_empty_rasters_are_refused() {
        let too_few = |result| matches!(result, Err(DimensionError::TooFewScales(0)));
        assert!(too_few(variogram_dimension(&[4.0; 1024], [32, 32], [1.0; 2])));
        assert!(too_few(variogram_dimension(&[4.0], [1, 1], [1.0; 2])));
        assert!(too_few(variogram_dimension(&[f64::NAN; 1024], [32, 32], [1.0; 2])));
        assert!(too_few(variogram_dimension(&[], [0, 0], [1.0; 2])));
        let error = variogram_dimension(&[1.0; 4], [2, 2], [1.0, 0.0]);
        assert_eq!(error, Err(DimensionError::Cell { cell_m: [1.0, 0.0] }));
    }
}
