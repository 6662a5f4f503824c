//! Small lattices and land for tests.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;
use proptest::prelude::*;

/// Any small 2-D lattice.
pub(super) fn any_lattice() -> impl Strategy<Value = Lattice> {
    let connectivity = prop_oneof![
        Just(Connectivity::FourEight),
        Just(Connectivity::Four),
        Just(Connectivity::Eight)
    ];
    let boundary = || prop_oneof![Just(Boundary::Open), Just(Boundary::Periodic)];
    let size = || (2_usize..9).prop_map(|half| 2 * half);
    (size(), size(), connectivity, boundary(), boundary()).prop_map(|(width, height, c, x, y)| {
        Lattice::plane([width, height], 2.0, c, [x, y]).expect("a lattice")
    })
}

/// Blotches of land.
pub(super) fn any_land(lattice: &Lattice, seed: u64) -> Vec<u8> {
    let random = RandomStream::new(seed, "land");
    let share = random.unit(0, 0, 0);
    let rough = |node: usize| random.unit(1, node, 0);
    let land = |node: usize| {
        let around = lattice.neighbours(node).map(|edge| rough(edge.node));
        let (sum, count) = around.fold((rough(node), 1.0), |(s, c), value| (s + value, c + 1.0));
        u8::from(sum / count < 0.3 + 0.4 * share)
    };
    (0..lattice.node_count()).map(land).collect()
}

/// Resistances between 0 and 1.
pub(super) fn any_resistance(lattice: &Lattice, seed: u64) -> Vec<f64> {
    let random = RandomStream::new(seed, "resistance");
    (0..lattice.node_count()).map(|node| random.unit(0, node, 0)).collect()
}
