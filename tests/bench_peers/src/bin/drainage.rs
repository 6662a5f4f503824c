//! Drainage of the same terrain by Landform and by SurtGIS, timed in one run.
//!
//! Both fill the same heights, which are compared. Of the other work the sums are printed: SurtGIS
//! does not count a cell to what it drains, so D8 sums differ by the number of cells; over filled
//! lakes Landform leads water to where it leaves them and SurtGIS keeps it, so the sums of
//! D-infinity (square metres, cells) tell little. Times are CPU times of one thread, the least of
//! several rounds taken in turn.
//!
//! ```sh
//! cargo run --release --bin drainage            # 1024 x 1024; with another side: ... drainage 2048
//! ```

use cpu_time::ThreadTime;
use landform::analysis::grid::Grid;
use landform::analysis::hydrology::{DInfinity, FlowDirections, fill_depressions};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::synth::{Generator, SpectralFbm};
use surtgis_algorithms::hydrology::{
    flow_accumulation, flow_dinf, flow_direction, priority_flood_flat,
};
use surtgis_core::{GeoTransform, Raster};

/// Rounds of each program.
const ROUNDS: usize = 5;

fn main() {
    let side = std::env::args().nth(1).and_then(|side| side.parse().ok()).unwrap_or(1024);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    // Kernels that use threads then stay on this one, whose time is taken.
    pool.expect("a thread can be started").install(|| compare(side));
}

fn compare(side: usize) {
    let lattice = Lattice::plane([side; 2], 30.0, Connectivity::Eight, [Boundary::Periodic; 2]);
    let fbm = SpectralFbm { amplitude_m: 250.0, ..SpectralFbm::default() };
    let heights = fbm.generate(&lattice.expect("a lattice"), 1).expect("a terrain");
    let grid = Grid::new([side; 2], [30.0; 2]).expect("a grid");
    let given = raster(&heights, side);
    let filled = fill_depressions(&grid, &heights).expect("a terrain");
    let theirs = priority_flood_flat(&given).expect("a terrain");
    assert!(theirs.data().iter().eq(filled.iter()), "other heights after filling");
    let theirs = raster(&filled, side);

    println!("{side} x {side}: CPU nanoseconds a cell");
    row(
        "fill",
        grid.cell_count(),
        || sum(&fill_depressions(&grid, &heights).expect("a terrain")),
        || sum_of(&priority_flood_flat(&given).expect("a terrain")),
    );
    row(
        "D8 and accumulation, pits left",
        grid.cell_count(),
        || {
            let directions = FlowDirections::steepest(&grid, &heights).expect("a terrain");
            directions.contributing_cells().into_iter().map(f64::from).sum()
        },
        || {
            let directions = flow_direction(&given).expect("a terrain");
            sum_of(&flow_accumulation(&directions).expect("directions"))
        },
    );
    row(
        "D-infinity and accumulation",
        grid.cell_count(),
        || sum(&DInfinity::over_filled(&grid, &filled).expect("a terrain").contributing_area()),
        || sum_of(&flow_dinf(&theirs).expect("a terrain").accumulation),
    );
}

/// Heights as SurtGIS has them.
fn raster(heights: &[f64], side: usize) -> Raster<f64> {
    let mut raster = Raster::from_vec(heights.to_vec(), side, side).expect("a square");
    raster.set_transform(GeoTransform::new(0.0, 30.0 * side as f64, 30.0, -30.0));
    raster
}

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}

/// Sum of the cells with data.
fn sum_of(raster: &Raster<f64>) -> f64 {
    raster.data().iter().filter(|value| value.is_finite()).sum()
}

/// Times both programs in turn and prints a line.
fn row(name: &str, cells: usize, ours: impl Fn() -> f64, theirs: impl Fn() -> f64) {
    let mut least = [f64::INFINITY; 2];
    let mut sums = [0.0; 2];
    for _ in 0..ROUNDS {
        for (index, work) in [&ours as &dyn Fn() -> f64, &theirs].into_iter().enumerate() {
            let start = ThreadTime::now();
            sums[index] = work();
            let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / cells as f64;
            least[index] = least[index].min(nanoseconds);
        }
    }
    let [landform, surtgis] = least;
    println!(
        "  {name:<32} Landform {landform:>6.1}   SurtGIS {surtgis:>6.1}   ratio {:.2}   (sums {:.4e}, {:.4e})",
        landform / surtgis,
        sums[0],
        sums[1]
    );
}
