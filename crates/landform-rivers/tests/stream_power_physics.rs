//! Stream power against what is known of it: rivers at rest, knickpoints, networks, similarity.

use landform_analysis::grid::Grid;
use landform_analysis::hydrology::{Drainage, fill_depressions};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_rivers::StreamPowerErosion;
use landform_rivers::stream_power::Evolution;
use landform_rivers::water::Side;
use landform_sim::random::RandomStream;

fn plane(size: [usize; 2], spacing: f64) -> Lattice {
    Lattice::plane(size, spacing, Connectivity::Eight, [Boundary::Open; 2]).expect("a lattice")
}

/// A river along a line of nodes, which leaves at the first.
fn river(nodes: usize, settings: StreamPowerErosion) -> (Lattice, StreamPowerErosion) {
    let base_level = Some(vec![Side::North]);
    let settings = StreamPowerErosion { base_level, diffusivity_m2_per_yr: 0.0, ..settings };
    (plane([1, nodes], 100.0), settings)
}

/// Runs for some iterations.
fn run(lattice: &Lattice, settings: &StreamPowerErosion, bed: &mut [f64], iterations: usize) {
    let mut evolution = Evolution::new(lattice, settings).expect("settings that fit");
    for _ in 0..iterations {
        evolution.step(bed, &[]).expect("a step");
    }
}

/// Ground that is level but for centimetres of noise.
fn noise(lattice: &Lattice, seed: u64) -> Vec<f64> {
    let stream = RandomStream::new(seed, "noise");
    (0..lattice.node_count()).map(|node| 0.01 * stream.unit(0, node, 0)).collect()
}

/// S = (U / K)^(1/n) A^(-m/n), exactly: backward Euler has the same steady state at any step.
#[test]
fn a_river_at_rest_has_the_slopes_of_its_areas() {
    for (slope_exponent, area_exponent) in [(1.0, 0.5), (2.0, 0.8), (0.7, 0.3)] {
        let exponents = StreamPowerErosion {
            slope_exponent,
            area_exponent,
            step_yr: 1e5,
            ..Default::default()
        };
        let (lattice, settings) = river(60, exponents);
        let mut bed: Vec<f64> = (0..60).map(|node| 0.1 * f64::from(node)).collect();
        run(&lattice, &settings, &mut bed, 3000);
        for node in 1..60 {
            let area = 1e4 * (60 - node) as f64;
            let slope = (bed[node] - bed[node - 1]) / 100.0;
            let steepness = settings.uplift_m_per_yr / settings.erodibility_m_per_yr;
            let expected = (steepness * area.powf(-area_exponent)).powf(1.0 / slope_exponent);
            assert!((slope / expected - 1.0).abs() < 1e-9, "{node}: {slope} {expected}");
        }
    }
}

/// Uplift doubles: a break of slope runs upstream at K A^m, so it comes to x when the time is the sum of
/// dx / (K A^m) below x. Within two nodes, over 250 of them.
#[test]
fn a_knickpoint_runs_upstream_at_its_celerity() {
    let short = StreamPowerErosion { step_yr: 200.0, ..Default::default() };
    let (lattice, settings) = river(300, short);
    let mut bed: Vec<f64> = (0..300).map(|node| 0.1 * f64::from(node)).collect();
    let settled = StreamPowerErosion { step_yr: 1e6, ..settings.clone() };
    run(&lattice, &settled, &mut bed, 100);
    let celerity = |node: usize| {
        let area = 1e4 * (300 - node) as f64;
        settings.erodibility_m_per_yr * area.powf(settings.area_exponent)
    };
    let faster = StreamPowerErosion { uplift_m_per_yr: 2e-3, ..settings.clone() };
    let mut evolution = Evolution::new(&lattice, &faster).expect("settings that fit");
    let [mut time, mut arrival] = [0.0; 2];
    for node in 1..250 {
        arrival += 100.0 / celerity(node);
        while time < arrival {
            evolution.step(&mut bed, &[]).expect("a step");
            time += settings.step_yr;
        }
        if node % 40 == 0 {
            // Incision between that of before, 1e-3 m/yr, and that to come, 2e-3.
            let rate = |node: usize| celerity(node) * (bed[node] - bed[node - 1]) / 100.0;
            let passed = (1..300).find(|&node| rate(node) < 1.5e-3).expect("a knickpoint");
            assert!(passed.abs_diff(node) <= 2, "at {passed} in place of {node}");
        }
    }
}

