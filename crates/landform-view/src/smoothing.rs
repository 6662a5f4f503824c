//! Gaussian smoothing of heights before they are drawn.

use rayon::prelude::*;

use crate::surface::bound;

/// Smooths `columns * rows` heights with a Gaussian of standard deviation `deviation` nodes,
/// along rows and then along columns. Edges repeat their last value, or continue at the other
/// side when `periodic`.
pub(crate) fn smooth(heights: &mut [f32], columns: usize, deviation: f64, periodic: bool) {
    if deviation <= 0.0 {
        return;
    }
    let weights = weights(deviation);
    let reach = (weights.len() / 2) as isize;
    let rows = heights.len() / columns;
    let gather = |index: usize, size: usize, height: &dyn Fn(usize) -> f32| -> f32 {
        let places = (-reach..=reach).map(|offset| bound(index as isize + offset, size, periodic));
        places.zip(&weights).map(|(place, weight)| weight * height(place)).sum()
    };
    heights.par_chunks_mut(columns).for_each(|line| {
        let source = line.to_vec();
        for (column, height) in line.iter_mut().enumerate() {
            *height = gather(column, columns, &|place| source[place]);
        }
    });
    let source = heights.to_vec();
    heights.par_chunks_mut(columns).enumerate().for_each(|(row, line)| {
        for (column, height) in line.iter_mut().enumerate() {
            *height = gather(row, rows, &|place| source[column + columns * place]);
        }
    });
}

/// Weights from the first to the last node that count, three deviations each way; their sum is 1.
fn weights(deviation: f64) -> Vec<f32> {
    let reach = (3.0 * deviation).ceil() as i32;
    let weight = |offset: i32| (-0.5 * (f64::from(offset) / deviation).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|offset| (weight(offset) / sum) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_becomes_a_gaussian_of_the_same_volume() {
        for periodic in [true, false] {
            let mut heights = vec![0.0; 31 * 25];
            heights[15 + 31 * 12] = 100.0;
            smooth(&mut heights, 31, 1.5, periodic);
            let volume: f32 = heights.iter().sum();
            assert!((volume - 100.0).abs() < 1e-3, "{volume}");
            let ratio = heights[18 + 31 * 12] / heights[15 + 31 * 12];
            assert!((ratio - (-2.0_f32).exp()).abs() < 1e-4, "two deviations away: {ratio}");
        }
    }

    #[test]
    fn no_deviation_changes_nothing() {
        let mut heights = vec![1.0, 5.0, 2.0, 8.0];
        smooth(&mut heights, 2, 0.0, false);
        assert_eq!(heights, [1.0, 5.0, 2.0, 8.0]);
    }
}
