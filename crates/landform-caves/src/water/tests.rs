//! Water against the listing, and against what it keeps.

use super::*;
use landform_graph::{Boundary, Connectivity};
use landform_sim::random::RandomStream;
use proptest::prelude::*;

fn block(size: [usize; 3]) -> Lattice {
    Lattice::volume(size, 1.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap()
}

/// Random rock, some of it impermeable, with water in it.
fn any_water(lattice: &Lattice, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let random = RandomStream::new(seed, "water");
    let draw = |node, index| random.unit(0, node, index);
    let porosity = |node| (1.2 * draw(node, 0) - 0.2).max(0.0);
    let porosity: Vec<f64> = (0..lattice.node_count()).map(porosity).collect();
    let water =
        |node: usize| if draw(node, 1) < 0.5 { 0.0 } else { porosity[node] * draw(node, 2) };
    let water = (0..porosity.len()).map(water).collect();
    (porosity, water)
}

/// Water in rock, before anything moves.
fn filled(porosity: &[f64], shares: &[f64]) -> PoreWater {
    let mut water = PoreWater::dry(porosity.len());
    for (node, &share) in shares.iter().enumerate() {
        water.feed(porosity, node, share);
    }
    water.begin_iteration();
    water
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The listing, up to a few units of rounding, and not a unit lost.
    #[test]
    fn sweeps_are_those_of_the_listing(seed in any::<u64>(), plane in any::<bool>()) {
        let lattice = match plane {
            true => Lattice::plane([9, 7], 1.0, Connectivity::FourEight, [Boundary::Open; 2]).unwrap(),
            false => block([6, 5, 4]),
        };
        let (porosity, wet) = any_water(&lattice, seed);
        let random = RandomStream::new(seed, "pressure");
        let pressure: Vec<f64> =
            (0..lattice.node_count()).map(|node| (8.0 * random.unit(0, node, 0)).floor()).collect();
        let mut water = filled(&porosity, &wet);
        let capacity: Vec<f64> =
            porosity.iter().map(|porosity| (porosity * UNIT).floor() / UNIT).collect();
        let rule = DownPressure { pressure: &pressure, exponent: 1 };
        let all = water.total();
        for _ in 0..4 {
            let before = water.content_shares();
            let (after, received) = reference::sweep(&lattice, &pressure, &capacity, &before);
            water.begin_iteration();
            water.sweep(&lattice, &rule, &porosity);
            for node in 0..lattice.node_count() {
                let found = f64::from(water.contents(node)) / UNIT;
                prop_assert!((found - after[node]).abs() < 60.0 / UNIT);
                let found = f64::from(water.received(node)) / UNIT;
                prop_assert!((found - received[node]).abs() < 60.0 / UNIT);
                prop_assert!(water.contents(node) <= water.in_rock(&porosity).capacity(node));
            }
            prop_assert_eq!(water.total(), all);
            prop_assert!(water.wet().is_sorted());
        }
    }

    /// Water that falls is kept, and none of it rises.
    #[test]
    fn falling_water_only_falls(seed in any::<u64>()) {
        let lattice = block([6, 5, 7]);
        let (porosity, wet) = any_water(&lattice, seed);
        let mut water = filled(&porosity, &wet);
        let above = |water: &PoreWater, layer: usize| -> u64 {
            (layer * 30..lattice.node_count()).map(|node| u64::from(water.contents(node))).sum()
        };
        let all = water.total();
        for _ in 0..5 {
            let before: Vec<u64> = (0..7).map(|layer| above(&water, layer)).collect();
            water.sweep(&lattice, &Falling, &porosity);
            prop_assert_eq!(water.total(), all);
            for (layer, before) in before.into_iter().enumerate() {
                prop_assert!(above(&water, layer) <= before);
            }
            let pores = water.in_rock(&porosity);
            let fits = (0..lattice.node_count()).all(|node| pores.contents(node) <= pores.capacity(node));
            prop_assert!(fits);
        }
    }
}

#[test]
fn symmetric_rock_keeps_water_symmetric() {
    let lattice = block([9, 9, 5]);
    let mirror = |node: usize| {
        let [x, y, z] = lattice.coordinates(node);
        lattice.node([8 - x, y, z])
    };
    let pressure: Vec<f64> = (0..405).map(|node| lattice.coordinates(node)[1] as f64).collect();
    let mut water = PoreWater::dry(405);
    for _ in 0..12 {
        water.feed(&[0.3; 405], lattice.node([4, 8, 2]), 1.0);
        water.sweep(&lattice, &DownPressure { pressure: &pressure, exponent: 1 }, &[0.3; 405]);
    }
    assert!(water.wet().len() > 100);
    assert!((0..405).all(|node| water.contents(node) == water.contents(mirror(node))));
}

#[test]
fn water_falls_straight_before_it_spreads() {
    let lattice = block([5, 5, 4]);
    let (rock, mut water) = ([0.5; 100], PoreWater::dry(100));
    let at = |x, z| lattice.node([x, 2, z]);
    assert_eq!(water.feed(&rock, at(2, 3), 1.0), (0.5 * UNIT) as u32);
    for layer in [2, 1, 0] {
        water.sweep(&lattice, &Falling, &rock);
        assert_eq!(water.contents(at(2, layer)), (0.5 * UNIT) as u32);
    }
    // On the floor it evens out with the eight beside.
    water.sweep(&lattice, &Falling, &rock);
    let even = (0.5 * UNIT / 9.0) as u32;
    assert!(water.contents(at(1, 0)).abs_diff(even) <= 1);
    assert_eq!(water.total(), (0.5 * UNIT) as u64);
}

#[test]
fn no_more_water_than_fits_comes_in() {
    let mut water = PoreWater::dry(8);
    assert_eq!(water.feed(&[0.25; 8], 3, 0.125), (0.125 * UNIT) as u32);
    assert_eq!(water.feed(&[0.25; 8], 3, 1.0), (0.125 * UNIT) as u32);
    assert_eq!(water.feed(&[0.0; 8], 4, 1.0), 0);
    assert_eq!((water.drain(3), water.drain(4)), ((0.25 * UNIT) as u32, 0));
    assert_eq!((water.total(), water.wet()), (0, &[3][..]));
}
