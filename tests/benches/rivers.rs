//! Water columns: nanoseconds a wet cell and sweep. Stream power: nanoseconds a cell and step.
//!
//! The ground is a spectral fractional Brownian surface (Hurst 0.8) of 10 m cells under rain, which
//! has flowed for 40 sweeps and stands in its hollows. `copy` writes as many levels as there are
//! cells: what memory alone costs. With one of a hundred basins wet, the time is again that of a
//! wet cell. Pipes cost the same wet or dry.
//!
//! Stream power begins on such ground of 100 m cells, which is full of depressions; `young` are its first
//! ten steps, `old` those after a hundred. `flood` is that of analysis with directions and areas, on the
//! same ground: what fill, routes and areas alone cost there.

mod measure;

use std::hint::black_box;

use landform::analysis::grid::Grid;
use landform::analysis::hydrology::{FlowDirections, fill_depressions};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::rivers::StreamPowerErosion;
use landform::rivers::stream_power::{Creep, Evolution};
use landform::rivers::water::{Algorithm, Columns, PipeSettings, Sweeper};
use landform::synth::{Generator, SpectralFbm};
use measure::{Effort, pairs, table};

fn main() {
    table("Rivers", |effort| {
        let sides: &[usize] = match effort {
            Effort::Quick => &[256],
            Effort::Normal => &[256, 1024],
            Effort::Full => &[256, 1024, 2048],
        };
        for &side in sides {
            let eight = ground(side, Connectivity::Eight);
            sweeps(effort, &eight, "specialised", Algorithm::Specialised, "70 ns");
            sweeps(effort, &eight, "uniform average", Algorithm::UniformAverage, "");
            sweeps(effort, &eight, "weighted average", Algorithm::WeightedAverage, "");
            let pipes = Algorithm::Hydrostatic(PipeSettings::default());
            sweeps(effort, &eight, "pipes, eight", pipes, "");
            sweeps(effort, &ground(side, Connectivity::Four), "pipes, four", pipes, "35 ns");
            few_wet(effort, &eight);
        }
        let sides: &[usize] = match effort {
            Effort::Quick => &[512],
            Effort::Normal => &[512, 1024],
            Effort::Full => &[512, 1024, 2048],
        };
        for &side in sides {
            mountains(effort, side);
        }
    });
}

/// A lattice and its ground.
fn ground(side: usize, connectivity: Connectivity) -> (Lattice, Vec<f64>) {
    let boundary = [Boundary::Periodic; 2];
    let lattice = Lattice::plane([side; 2], 10.0, connectivity, boundary).expect("a lattice");
    let fbm = SpectralFbm { amplitude_m: 100.0, ..SpectralFbm::default() };
    let bed = fbm.generate(&lattice, 1).expect("a terrain");
    (lattice, bed)
}

/// Columns under water that has flowed for some sweeps.
fn flooded(
    (lattice, bed): &(Lattice, Vec<f64>),
    water: &[f64],
    algorithm: Algorithm,
    sweeps: usize,
) -> (Columns, Sweeper, Vec<f64>) {
    let mut columns = Columns::new(lattice).expect("a plane");
    let mut sweeper = Sweeper::new(lattice, algorithm).expect("a plane");
    let mut flows = match algorithm {
        Algorithm::Hydrostatic(_) => vec![0.0; lattice.slots()],
        _ => Vec::new(),
    };
    columns.begin(bed, water).expect("a terrain");
    for _ in 0..sweeps {
        columns.rain(0.1, None).expect("rain");
        sweeper.sweep(&mut columns, &mut flows).expect("flows");
    }
    (columns, sweeper, flows)
}

fn sweeps(
    effort: Effort,
    ground: &(Lattice, Vec<f64>),
    name: &str,
    algorithm: Algorithm,
    reach: &str,
) {
    let count = ground.1.len();
    let (mut columns, mut sweeper, mut flows) = flooded(ground, &vec![0.5; count], algorithm, 40);
    let sweep = || {
        sweeper.sweep(&mut columns, &mut flows).expect("flows");
        count
    };
    let copy = || black_box(&ground.1).clone().len();
    let pair = pairs(effort.rounds(5), sweep, copy);
    let name = format!("{name}, {0}x{0}", ground.0.width());
    pair.print(&name, "copy", reach);
}

