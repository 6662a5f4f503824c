//! Sizes of avalanches, counted in bins that grow by a constant factor.

use serde::{Deserialize, Serialize};

/// Events between two sizes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SizeBin {
    /// Least size, in the unit of the sizes given; belongs to the bin.
    pub from: f64,
    /// Greatest size; belongs to the next bin.
    pub to: f64,
    /// Number of events.
    pub count: u64,
    /// Events for each unit of size, as a share of all events: straight in a plot with two
    /// logarithmic axes for a power law, with the exponent as its slope.
    pub density: f64,
}

/// Counts sizes in bins between powers of `factor` (above 1), from the bin of the least size to
/// that of the greatest. Sizes that are zero, negative or not finite are no events.
///
/// Empty when there are no events, or when `factor` is not above 1 or not finite.
pub fn size_bins(sizes: &[f64], factor: f64) -> Vec<SizeBin> {
    // A factor nearer to one than this would fill the memory with empty bins.
    if !(factor >= 1.001 && factor.is_finite()) {
        return Vec::new();
    }
    // Sizes that are powers of the factor belong to the bin they begin, whatever the rounding.
    let bin_of = |size: f64| (size.ln() / factor.ln() + 1e-9).floor() as i64;
    let is_event = |size: &&f64| **size > 0.0 && size.is_finite();
    let bins: Vec<i64> = sizes.iter().filter(is_event).map(|&size| bin_of(size)).collect();
    let (Some(&first), Some(&last)) = (bins.iter().min(), bins.iter().max()) else {
        return Vec::new();
    };
    let mut counts = vec![0_u64; (last - first + 1) as usize];
    bins.iter().for_each(|bin| counts[(bin - first) as usize] += 1);
    let edge = |bin: i64| (bin as f64 * factor.ln()).exp();
    let bin = |(number, &count): (usize, &u64)| {
        let [from, to] = [edge(first + number as i64), edge(first + number as i64 + 1)];
        let density = count as f64 / bins.len() as f64 / (to - from);
        SizeBin { from, to, count, density }
    };
    counts.iter().enumerate().map(bin).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_fall_into_the_bins_they_begin() {
        let bins = size_bins(&[1.0, 2.0, 3.9, 4.0, 8.0, 8.0, 0.0, -1.0, f64::NAN], 2.0);
        let counts: Vec<u64> = bins.iter().map(|bin| bin.count).collect();
        assert_eq!(counts, [1, 2, 1, 2]);
        assert!((bins[2].from - 4.0).abs() < 1e-12 && (bins[2].to - 8.0).abs() < 1e-12);
        let total: f64 = bins.iter().map(|bin| bin.density * (bin.to - bin.from)).sum();
        assert!((total - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_power_law_keeps_its_exponent() {
        // Quantiles of the density s^-1.5 above 1 are 1 / (1 - q)^2.
        let sizes: Vec<f64> =
            (0..100_000).map(|n| (1.0 - (f64::from(n) + 0.5) / 1e5).powi(-2)).collect();
        let bins = size_bins(&sizes, 2.0);
        let slope = (bins[8].density / bins[1].density).log2() / 7.0;
        assert!((slope + 1.5).abs() < 0.01, "{slope}");
    }

    #[test]
    fn nothing_to_count_gives_no_bins() {
        assert!(size_bins(&[], 2.0).is_empty() && size_bins(&[0.0], 2.0).is_empty());
        for factor in [1.0, 0.5, f64::NAN, f64::INFINITY, 1.0 + 1e-12] {
            assert!(size_bins(&[1.0, 2.0], factor).is_empty());
        }
        assert_eq!(size_bins(&[f64::MIN_POSITIVE, f64::MAX], 10.0).len(), 617);
    }
}
