//! Drainage: filling, routing and accumulation, nanoseconds a cell.
//!
//! The terrain is a spectral fractional Brownian surface (Hurst 0.8) of 30 m cells, with tens of
//! thousands of depressions. `plain priority flood` is the textbook's, written here: every cell goes
//! over the heap. Both floods must give the same heights, or the program ends with an error. `copy`
//! writes as many heights as the terrain has: what memory alone costs.

mod measure;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hint::black_box;

use landform::analysis::derivatives::{Scheme, derivatives};
use landform::analysis::grid::Grid;
use landform::analysis::hydrology::{DInfinity, FlowDirections, fill_depressions};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::synth::{Generator, SpectralFbm};
use measure::{Effort, pairs, table};

fn main() {
    table("Hydrology", |effort| {
        let sides: &[usize] = match effort {
            Effort::Quick => &[512],
            Effort::Normal => &[512, 1024],
            Effort::Full => &[512, 1024, 2048],
        };
        for &side in sides {
            terrain(effort, side);
        }
    });
}

fn terrain(effort: Effort, side: usize) {
    let lattice = Lattice::plane([side; 2], 30.0, Connectivity::Eight, [Boundary::Periodic; 2]);
    let fbm = SpectralFbm { amplitude_m: 250.0, ..SpectralFbm::default() };
    let heights = fbm.generate(&lattice.expect("a lattice"), 1).expect("a terrain");
    let grid = Grid::new([side; 2], [30.0; 2]).expect("a grid");
    let fill = || fill_depressions(&grid, &heights).expect("a terrain");
    let filled = fill();
    assert_eq!(filled, plain_flood(&grid, &heights), "the floods differ");
    let over_filled =
        |filled: &[f64]| FlowDirections::over_filled(&grid, filled).expect("a terrain");
    let rounds = effort.rounds(7);
    let flood = || count(plain_flood(&grid, &heights));
    let copy = || count(black_box(&heights).clone());

    let steepest = || {
        let directions = FlowDirections::steepest(&grid, &heights).expect("a terrain");
        count(directions.contributing_cells())
    };
    let all = || count(over_filled(&fill()).contributing_cells());
    let infinity = || {
        let directions = DInfinity::over_filled(&grid, &filled).expect("a terrain");
        count(directions.contributing_area())
    };
    let derive = || count(derivatives(&grid, &heights, Scheme::Evans).expect("a terrain"));

    let name = |name: &str| format!("{name}, {side}x{side}");
    let plain = "plain priority flood";
    let pair = pairs(rounds, steepest, copy);
    pair.print(&name("D8 and accumulation, pits left"), "copy", "60 ns");
    pairs(rounds, || count(fill()), flood).print(&name("fill"), plain, "");
    pairs(rounds, all, flood).print(&name("fill, route, accumulate"), plain, "165 ns");
    pairs(rounds, infinity, copy).print(&name("D-infinity over filled"), "copy", "320 ns");
    pairs(rounds, derive, copy).print(&name("slope, aspect, curvature"), "copy", "");
}

/// Keeps what was computed and returns how many cells it has.
fn count<T>(values: Vec<T>) -> usize {
    black_box(&values).len()
}

/// Barnes, Lehman and Mulla's priority flood (2014) without refinements.
fn plain_flood(grid: &Grid, heights: &[f64]) -> Vec<f64> {
    let key = |level: f64| {
        let bits = level.to_bits();
        if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
    };
    let mut levels = vec![f64::NAN; heights.len()];
    let mut heap = BinaryHeap::new();
    for cell in (0..heights.len()).filter(|&cell| grid.is_edge(cell)) {
        levels[cell] = heights[cell];
        heap.push(Reverse((key(heights[cell]), cell)));
    }
    while let Some(Reverse((_, cell))) = heap.pop() {
        for (_, next) in grid.neighbours(cell) {
            if levels[next].is_nan() {
                levels[next] = heights[next].max(levels[cell]);
                heap.push(Reverse((key(levels[next]), next)));
            }
        }
    }
    levels
}
