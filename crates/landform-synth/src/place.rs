//! Places on the lattice: as shares of its width and height, with distances to them, and in tiles.

use landform_graph::Lattice;
use rayon::prelude::*;

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

/// Nodes along a side of the tiles that fields are made in.
const TILE: usize = 32;

/// A field made tile by tile, whose nodes are close together as those of rows are not:
/// `fill(scratch, positions, values)` gives the values at positions in metres east and north of
/// the south-western node, and may change these. Scratch is made for so many nodes at most.
pub(crate) fn fill_by_tiles<S>(
    lattice: &Lattice,
    scratch: impl Fn(usize) -> S + Sync,
    fill: impl Fn(&mut S, &mut [[f64; 2]], &mut [f64]) + Sync,
) -> Vec<f64> {
    let [width, height] = [lattice.width(), lattice.height()];
    let mut field = vec![0.0; lattice.node_count()];
    let bands = field.par_chunks_mut(TILE * width).enumerate();
    bands.for_each_init(
        || (scratch(TILE * TILE), Vec::new(), vec![0.0; TILE * TILE]),
        |(scratch, positions, values), (band, field)| {
            for west in (0..width).step_by(TILE) {
                let columns = west..width.min(west + TILE);
                let place = |row: usize, column: usize| {
                    [column, height - 1 - row].map(|steps| steps as f64 * lattice.spacing())
                };
                positions.clear();
                for row in band * TILE..height.min((band + 1) * TILE) {
                    positions.extend(columns.clone().map(|column| place(row, column)));
                }
                let values = &mut values[..positions.len()];
                fill(scratch, positions, values);
                let rows = field.chunks_exact_mut(width).zip(values.chunks_exact(columns.len()));
                rows.for_each(|(row, values)| row[columns.clone()].copy_from_slice(values));
            }
        },
    );
    field
}
