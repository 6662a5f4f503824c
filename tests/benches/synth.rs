//! Initial conditions, nanoseconds a sample.
//!
//! - `8 octaves`: fractional Brownian motion by noise-summing against `fastnoise-lite`, a noise
//!   library that is called once a sample and computes with half the digits: with the cells of all
//!   octaves along the axes, turned from octave to octave, and of simplex noise;
//! - `8 cellular octaves`: distances to the nearest points, against the same library's;
//! - `Dendry`: distances to a tree of four levels and terrain around one of three, on 512 by 512 nodes as in
//!   the paper, against the definition, which grows the tree anew for every node;
//! - `spectral fBm`: against the inverse transforms alone, along contiguous columns and rows, without
//!   random numbers and without a transposition.

mod measure;

use std::hint::black_box;
use std::path::Path;

use fastnoise_lite::{CellularReturnType, FastNoiseLite, FractalType, NoiseType};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::synth::{
    Basis, Dendry, DendryTerrain, DendryView, FractalNoise, Generator, Node, SpectralFbm,
};
use measure::{Effort, pairs, table};
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use rustfft::FftPlanner;

fn main() {
    table("Synthesis", |effort| {
        let sides: &[usize] = match effort {
            Effort::Quick => &[512],
            Effort::Normal => &[1024],
            Effort::Full => &[1024, 4096],
        };
        for &side in sides {
            let open = [Boundary::Open; 2];
            let lattice = Lattice::plane([side; 2], 1.0, Connectivity::Eight, open);
            let lattice = lattice.expect("a lattice");
            octaves(effort, &lattice);
            spectral(effort, &lattice);
        }
        dendry(effort);
    });
}

fn octaves(effort: Effort, lattice: &Lattice) {
    let level = FractalNoise { wavelength_m: 256.0, rotation_deg: 0.0, ..Default::default() };
    let turned = FractalNoise { rotation_deg: 37.0, ..level };
    let simplex = FractalNoise { basis: Basis::Simplex, ..turned };
    let cellular = FractalNoise { basis: Basis::CellularNearest, ..turned };
    let cases = [
        ("8 octaves", level, NoiseType::Perlin, "80 ns"),
        ("8 turned octaves", turned, NoiseType::Perlin, "80 ns"),
        ("8 turned simplex octaves", simplex, NoiseType::OpenSimplex2, ""),
        ("8 turned cellular octaves", cellular, NoiseType::Cellular, ""),
    ];
    for (name, noise, kind, reach) in cases {
        let ours = || black_box(noise.generate(lattice, 1).expect("a surface")).len();
        let peer = peer(kind);
        let theirs = || {
            let [width, height] = [lattice.width(), lattice.height()];
            let places = (0..height).flat_map(|y| (0..width).map(move |x| [x as f32, y as f32]));
            black_box(places.map(|[x, y]| peer.get_noise_2d(x, y)).collect::<Vec<f32>>()).len()
        };
        let name = format!("{name}, {0}x{0}", lattice.width());
        pairs(effort.rounds(5), ours, theirs).print(&name, "fastnoise-lite", reach);
    }
}

/// The library's fractional Brownian motion with the same wavelengths.
fn peer(kind: NoiseType) -> FastNoiseLite {
    let mut peer = FastNoiseLite::with_seed(1);
    peer.set_noise_type(Some(kind));
    peer.set_cellular_return_type(Some(CellularReturnType::Distance));
    peer.set_fractal_type(Some(FractalType::FBm));
    peer.set_fractal_octaves(Some(8));
    peer.set_frequency(Some(1.0 / 256.0));
    peer
}

fn dendry(effort: Effort) {
    const SIDE: usize = 512;
    let noise =
        FractalNoise { amplitude_m: 300.0, wavelength_m: 1024.0, octaves: 1, ..Default::default() };
    let terrain = DendryTerrain { relief_m: Some([-150.0, 150.0]), ..Default::default() };
    let distance = Dendry { levels: 4, cell_m: 512.0 / 3.0, ..Default::default() };
    let terrain = Dendry {
        control: Node::Noise(noise),
        cell_m: 128.0,
        levels: 3,
        shows: DendryView::Terrain(terrain),
        ..Default::default()
    };
    let cases =
        [("distance, n = 4", distance, 100, "50 ns"), ("terrain, n = 3", terrain, 4, "150 ns")];
    for (name, dendry, defined, reach) in cases {
        let function = dendry.function(Path::new(""), 1.0, 5).expect("a function");
        let ours = || black_box(function.values([0; 2], [SIDE; 2])).len();
        let definition = || {
            let nodes = (0..defined).map(|node| [node * 37 % 512, node * 101 % 512]);
            black_box(nodes.map(|node| function.value(node)).sum::<f64>());
            defined as usize
        };
        let name = format!("Dendry, {name}, {SIDE}x{SIDE}");
        pairs(effort.rounds(5), ours, definition).print(&name, "its definition", reach);
    }
}

fn spectral(effort: Effort, lattice: &Lattice) {
    let side = lattice.width();
    let ours = || black_box(SpectralFbm::default().generate(lattice, 1).expect("a surface")).len();
    let mut columns = vec![Complex::new(1e-3, 0.0); (side / 2 + 1) * side];
    let mut heights = vec![0.0; side * side];
    let down = FftPlanner::<f64>::new().plan_fft_inverse(side);
    let along = RealFftPlanner::<f64>::new().plan_fft_inverse(side);
    let mut scratch = vec![Complex::default(); down.get_inplace_scratch_len()];
    let mut row_scratch = along.make_scratch_vec();
    let bound = || {
        columns.fill(Complex::new(1e-3, 0.0));
        down.process_with_scratch(&mut columns, &mut scratch);
        for (waves, heights) in columns.chunks_mut(side / 2 + 1).zip(heights.chunks_mut(side)) {
            waves[0].im = 0.0;
            waves[side / 2].im = 0.0;
            along.process_with_scratch(waves, heights, &mut row_scratch).expect("equal lengths");
        }
        black_box(&heights).len()
    };
    // 0.4 s for 4096 x 4096 samples.
    let name = format!("spectral fBm, {side}x{side}");
    pairs(effort.rounds(5), ours, bound).print(&name, "its inverse transforms", "24 ns");
}