/// A block of 256 x 256 nodes that rises above one side: erosion comes to balance uplift, and its rivers are a network.
///
/// Another model of the kind has h 0.61, beta 0.455, concavity 0.50 and h + beta 1.07 at 512 x 512.
/// Divides still move, so quantiles are compared.
#[test]
fn rivers_of_a_rising_block_are_a_network_in_balance() {
    let lattice = plane([256, 256], 100.0);
    let settings = StreamPowerErosion {
        diffusivity_m2_per_yr: 0.0,
        step_yr: 2e4,
        base_level: Some(vec![Side::South]),
        ..Default::default()
    };
    let mut bed = noise(&lattice, 1);
    run(&lattice, &settings, &mut bed, 300);
    let mut evolution = Evolution::new(&lattice, &settings).expect("settings that fit");
    evolution.step(&mut bed, &[]).expect("a step");
    let uplift_m = settings.uplift_m_per_yr * settings.step_yr;
    let inner = (0..bed.len()).filter(|&node| lattice.is_interior(lattice.coordinates(node)));
    let mut balance: Vec<f64> = inner.map(|node| evolution.lost_m()[node] / uplift_m).collect();
    balance.sort_by(f64::total_cmp);
    let [low, middle, high] =
        [0.1, 0.5, 0.9].map(|share| balance[(share * balance.len() as f64) as usize]);
    println!("E/U {low} {middle} {high}");
    assert!((middle - 1.0).abs() < 0.01 && low > 0.9 && high < 1.1, "{low} {middle} {high}");
    let grid = Grid::new([256; 2], [100.0; 2]).expect("a grid");
    let filled = fill_depressions(&grid, &bed).expect("a terrain");
    let drainage = Drainage::over_filled(&grid, &filled).expect("a terrain");
    let hack = drainage.hack.expect("a law").exponent;
    let beta = drainage.exceedance.expect("a law").exponent;
    let concavity = drainage.slope_area.expect("a law").concavity.exponent;
    println!("h {hack} beta {beta} theta {concavity}");
    assert!((0.56..0.66).contains(&hack), "{hack}");
    assert!((0.40..0.50).contains(&beta), "{beta}");
    assert!((hack + beta - 1.05).abs() < 0.07, "{hack} {beta}");
    assert!((concavity - 0.5).abs() < 0.02, "{concavity}");
}

/// Theodoratos, Seybold and Kirchner 2018: with m = 0.5 and n = 1, terrains whose lengths go as
/// sqrt(D / K), heights as U / K and times as 1 / K are copies of each other. By powers of two, bit for
/// bit.
#[test]
fn scaled_runs_are_scaled_copies() {
    let settings = StreamPowerErosion {
        diffusivity_m2_per_yr: 0.05,
        uplift_m_per_yr: 3e-4,
        step_yr: 3e4,
        ..Default::default()
    };
    let evolve = |area_exponent: f64, [length, height, time]: [f64; 3]| {
        let lattice = plane([70, 50], 50.0 * length);
        let scaled = StreamPowerErosion {
            area_exponent,
            erodibility_m_per_yr: settings.erodibility_m_per_yr / time,
            diffusivity_m2_per_yr: settings.diffusivity_m2_per_yr * length * length / time,
            uplift_m_per_yr: settings.uplift_m_per_yr * height / time,
            step_yr: settings.step_yr * time,
            ..settings.clone()
        };
        let mut bed: Vec<f64> = noise(&lattice, 4).iter().map(|z| z * height).collect();
        run(&lattice, &scaled, &mut bed, 60);
        bed.iter().map(|z| z / height).collect::<Vec<f64>>()
    };
    let first = evolve(0.5, [1.0; 3]);
    assert!(first.iter().copied().fold(0.0, f64::max) > 10.0);
    for factors in [[4.0, 1.0, 1.0], [0.5, 8.0, 0.25], [16.0, 0.125, 4.0]] {
        assert!(evolve(0.5, factors) == first, "{factors:?}");
    }
    // Another area exponent has another length.
    let differs = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() > 0.1;
    let [one, two] = [1.0, 4.0].map(|length| evolve(0.4, [length, 1.0, 1.0]));
    assert!(one.iter().zip(&two).any(differs));
}
