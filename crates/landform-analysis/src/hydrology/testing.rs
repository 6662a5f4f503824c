//! Terrains for the tests: rough, stepped, with gaps, oblong, and too small for neighbours.

use crate::grid::Grid;

/// Terrains that exercise every branch of the kernels.
pub fn terrains() -> Vec<(Grid, Vec<f64>)> {
    let sizes = [[1, 1], [1, 9], [7, 1], [2, 2], [3, 3], [16, 16], [61, 40], [40, 90]];
    let mut terrains = Vec::new();
    for (seed, size) in sizes.into_iter().enumerate() {
        let grid = Grid::new(size, [10.0, 10.0 + 3.0 * (seed % 3) as f64]).expect("a grid");
        for steps in [3.0, 40.0, 1e6] {
            let heights = rough(&grid, seed as u64, steps);
            terrains.push((grid, heights.clone()));
            terrains.push((grid, with_gaps(&grid, heights)));
        }
    }
    terrains
}

/// A tilted, wavy and noisy surface whose heights are rounded to `steps` parts of its relief.
pub fn rough(grid: &Grid, seed: u64, steps: f64) -> Vec<f64> {
    let height = |cell: usize| {
        let [x, y] = grid.position(cell).map(|place| place as f64);
        let wave = (x / 5.0 + seed as f64).sin() + (y / 7.0).cos();
        let noise = hash(seed, cell as u64) as f64 / u64::MAX as f64;
        ((0.02 * x + wave + 1.5 * noise) * steps).round() / steps + 0.0
    };
    (0..grid.cell_count()).map(height).collect()
}

fn with_gaps(grid: &Grid, mut heights: Vec<f64>) -> Vec<f64> {
    for (cell, height) in heights.iter_mut().enumerate() {
        let [x, y] = grid.position(cell);
        if hash(99, cell as u64).is_multiple_of(61) || (x > 20 && x < 24 && y < 30) {
            *height = f64::NAN;
        }
    }
    heights
}

/// Steele, Lea and Flood's mixing of 64 bits (SplitMix64).
pub fn hash(seed: u64, number: u64) -> u64 {
    let mut bits = (seed << 40 | number).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}

/// The bits of numbers, to compare them with NaN among them.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}
