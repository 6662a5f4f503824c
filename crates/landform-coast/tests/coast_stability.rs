//! The sea calms down: none of the parameters of the thesis (tables 4.3 to 4.5) erodes everything.

use landform_coast::coast::{Coast, CoastSettings, Perimeter, Wear};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;

/// A square of land of random rock, as wide as in the thesis, with nodes 10 m apart.
const SIDE: usize = 256;

/// Share of the land that is left when the coast rests, or first when no more than `least` is.
fn land_left(connectivity: Connectivity, settings: &CoastSettings, seed: u64, least: f64) -> f64 {
    let lattice = Lattice::plane([SIDE; 2], 10.0, connectivity, [Boundary::Open; 2]).unwrap();
    let inside = |along: usize| (SIDE / 16..SIDE - SIDE / 16).contains(&along);
    let is_land = |node: usize| inside(node % SIDE) && inside(node / SIDE);
    let mut land: Vec<u8> = (0..SIDE * SIDE).map(|node| u8::from(is_land(node))).collect();
    let random = RandomStream::new(seed, "rock");
    let mut rock: Vec<f64> = (0..land.len()).map(|node| random.unit(0, node, 0)).collect();
    let mut coast = Coast::new(&lattice, settings.clone(), &land, &rock).unwrap();
    let initial = coast.shore().total();
    let all = land.iter().filter(|&&land| land > 0).count();
    let mut left = all;
    loop {
        let fallen = coast.step(&mut land, &mut rock, initial).unwrap().eroded.len();
        left -= fallen;
        let share = left as f64 / all as f64;
        // With wear the coast never rests, but may not fall for a while.
        if share <= least || (fallen == 0 && settings.wear.is_none()) {
            return share;
        }
    }
}

/// The least share that is left over some seeds, and the one in the middle.
fn shares_left(connectivity: Connectivity, settings: &CoastSettings, least: f64) -> [f64; 2] {
    let mut shares: Vec<f64> =
        (0..12).map(|seed| land_left(connectivity, settings, seed, least)).collect();
    shares.sort_by(f64::total_cmp);
    [shares[0], shares[shares.len() / 2]]
}

#[test]
fn coasts_of_tables_4_3_and_4_4_come_to_rest_with_most_of_the_land() {
    let contiguous = |radius_m| Perimeter::Contiguous { radius_m };
    let near = |radius_m| Perimeter::Near { radius_m };
    for (force, attenuation, perimeter, expected) in [
        (0.495, 0.18, Perimeter::Whole, 0.55),
        (0.476, 0.15, Perimeter::Whole, 0.55),
        (0.46, 0.13, Perimeter::Whole, 0.55),
        (0.444, 0.11, Perimeter::Whole, 0.55),
        (0.5, 0.2, contiguous(150.0), 0.05),
        (0.5, 0.2, contiguous(200.0), 0.1),
        (0.5, 0.2, contiguous(250.0), 0.2),
        (0.5, 0.15, near(150.0), 0.05),
        (0.5, 0.15, near(200.0), 0.1),
        (0.5, 0.15, near(250.0), 0.2),
    ] {
        let settings = CoastSettings { force, attenuation, perimeter, ..Default::default() };
        let [left, middle] = shares_left(Connectivity::Four, &settings, 0.0);
        println!(
            "f {force}, g {attenuation}, {perimeter:?}: at least {left:.3} left, {middle:.3} in the middle"
        );
        assert!(left > expected, "{settings:?}: {left}");
    }
}

/// With wear a coast never rests; it is worn down little by little, and not in one avalanche.
#[test]
fn worn_coasts_of_table_4_5_are_not_eroded_at_once() {
    for weakening in [0.0, 0.05, 0.075, 0.1, 0.15, 0.175] {
        let settings = CoastSettings {
            force: 0.4,
            attenuation: 0.2,
            perimeter: Perimeter::Contiguous { radius_m: 150.0 },
            wear: Some(Wear { rate: 0.01, weakening, radius_m: 25.0 }),
            ..CoastSettings::default()
        };
        let [left, middle] = shares_left(Connectivity::FourEight, &settings, 0.65);
        println!("a {weakening}: at least {left:.3} left, {middle:.3} in the middle");
        assert!(left > 0.6, "{settings:?}: {left}");
    }
}
