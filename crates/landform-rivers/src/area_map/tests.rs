//! Tests of the kernel: steady states that are known exactly, booking, refusals.

use landform_graph::{Boundary, Connectivity, Lattice};

use super::{AreaMapErosion, evolve};
use crate::RiverError;

fn strip(nodes: usize) -> Lattice {
    Lattice::plane([1, nodes], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap()
}

/// Runs until the largest change in an iteration is tiny; only the nodes of `fixed` are held.
fn settle(lattice: &Lattice, settings: &AreaMapErosion, fixed: &[usize]) -> Vec<f64> {
    let mut bed: Vec<f64> = (0..lattice.node_count()).map(|node| 0.01 * node as f64).collect();
    for _ in 0..20_000 {
        let before = bed.clone();
        evolve(lattice, settings, &mut bed, fixed).unwrap();
        if before.iter().zip(&bed).all(|(a, b)| (a - b).abs() < 1e-10) {
            return bed;
        }
    }
    panic!("the terrain does not come to rest");
}

/// Creep alone: a parabola, z = U/(2D) x (L - x) between two ends.
#[test]
fn a_hillslope_at_rest_is_a_parabola() {
    let lattice = strip(21);
    let settings = AreaMapErosion { erodibility_m_per_yr: 0.0, ..Default::default() };
    let bed = settle(&lattice, &settings, &[0, 20]);
    for (node, height) in bed.iter().enumerate() {
        let (x, rest) = (10.0 * node as f64, 10.0 * (20 - node) as f64);
        let expected = 0.2 + (bed[0] - 0.2) * rest / 200.0 + (bed[20] - 0.2) * x / 200.0;
        let expected = expected + 1e-4 / (2.0 * 0.01) * x * rest;
        assert!((height - expected).abs() < 1e-5, "{node}: {height} {expected}");
    }
}

/// Streams alone: slopes S = (U / (K A^m))^(1/n).
#[test]
fn a_stream_at_rest_has_the_slopes_of_its_area() {
    let lattice = strip(30);
    for slope_exponent in [1.0, 2.0] {
        let settings = AreaMapErosion {
            diffusivity_m2_per_yr: 0.0,
            slope_exponent,
            base_level: Some(Vec::new()),
            ..Default::default()
        };
        let bed = settle(&lattice, &settings, &[0]);
        // All water runs down to node 0, so a node drains itself and all above it.
        for node in 1..29 {
            let area = 100.0 * (30 - node) as f64;
            let slope = (bed[node] - bed[node - 1]) / 10.0;
            let expected = (1e-4 / (1e-4 * area.sqrt())).powf(1.0 / slope_exponent);
            assert!((slope / expected - 1.0).abs() < 1e-6, "{node}: {slope} {expected}");
        }
    }
}

#[test]
fn what_changed_is_booked_and_the_fixed_stay() {
    let open = [Boundary::Open; 2];
    let lattice = Lattice::plane([12, 9], 10.0, Connectivity::Eight, open).unwrap();
    let bed: Vec<f64> = (0..108).map(|node| f64::from(node * 37 % 101)).collect();
    let mut after = bed.clone();
    let settings = AreaMapErosion::default();
    let evolved = evolve(&lattice, &settings, &mut after, &[0, 50]).unwrap();
    assert_eq!((after[0], after[50]), (bed[0], bed[50]));
    let change: f64 = after.iter().zip(&bed).map(|(after, before)| after - before).sum();
    let booked = evolved.change;
    let sum = booked.uplifted_m + booked.deposited_m - booked.eroded_m;
    assert!((change - sum).abs() < 1e-9);
    let most = evolved.area_m2.iter().copied().fold(0.0, f64::max);
    assert!((100.0..=10_800.0).contains(&most));
}

#[test]
fn what_does_not_suit_is_refused() {
    let long = AreaMapErosion { step_yr: 1e9, ..Default::default() };
    assert!(matches!(long.check(&strip(9)), Err(RiverError::LongStep { .. })));
    let four = Lattice::plane([9, 9], 10.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
    let error = AreaMapErosion::default().check(&four);
    assert_eq!(error, Err(RiverError::Unsuited(Connectivity::Four)));
}
