//! Caves: pressure, water and erosion of a growing cave, and the largest flow through rock.
//!
//! - `growth`: a whole run of 240 iterations in 60x60x20 voxels from three sources to a sink, an
//!   iteration and voxel, against copying porosity and pressure;
//! - `pressure, all`: from scratch in 64x64x64 (128x128x128) voxels, a voxel, against Dijkstra's
//!   algorithm as a front with a heap;
//! - `pressure, 20 opened`: an avalanche from twenty voxels that become a channel, in 128x128x128 (with
//!   `--full` 256x256x256) voxels against the same in 64x64x64, with a reach of 20 voxels: the cost is
//!   that of what it reaches, whatever the size of the block;
//! - `protochannels`: the largest flow to 60 protosinks in 60x60x20 voxels, a voxel, against the same
//!   copy;
//! - `largest flow`: from a voxel in the middle of 128x128x128 to 60 on its borders, a voxel, with as
//!   few edges as possible, against a front by buckets over the same voxels.

mod measure;

use std::hint::black_box;

use landform::caves::erosion::Dissolution;
use landform::caves::growth::{ChannelGrowth, GrowthLaw, Motion, Openings};
use landform::caves::pressure::{Avalanches, Rates};
use landform::caves::stage_one::{Seed, pressure_zones, protochannels, protosinks};
use landform::caves::water::PoreWater;
use landform::graph::marching::{Front, Relaxation};
use landform::graph::max_flow::{Terminal, maximum_flow};
use landform::graph::{Boundary, Connectivity, Edge, Lattice};
use landform::sim::random::RandomStream;
use landform::synth::{Generator, SmoothNoise};
use measure::{Effort, pairs, table};

const RATES: Rates = Rates { rock_per_m: 0.5, channel_per_m: 0.001 };

fn main() {
    table("Caves", |effort| {
        growth(effort);
        network(effort);
        let sides: &[usize] = match effort {
            Effort::Quick => &[64],
            Effort::Normal => &[64, 128],
            Effort::Full => &[64, 128, 256],
        };
        sides.iter().for_each(|&side| pressure(effort, side));
        let larger = if effort == Effort::Full { 256 } else { 128 };
        avalanche(effort, larger);
        largest_flow(effort, if effort == Effort::Quick { 64 } else { 128 });
    });
}

fn block(size: [usize; 3]) -> Lattice {
    Lattice::volume(size, 1.0, Connectivity::Voxel26, [Boundary::Open; 3]).expect("a block")
}

fn rock(lattice: &Lattice) -> Vec<f64> {
    let noise = SmoothNoise {
        mean_m: 0.15,
        standard_deviation_m: 0.03,
        correlation_length_m: 3.0,
        ..SmoothNoise::default()
    };
    let field = noise.generate(lattice, 1).expect("noise");
    field.into_iter().map(|porosity| porosity.clamp(0.01, 0.3)).collect()
}

fn growth(effort: Effort) {
    const ITERATIONS: usize = 240;
    let lattice = block([60, 60, 20]);
    let porosity = rock(&lattice);
    let at = |x, y, z| vec![lattice.node([x, y, z])];
    let openings = Openings {
        sources: vec![at(9, 47, 15), at(18, 12, 13), at(35, 41, 15)],
        pressures: vec![1.0; 3],
        strengths: vec![1.0; 3],
        sinks: at(59, 24, 4),
    };
    let motion = Motion::Pressure { rates: RATES, exponent: 4, most: 30.0, fall: 0.5 };
    let dissolution = Dissolution {
        rate: 0.15,
        contributed_weight: 0.25,
        exponent: 1.0,
        contributed_fraction: 0.1,
    };
    let law = GrowthLaw { motion, dissolution, passage: 0.35, sweeps: 1 };
    let run = || {
        let mut porosity = porosity.clone();
        let mut water = PoreWater::dry(porosity.len());
        let cave = ChannelGrowth::new(&lattice, law, openings.clone(), &porosity);
        let mut cave = cave.expect("a cave");
        let mut pressure = cave.first_pressure(&lattice, &porosity).expect("pressure");
        for _ in 0..ITERATIONS {
            let moved = cave.step(&lattice, &mut water, &mut porosity, &mut pressure);
            black_box(moved.expect("a step"));
        }
        ITERATIONS * porosity.len()
    };
    let pair = pairs(effort.rounds(5), run, || copies(&porosity));
    pair.print("growth, a voxel and iteration", "copy of two fields", "29 ns");
}

/// Copies two fields; returns the number of voxels.
fn copies(field: &[f64]) -> usize {
    black_box(black_box(field).to_vec());
    black_box(black_box(field).to_vec());
    field.len()
}

fn network(effort: Effort) {
    let lattice = block([60, 60, 20]);
    let porosity = rock(&lattice);
    let node = lattice.node([30, 30, 10]);
    let seeds = [Seed { node, source: 0, pressure: 1.0 }];
    let zones = pressure_zones(&lattice, |_| true, &seeds).expect("zones");
    let random = RandomStream::new(1, "protosinks");
    let limits = (60, f64::INFINITY);
    let sinks = protosinks(&lattice, &zones, (0, node), limits, None, |_| true, &random);
    let sinks: Vec<(usize, u32)> = sinks.into_iter().map(|node| (node, 0)).collect();
    let channels = || {
        let network = protochannels(&lattice, &porosity, &zones, &seeds, &sinks);
        black_box(network.expect("channels"));
        porosity.len()
    };
    let pair = pairs(effort.rounds(5), channels, || copies(&porosity));
    pair.print("protochannels, 60 protosinks, a voxel", "copy of two fields", "2800 ns");
}

