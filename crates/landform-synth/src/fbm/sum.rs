//! Adding up waves: the inverse Fourier transform of half a plane of coefficients.

use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use rustfft::FftPlanner;

/// Rows that are gathered from the columns together: as many as share a line of the cache, times
/// four.
const ROWS: usize = 16;

/// Adds up the waves whose coefficients are given for half of the plane, column after column, and
/// the mean height.
pub(super) fn sum_of_waves(
    mut columns: Vec<Vec<Complex<f64>>>,
    [width, height]: [usize; 2],
    mean: f64,
) -> Vec<f64> {
    let down_columns = FftPlanner::<f64>::new().plan_fft_inverse(height);
    columns.par_iter_mut().for_each_init(
        || vec![Complex::default(); down_columns.get_inplace_scratch_len()],
        |scratch, column| down_columns.process_with_scratch(column, scratch),
    );
    let along_rows = RealFftPlanner::<f64>::new().plan_fft_inverse(width);
    let half = width / 2 + 1;
    let mut heights = vec![0.0; width * height];
    heights.par_chunks_mut(ROWS * width).enumerate().for_each_init(
        || (vec![Complex::default(); ROWS * half], along_rows.make_scratch_vec()),
        |(waves, scratch), (block, heights)| {
            gather(&columns, block * ROWS, waves);
            for (waves, heights) in waves.chunks_exact_mut(half).zip(heights.chunks_mut(width)) {
                // Symmetry makes these real; what rounding left would be refused.
                waves[0].im = 0.0;
                if width % 2 == 0 {
                    waves[width / 2].im = 0.0;
                }
                let sum = along_rows.process_with_scratch(waves, heights, scratch);
                sum.expect("the plan was made for rows of this length");
                heights.iter_mut().for_each(|height| *height += mean);
            }
        },
    );
    heights
}

/// Copies rows from `first` on out of columns, as many as there are and `waves` has room for.
fn gather(columns: &[Vec<Complex<f64>>], first: usize, waves: &mut [Complex<f64>]) {
    for (number, column) in columns.iter().enumerate() {
        let entries = column[first..].iter().take(ROWS);
        for (row, entry) in entries.enumerate() {
            waves[row * columns.len() + number] = *entry;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{SpectralFbm, waves::Waves};
    use super::*;
    use std::f64::consts::TAU;

    /// The readable reference of [`sum_of_waves`]: every wave and its mirror image, one by one.
    fn sum_by_definition(columns: &[Vec<Complex<f64>>], [width, height]: [usize; 2]) -> Vec<f64> {
        let mut heights = vec![0.0; width * height];
        for (column, entries) in columns.iter().enumerate() {
            let own_mirror = column == 0 || 2 * column == width;
            let share = if own_mirror { 1.0 } else { 2.0 };
            for (row, coefficient) in entries.iter().enumerate() {
                for (node, value) in heights.iter_mut().enumerate() {
                    let x = (column * (node % width)) as f64 / width as f64;
                    let y = (row * (node / width)) as f64 / height as f64;
                    *value += share * (coefficient * Complex::from_polar(1.0, TAU * (x + y))).re;
                }
            }
        }
        heights
    }

    #[test]
    fn the_fast_sum_agrees_with_the_definition() {
        for size in [[8, 8], [7, 5], [6, 9], [16, 35], [2, 5], [1, 6], [6, 1], [1, 1]] {
            let columns = Waves::new(&SpectralFbm::default(), size, 3).columns();
            let expected = sum_by_definition(&columns, size);
            let found = sum_of_waves(columns, size, 0.5);
            let difference = expected.iter().zip(&found).map(|(a, b)| (a + 0.5 - b).abs());
            let worst = difference.fold(0.0, f64::max);
            assert!(worst < 1e-12, "{size:?}: {worst}");
        }
    }
}
