//! One pressure, whatever the way to it.

use super::reference::{by_front, by_rounds, by_sweeps};
use super::*;
use crate::stage_one::{Seed, weighted_distances};
use landform_graph::{Boundary, Connectivity};
use landform_sim::random::RandomStream;
use proptest::prelude::*;

/// Lattices of every kind that caves may have.
fn lattices() -> [Lattice; 5] {
    let plane = |kind| Lattice::plane([12, 9], 2.0, kind, [Boundary::Open; 2]).unwrap();
    let open = [Boundary::Open; 3];
    let volume = |kind, boundary| Lattice::volume([7, 6, 5], 2.0, kind, boundary).unwrap();
    [
        plane(Connectivity::FourEight),
        plane(Connectivity::Eight),
        volume(Connectivity::Voxel6, open),
        volume(Connectivity::Voxel26, open),
        volume(Connectivity::Voxel26, [Boundary::Periodic, Boundary::Open, Boundary::Open]),
    ]
}

/// Channels that grow by walks at random from random voxels, in steps.
fn growing_channels(lattice: &Lattice, seed: u64) -> Vec<Vec<usize>> {
    let random = RandomStream::new(seed, "walks");
    let mut taken = vec![false; lattice.node_count()];
    let mut node = random.block(0, 0, 0)[0] as usize % lattice.node_count();
    (0..8)
        .map(|step| {
            let mut opened = Vec::new();
            for turn in 0..5 {
                let pick = random.block(step, turn, 1)[0] as usize;
                let edges: Vec<Edge> = lattice.neighbours(node).collect();
                node = edges[pick % edges.len()].node;
                if !std::mem::replace(&mut taken[node], true) {
                    opened.push(node);
                }
            }
            opened
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Incremental or from scratch, by buckets, fronts, rounds or sweeps: the same bits.
    #[test]
    fn every_schedule_gives_the_same_bits(
        seed in any::<u64>(), kind in 0..5_usize, ratio in -4..1_i32,
    ) {
        let lattice = &lattices()[kind];
        let rates = Rates { rock_per_m: 0.5, channel_per_m: 0.5 * 10_f64.powi(ratio) };
        let random = RandomStream::new(seed, "pressure");
        let before: Vec<f64> =
            (0..lattice.node_count()).map(|node| 20.0 * random.unit(0, node, 0)).collect();
        let sink = random.block(1, 0, 0)[0] as usize % lattice.node_count();
        let mut channel = vec![false; lattice.node_count()];
        let mut pressure = before.clone();
        pressure[sink] = 0.0;
        let mut avalanches = Avalanches::new();
        avalanches.settle(lattice, &mut pressure, rates, |_| false).unwrap();
        for opened in growing_channels(lattice, seed) {
            opened.iter().for_each(|&node| channel[node] = true);
            let mut by_listing = pressure.clone();
            let followed =
                avalanches.follow(lattice, &mut pressure, rates, |node| channel[node], &opened);
            prop_assert!(followed.is_ok());

            let everywhere: Vec<usize> = (0..lattice.node_count()).collect();
            by_front(lattice, &mut by_listing, rates, &channel, &everywhere);
            prop_assert_eq!(&by_listing, &pressure);

            let mut afresh = before.clone();
            afresh[sink] = 0.0;
            let mut rounds = afresh.clone();
            by_sweeps(lattice, &mut afresh, rates, &channel);
            prop_assert_eq!(&afresh, &pressure);

            by_rounds(lattice, &mut rounds, rates, &channel, &everywhere);
            prop_assert_eq!(&rounds, &pressure);
        }
    }
}

/// In rock alone pressure is the rate times the distance over edges from the sink.
#[test]
fn pressure_around_a_sink_rises_at_the_rate_of_rock() {
    let lattice =
        Lattice::volume([9, 9, 9], 2.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap();
    let rates = Rates { rock_per_m: 0.5, channel_per_m: 0.001 };
    let mut pressure = vec![100.0; lattice.node_count()];
    pressure[lattice.node([0, 0, 0])] = 0.0;
    Avalanches::new().settle(&lattice, &mut pressure, rates, |_| false).unwrap();
    for (at, metres) in
        [([8, 0, 0], 16.0), ([5, 5, 0], 10.0 * 2_f64.sqrt()), ([3, 3, 3], 6.0 * 3_f64.sqrt())]
    {
        assert!((pressure[lattice.node(at)] - 0.5 * metres).abs() < 1e-12);
    }
}

/// Thesis, section 5.3: the same channels for rates and pressure of the same ratio.
#[test]
fn scaled_rates_give_scaled_pressure() {
    let lattice = Lattice::plane([30, 30], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let settle = |scale: f64| {
        let rates = Rates { rock_per_m: 0.0025 * scale, channel_per_m: 0.001 * scale };
        let mut pressure = vec![0.05 * scale; 900];
        pressure[lattice.node([29, 20, 0])] = 0.0;
        let channel = |node: usize| lattice.coordinates(node)[0] == 15;
        Avalanches::new().settle(&lattice, &mut pressure, rates, channel).unwrap();
        pressure
    };
    for (one, twenty) in settle(1.0).into_iter().zip(settle(20.0)) {
        assert!((20.0 * one - twenty).abs() <= 1e-14 * twenty.max(1.0));
    }
    let exact: Vec<f64> = settle(1.0).into_iter().map(|pressure| 16.0 * pressure).collect();
    assert_eq!(settle(16.0), exact, "powers of two are exact");
}

#[test]
fn initial_pressure_falls_from_the_sources() {
    let lattice = Lattice::plane([11, 1], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let seed = Seed { node: 0, source: 0, pressure: 1.0 };
    let distances = weighted_distances(&lattice, |node| node < 6, &[seed]).unwrap();
    let pressure = initial_pressure(&distances, 10.0, 0.5);
    assert_eq!(pressure[..6], [10.0, 9.0, 8.0, 7.0, 6.0, 5.0]);
    assert_eq!(pressure[6..], [5.0; 5]);
    assert!(Rates { rock_per_m: 0.1, channel_per_m: 0.2 }.check().is_err());
    assert!(Rates { rock_per_m: 0.5, channel_per_m: 0.001 }.check().is_ok());
}
