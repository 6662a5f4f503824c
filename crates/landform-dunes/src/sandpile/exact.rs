//! What is known exactly about sandpiles, to stand beside what is measured.

use std::f64::consts::PI;

/// Mean number of grains at a site of a large [`AbelianSandpile`](super::AbelianSandpile) in its
/// critical state (conjectured by Grassberger, proved by Poghosyan, Priezzhev and Ruelle 2011
/// and Kenyon and Wilson 2015).
pub const MEAN_GRAINS: f64 = 17.0 / 8.0;

/// Share of the sites with 0, 1, 2 and 3 grains of a large
/// [`AbelianSandpile`](super::AbelianSandpile) in its critical state (Majumdar and Dhar 1991 for
/// 0 grains, Priezzhev 1994 for the others): 0.07364, 0.17390, 0.30629, 0.44617.
pub const GRAIN_PROBABILITIES: [f64; 4] = [
    2.0 / (PI * PI) * (1.0 - 2.0 / PI),
    1.0 / 4.0 - 1.0 / (2.0 * PI) - 3.0 / (PI * PI) + 12.0 / (PI * PI * PI),
    3.0 / 8.0 + 1.0 / PI - 12.0 / (PI * PI * PI),
    3.0 / 8.0 - 1.0 / (2.0 * PI) + 1.0 / (PI * PI) + 4.0 / (PI * PI * PI),
];

/// Mean number of topplings that a grain added anywhere causes on an
/// [`AbelianSandpile`](super::AbelianSandpile) of `side` x `side` sites in its critical state.
///
/// Topplings carry grains to the border as random walks do, so the mean is that of the inverse
/// Laplacian over all pairs of sites (Dhar 1990), here in its sine waves. About 0.0351 (side +
/// 1)^2. Cost: side^2.
pub fn mean_avalanche_size(side: usize) -> f64 {
    let n = (side + 1) as f64;
    let odd = || (1..=side).step_by(2).map(|number| number as f64);
    let overlap = |p: f64| (PI * p / (2.0 * n)).tan().powi(-2);
    let curvature = |p: f64| 2.0 - 2.0 * (PI * p / n).cos();
    let sum: f64 = odd()
        .flat_map(|p| odd().map(move |q| (p, q)))
        .map(|(p, q)| overlap(p) * overlap(q) / (curvature(p) + curvature(q)))
        .sum();
    4.0 * sum / (n * side as f64).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_probabilities_add_up_and_give_the_mean() {
        let sum: f64 = GRAIN_PROBABILITIES.iter().sum();
        assert!((sum - 1.0).abs() < 1e-15);
        let mean: f64 = (0..4).map(|grains| grains as f64 * GRAIN_PROBABILITIES[grains]).sum();
        assert!((mean - MEAN_GRAINS).abs() < 1e-15);
    }

    /// The mean for a small square by counting the visits of the random walk directly.
    #[test]
    fn the_mean_size_agrees_with_random_walks() {
        for side in [1, 2, 3, 5] {
            let mut visits = vec![0.0; side * side];
            for _ in 0..2000 {
                visits = (0..side * side)
                    .map(|site| {
                        let [x, y] = [site % side, site / side];
                        let mut sum = 0.25;
                        sum += if x > 0 { visits[site - 1] / 4.0 } else { 0.0 };
                        sum += if x + 1 < side { visits[site + 1] / 4.0 } else { 0.0 };
                        sum += if y > 0 { visits[site - side] / 4.0 } else { 0.0 };
                        sum + if y + 1 < side { visits[site + side] / 4.0 } else { 0.0 }
                    })
                    .collect();
            }
            let mean = visits.iter().sum::<f64>() / (side * side) as f64;
            assert!((mean / mean_avalanche_size(side) - 1.0).abs() < 1e-9, "side {side}");
        }
    }
}