/// A hundredth of the cells wet: one of a hundred basins that are alike, against all of them.
fn few_wet(effort: Effort, ground: &(Lattice, Vec<f64>)) {
    let (lattice, bed) = ground;
    let side = lattice.width() / 10;
    let place = |node: usize| {
        let [column, row, _] = lattice.coordinates(node);
        ([column / side, row / side], [column % side, row % side])
    };
    // Walls stand on the northern and western side of each basin, and beyond the last ones.
    let is_wet = |node: usize| {
        let (basin, within) = place(node);
        basin.iter().all(|&at| at < 10) && within.iter().all(|&at| at > 0)
    };
    let level = |node: usize| match is_wet(node) {
        true => bed[lattice.node([place(node).1[0], place(node).1[1], 0])],
        false => 1000.0,
    };
    let basins = (lattice.clone(), (0..bed.len()).map(level).collect::<Vec<_>>());
    let filled = |which: &dyn Fn(usize) -> bool| -> (Columns, Sweeper, usize) {
        let wet = |node: &usize| is_wet(*node) && which(*node);
        let depth = |node: usize| if wet(&node) { 20.0 } else { 0.0 };
        let water: Vec<f64> = (0..bed.len()).map(depth).collect();
        let (columns, sweeper, _) = flooded(&basins, &water, Algorithm::Specialised, 0);
        (columns, sweeper, (0..bed.len()).filter(wet).count())
    };
    let (mut few, mut sweeper, few_count) = filled(&|node| place(node).0 == [0, 0]);
    let (mut all, mut whole, all_count) = filled(&|_| true);
    // As many cells as a sweep of all, so that neither finds its memory cold after the other.
    let part = || {
        for _ in 0..100 {
            sweeper.sweep(&mut few, &mut []).expect("flows");
        }
        100 * few_count
    };
    let rest = || {
        whole.sweep(&mut all, &mut []).expect("flows");
        all_count
    };
    let pair = pairs(effort.rounds(5), part, rest);
    pair.print(&format!("one basin, {0}x{0}", lattice.width()), "a hundred, a wet cell", "1.0");
}

/// Stream power with and without creep, and creep alone.
fn mountains(effort: Effort, side: usize) {
    let lattice = Lattice::plane([side; 2], 100.0, Connectivity::Eight, [Boundary::Open; 2]);
    let lattice = lattice.expect("a lattice");
    let fbm = SpectralFbm { amplitude_m: 250.0, ..SpectralFbm::default() };
    let start = fbm.generate(&lattice, 1).expect("a terrain");
    let streams = StreamPowerErosion { diffusivity_m2_per_yr: 0.0, ..Default::default() };
    let name = |name: &str| format!("stream power, {name}, {side}x{side}");
    let steps = effort.rounds(10);
    for (age, settled, settings) in [
        ("young", 0, streams.clone()),
        ("old", 100, streams.clone()),
        ("old, n = 2", 100, StreamPowerErosion { slope_exponent: 2.0, ..streams.clone() }),
        ("old, with creep", 100, StreamPowerErosion { diffusivity_m2_per_yr: 0.1, ..streams }),
    ] {
        let mut bed = start.clone();
        let mut evolution = Evolution::new(&lattice, &settings).expect("a plane");
        let mut step = |bed: &mut [f64]| evolution.step(bed, &[]).expect("a step");
        (0..settled).for_each(|_| _ = step(&mut bed));
        let flooded = bed.clone();
        let pair = pairs(
            steps,
            || {
                step(&mut bed);
                side * side
            },
            || flood(&lattice, &flooded),
        );
        pair.print(&name(age), "flood", "260 ns");
    }
    let mut creep = Creep::new(&lattice).expect("a plane");
    let mut bed = start.clone();
    let steps = || {
        creep.run(&mut bed, &[], [20.0, 0.2], &mut []);
        20 * side * side
    };
    let copy = || black_box(&start).clone().len();
    pairs(effort.rounds(5), steps, copy).print(&name("a step of creep"), "copy", "0.5 ns");
}

/// Fills, routes and accumulates.
fn flood(lattice: &Lattice, bed: &[f64]) -> usize {
    let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2]);
    let grid = grid.expect("a grid");
    let filled = fill_depressions(&grid, bed).expect("a terrain");
    let directions = FlowDirections::over_filled(&grid, &filled).expect("a terrain");
    black_box(directions.contributing_cells()).len()
}
