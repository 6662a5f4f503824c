//! Lattices and fields drawn at random for the property tests of this crate.

use proptest::prelude::*;

use crate::{Boundary, Connectivity, Lattice};

fn any_boundary() -> impl Strategy<Value = Boundary> {
    prop_oneof![Just(Boundary::Open), Just(Boundary::Periodic)]
}

fn any_connectivity() -> impl Strategy<Value = Connectivity> {
    prop_oneof![
        Just(Connectivity::Four),
        Just(Connectivity::FourEight),
        Just(Connectivity::Eight),
        Just(Connectivity::Voxel6),
        Just(Connectivity::Voxel18),
        Just(Connectivity::Voxel26),
    ]
}

/// A small lattice of any kind, seldom square, with any mixture of boundaries.
pub(crate) fn any_lattice() -> impl Strategy<Value = Lattice> {
    let size = (1..8_usize, 1..8_usize, 1..6_usize);
    let boundary = (any_boundary(), any_boundary(), any_boundary());
    (any_connectivity(), size, boundary, 0.1..20.0_f64).prop_filter_map(
        "a periodic axis needs three nodes",
        |(connectivity, (width, height, depth), (x, y, z), spacing)| {
            match connectivity.is_volume() {
                true => Lattice::volume([width, height, depth], spacing, connectivity, [x, y, z]),
                false => Lattice::plane([width, height], spacing, connectivity, [x, y]),
            }
            .ok()
        },
    )
}

/// A lattice of [`any_lattice`] with one number in 0..1 a node.
pub(crate) fn any_field() -> impl Strategy<Value = (Lattice, Vec<f64>)> {
    any_lattice().prop_flat_map(|lattice| {
        let count = lattice.node_count();
        (Just(lattice), prop::collection::vec(0.0..1.0_f64, count))
    })
}
