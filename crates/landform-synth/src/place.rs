//! Places on the lattice as shares of its width and height, and distances to them.

use landform_graph::Lattice;

/// East and north distance in metres from `place` to a node, the short way round on periodic
/// axes. `place` is a share of the width, from west to east, and of the height, from south to
/// north: `[0.5, 0.5]` is the middle.
pub(crate) fn offset_from(lattice: &Lattice, place: [f64; 2], node: usize) -> [f64; 2] {
    let position = lattice.position(node).to_array();
    [0, 1].map(|axis| {
        let nodes = lattice.size()[axis] as f64;
        let periodic = lattice.is_periodic(axis);
        let extent = if periodic { nodes } else { nodes - 1.0 } * lattice.spacing();
        let offset = position[axis] - place[axis] * extent;
        match periodic {
            true => offset - extent * (offset / extent).round(),
            false => offset,
        }
    })
}

/// The positions in metres east and north of the south-western node of a row of nodes.
pub(crate) fn place_row(lattice: &Lattice, row: usize, positions: &mut Vec<[f64; 2]>) {
    let north = (lattice.height() - 1 - row) as f64 * lattice.spacing();
    positions.clear();
    positions.extend((0..lattice.width()).map(|column| [column as f64 * lattice.spacing(), north]));
}
