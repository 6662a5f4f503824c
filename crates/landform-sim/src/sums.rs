//! Sums that are the same on every machine layout: fixed blocks, fixed order, small error.

use rayon::prelude::*;

/// Numbers a block holds. A block is summed by one thread, blocks are added in order.
const BLOCK: usize = 4096;

/// Sum of `values` by compensated (Neumaier) blocks: the same bits on any number of threads, with
/// an error of a few units in the last place of the sum of magnitudes.
pub fn sum(values: &[f64]) -> f64 {
    let blocks: Vec<f64> = values.par_chunks(BLOCK).map(compensated).collect();
    compensated(&blocks)
}

fn compensated(values: &[f64]) -> f64 {
    let mut total = 0.0_f64;
    let mut lost = 0.0;
    for &value in values {
        let next = total + value;
        lost += if total.abs() >= value.abs() {
            (total - next) + value
        } else {
            (value - next) + total
        };
        total = next;
    }
    total + lost
}

#[cfg(test)]
mod tests {
    use super::sum;

    #[test]
    fn small_numbers_beside_large_ones_are_kept() {
        assert_eq!(sum(&[1e100, 1.0, -1e100, 1.0]), 2.0);
        let many = vec![0.1; 1_000_000];
        assert!((sum(&many) - 100_000.0).abs() < 1e-9);
    }

    #[test]
    fn threads_do_not_change_the_bits() {
        let values: Vec<f64> = (0..50_000).map(|i| (f64::from(i) * 0.37).sin()).collect();
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let one = pool(1).expect("pool").install(|| sum(&values));
        let eight = pool(8).expect("pool").install(|| sum(&values));
        assert_eq!(one.to_bits(), eight.to_bits());
    }
}