fn pressure(effort: Effort, side: usize) {
    let lattice = block([side; 3]);
    let sink = lattice.node([side - 1, side / 2, side / 4]);
    let mut first = vec![1e6; lattice.node_count()];
    first[sink] = 0.0;
    let mut avalanches = Avalanches::new();
    let buckets = || {
        let mut pressure = first.clone();
        let settled = avalanches.follow(&lattice, &mut pressure, RATES, |_| false, &[sink]);
        black_box(settled.expect("pressure"));
        pressure.len()
    };
    let mut front = Front::new();
    let heap = || {
        let mut pressure = first.clone();
        let marched = front.march(&lattice, &[(sink, 0.0)], |from, edge| {
            let through = pressure[from] + RATES.rock_per_m * edge.distance;
            (through < pressure[edge.node]).then(|| {
                pressure[edge.node] = through;
                through
            })
        });
        black_box(marched.expect("a front"));
        pressure.len()
    };
    let name = format!("pressure, all, {side}^3, a voxel");
    pairs(effort.rounds(5), buckets, heap).print(&name, "a front with a heap", "160 ns");
}

/// A block whose pressure is settled, and a channel that opens in its middle.
struct Opening {
    lattice: Lattice,
    avalanches: Avalanches,
    pressure: Vec<f64>,
    before: Vec<f64>,
    opened: Vec<usize>,
}

impl Opening {
    fn new(side: usize) -> Self {
        let lattice = block([side; 3]);
        let opened: Vec<usize> =
            (0..20).map(|x| lattice.node([side / 2 - 10 + x, side / 2, side / 2])).collect();
        // The end of the channel drains; what is farther than the reach stays at the pressure of rock.
        let mut before = vec![20.0 * RATES.rock_per_m; lattice.node_count()];
        before[opened[0]] = 0.0;
        let mut avalanches = Avalanches::new();
        let settled = avalanches.settle(&lattice, &mut before, RATES, |_| false);
        settled.expect("pressure");
        Self { lattice, avalanches, pressure: before.clone(), before, opened }
    }

    /// Opens the channel and puts everything around it back; returns how many voxels that were.
    fn run(&mut self) -> usize {
        let Self { lattice, avalanches, pressure, before, opened } = self;
        let (first, last) = (opened[0], opened[opened.len() - 1]);
        let channel = |node: usize| (first..=last).contains(&node);
        let followed = avalanches.follow(lattice, pressure, RATES, channel, opened);
        black_box(followed.expect("pressure"));
        let [x, y, z] = lattice.coordinates(first);
        for (z, y) in (z - 22..z + 22).flat_map(|z| (y - 22..y + 22).map(move |y| (z, y))) {
            let row = lattice.node([x - 22, y, z])..lattice.node([x + 41, y, z]);
            pressure[row.clone()].copy_from_slice(&before[row]);
        }
        44 * 44 * 63
    }
}

fn avalanche(effort: Effort, side: usize) {
    let [mut small, mut large] = [64, side].map(Opening::new);
    let pair = pairs(effort.rounds(15), || large.run(), || small.run());
    assert!(small.pressure == small.before && large.pressure == large.before, "all put back");
    let name = format!("pressure, 20 opened, {side}^3, a voxel in reach");
    pair.print(&name, "the same, 64^3", "ratio 1");
}

fn largest_flow(effort: Effort, side: usize) {
    let lattice = block([side; 3]);
    let random = RandomStream::new(1, "rock and sinks");
    let units: Vec<u32> =
        (0..lattice.node_count()).map(|node| 20 + random.block(0, node, 0)[0] % 100).collect();
    let capacity = |from: usize, edge: &Edge| units[from].min(units[edge.node]);
    let middle = lattice.node([side / 2; 3]);
    let source = Terminal { node: middle, most: u64::MAX };
    // On all six sides, ten each.
    let sink = |number: usize| {
        let draw = |index: u32| random.block(1, number, index)[0] as usize % side;
        let mut at = [draw(0), draw(1), draw(2)];
        at[number % 3] = if number % 6 < 3 { 0 } else { side - 1 };
        Terminal { node: lattice.node(at), most: u64::from(u32::MAX) }
    };
    let sinks: Vec<Terminal> = (0..60).map(sink).collect();
    let flow = || {
        let flow = maximum_flow(&lattice, capacity, |_, _| 1.0, &[source], &sinks);
        black_box(flow.expect("a flow"));
        units.len()
    };
    let mut relaxation = Relaxation::new();
    let front = || {
        let mut values = vec![f64::INFINITY; units.len()];
        values[middle] = 0.0;
        let relaxed = relaxation.relax(&lattice, &mut values, &[middle], 2.0, |_, _| 1.0);
        black_box(relaxed.expect("a front"));
        units.len()
    };
    let name = format!("largest flow, {side}^3 to 60 voxels, a voxel");
    pairs(effort.rounds(5), flow, front).print(&name, "a front by buckets", "320 ns");
}
