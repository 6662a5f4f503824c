//! Sums that are the same on every machine layout: fixed blocks, fixed order, small error.

use rayon::prelude::*;

/// Numbers a block holds. A block is summed by one thread, blocks are added in order.
const BLOCK: usize = 4096;

/// Blocks that are summed side by side, so that a processor need not wait for one addition after the
/// other.
const LANES: usize = 4;

/// Sum of `values` by compensated (Neumaier) blocks: the same bits on any number of threads, with
/// an error of a few units in the last place of the sum of magnitudes.
pub fn sum(values: &[f64]) -> f64 {
    let (groups, rest) = values.as_chunks::<{ LANES * BLOCK }>();
    let sums: Vec<[f64; LANES]> = groups.par_iter().map(side_by_side).collect();
    let blocks: Vec<f64> =
        sums.into_iter().flatten().chain(rest.chunks(BLOCK).map(compensated)).collect();
    compensated(&blocks)
}

/// [`compensated`] sums of the blocks of a group. What an addition loses is a double, whichever way it
/// is found: here without asking which number is the larger (Knuth's two-sum).
fn side_by_side(group: &[f64; LANES * BLOCK]) -> [f64; LANES] {
    let (mut total, mut lost) = ([0.0; LANES], [0.0; LANES]);
    for at in 0..BLOCK {
        for lane in 0..LANES {
            let (before, value) = (total[lane], group[lane * BLOCK + at]);
            let next = before + value;
            let added = next - before;
            lost[lane] += (before - (next - added)) + (value - added);
            total[lane] = next;
        }
    }
    std::array::from_fn(|lane| total[lane] + lost[lane])
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
    use super::*;

    #[test]
    fn small_numbers_beside_large_ones_are_kept() {
        assert_eq!(sum(&[1e100, 1.0, -1e100, 1.0]), 2.0);
        let many = vec![0.1; 1_000_000];
        assert!((sum(&many) - 100_000.0).abs() < 1e-9);
    }

    #[test]
    fn blocks_side_by_side_give_the_bits_of_blocks_one_after_the_other() {
        let mixed = |i: i32| (f64::from(i) * 0.37).sin() * 10.0_f64.powi(i % 25 - 12);
        for count in [0, 1, 4095, 16_384, 16_385, 70_000] {
            let values: Vec<f64> = (0..count).map(mixed).collect();
            let blocks: Vec<f64> = values.chunks(BLOCK).map(compensated).collect();
            assert_eq!(sum(&values).to_bits(), compensated(&blocks).to_bits(), "{count}");
        }
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
