//! Multifractals: rough here and smooth there, which a sum of octaves is not.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{Cascade, FractalNoise, Generator, OctaveShape};

const SIDE: usize = 256;
/// Side of the blocks whose roughness is compared.
const BLOCK: usize = 32;
const SEEDS: u64 = 6;

fn surface(cascade: Cascade, shape: OctaveShape, seed: u64) -> Vec<f64> {
    let lattice =
        Lattice::plane([SIDE; 2], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let noise =
        FractalNoise { wavelength_m: 640.0, hurst: 0.5, cascade, shape, ..Default::default() };
    noise.generate(&lattice, seed).unwrap()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean of the centred values to a power.
fn moment(values: &[f64], power: i32) -> f64 {
    let middle = mean(values);
    mean(&values.iter().map(|value| (value - middle).powi(power)).collect::<Vec<_>>())
}

/// How much roughness varies from block to block: standard deviation of the logarithm of the mean
/// squared difference of neighbours. A surface that is equally rough everywhere has a small one.
fn intermittency(heights: &[f64]) -> f64 {
    let mut roughness = Vec::new();
    for block in 0..(SIDE / BLOCK).pow(2) {
        let [left, top] = [block % (SIDE / BLOCK), block / (SIDE / BLOCK)].map(|n| n * BLOCK);
        let rows = (top..top + BLOCK).map(|y| &heights[left + SIDE * y..][..BLOCK]);
        let squares = rows.flat_map(|row| row.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)));
        roughness.push(mean(&squares.collect::<Vec<_>>()).ln());
    }
    moment(&roughness, 2).sqrt()
}

fn skewness(heights: &[f64]) -> f64 {
    moment(heights, 3) / moment(heights, 2).powf(1.5)
}

/// Means over the seeds of intermittency and skewness.
fn statistics(cascade: Cascade, shape: OctaveShape) -> [f64; 2] {
    let surfaces: Vec<Vec<f64>> = (0..SEEDS).map(|seed| surface(cascade, shape, seed)).collect();
    [intermittency, skewness]
        .map(|of| mean(&surfaces.iter().map(|each| of(each)).collect::<Vec<_>>()))
}

#[test]
fn multifractals_are_rough_here_and_smooth_there() {
    let [sum, sum_skew] = statistics(Cascade::Sum, OctaveShape::Plain);
    println!("sum: intermittency {sum:.3}, skewness {sum_skew:.3}");
    assert!(sum_skew.abs() < 0.2);
    for (cascade, shape) in [
        (Cascade::Multiplicative { offset: 1.0 }, OctaveShape::Plain),
        (Cascade::Hybrid { offset: 0.7 }, OctaveShape::Plain),
        (Cascade::Ridged { gain: 2.0 }, OctaveShape::SharpRidges),
    ] {
        let [varies, skew] = statistics(cascade, shape);
        println!("{cascade:?}: intermittency {varies:.3}, skewness {skew:.3}");
        assert!(varies > 1.5 * sum, "{cascade:?}: {varies} {sum}");
        // Products of factors have few high places; the others may lean either way.
        if matches!(cascade, Cascade::Multiplicative { .. }) {
            assert!(skew > 0.5, "{cascade:?}: {skew}");
        }
    }
}

/// A larger offset makes every factor closer to the same, and the surface closer to a sum.
#[test]
fn the_offset_takes_the_intermittency_away() {
    let varies = |offset| statistics(Cascade::Multiplicative { offset }, OctaveShape::Plain)[0];
    let measured = [1.0, 2.0, 5.0].map(varies);
    println!("{measured:?}");
    assert!(measured.is_sorted_by(|small, large| small > large), "{measured:?}");
}
