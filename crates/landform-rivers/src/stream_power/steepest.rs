//! The steepest descent of every node.

use landform_graph::Lattice;
use rayon::prelude::*;

/// No neighbour is lower.
pub(super) const PIT: u8 = 8;
/// Water leaves the map here.
pub(super) const OUTLET: u8 = 9;

/// Writes the direction of the steepest descent from every node, by the order of
/// [`Lattice::neighbours`], of several the first; [`PIT`] where no neighbour is lower. Returns whether
/// any node is a pit. The `outlets`, in order, are [`OUTLET`].
pub(super) fn steepest(
    lattice: &Lattice,
    heights: &[f64],
    outlets: &[usize],
    directions: &mut [u8],
) -> bool {
    let [width, height] = [lattice.width(), lattice.height()];
    let [axis, diagonal, _] = lattice.edge_lengths().map(f64::recip);
    let inverse = [axis, axis, axis, axis, diagonal, diagonal, diagonal, diagonal];
    let row = |(y, directions): (usize, &mut [u8])| {
        if y == 0 || y + 1 == height || width < 3 {
            for (x, direction) in directions.iter_mut().enumerate() {
                *direction = steepest_at(lattice, heights, inverse, y * width + x);
            }
        } else {
            for x in [0, width - 1] {
                directions[x] = steepest_at(lattice, heights, inverse, y * width + x);
            }
            let rows = [y - 1, y, y + 1].map(|y| &heights[y * width..(y + 1) * width]);
            steepest_of_row(rows, inverse, &mut directions[1..width - 1]);
        }
        let first = outlets.partition_point(|&outlet| outlet < y * width);
        let here = outlets[first..].iter().take_while(|&&outlet| outlet < (y + 1) * width);
        here.for_each(|outlet| directions[outlet - y * width] = OUTLET);
        directions.contains(&PIT)
    };
    directions.par_chunks_exact_mut(width).enumerate().map(row).reduce(|| false, |a, b| a | b)
}

/// By definition, for nodes on the border.
pub(super) fn steepest_at(
    lattice: &Lattice,
    heights: &[f64],
    inverse: [f64; 8],
    node: usize,
) -> u8 {
    let mut best = (0.0, PIT);
    for edge in lattice.neighbours(node) {
        let slope = (heights[node] - heights[edge.node]) * inverse[usize::from(edge.direction)];
        if slope > best.0 {
            best = (slope, edge.direction);
        }
    }
    best.1
}

/// The inner nodes of a row, from it and the rows to its north and south.
fn steepest_of_row([north, here, south]: [&[f64]; 3], inverse: [f64; 8], directions: &mut [u8]) {
    let count = directions.len() + 2;
    let [north, here, south] = [&north[..count], &here[..count], &south[..count]];
    for (x, direction) in directions.iter_mut().enumerate() {
        let [west, middle, east] = [x, x + 1, x + 2];
        let around = [
            here[east],
            north[middle],
            here[west],
            south[middle],
            north[east],
            north[west],
            south[west],
            south[east],
        ];
        let mut best = 0.0;
        let mut steepest = PIT;
        for (step, (height, inverse)) in around.iter().zip(inverse).enumerate() {
            let slope = (here[middle] - height) * inverse;
            if slope > best {
                (best, steepest) = (slope, step as u8);
            }
        }
        *direction = steepest;
    }
}
