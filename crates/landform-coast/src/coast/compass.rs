//! The eight nodes around a node, in the order of the neighbours of a lattice.

use landform_graph::{Connectivity, Lattice};

/// Steps to the nodes around a node: east, north, west, south, then north-east, north-west,
/// south-west, south-east. Rows run south.
pub(super) const STEPS: [[isize; 2]; 8] =
    [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];

/// Bits of the four sides in a set of directions.
pub(super) const SIDES: u8 = 0b1111;

/// The direction that leads back.
pub(super) const fn opposite(direction: usize) -> usize {
    (direction & 4) | ((direction + 2) % 4)
}

/// The side that follows `side` counter-clockwise.
pub(super) const fn left_of(side: usize) -> usize {
    (side + 1) % 4
}

/// The side that precedes `side` counter-clockwise.
pub(super) const fn right_of(side: usize) -> usize {
    (side + 3) % 4
}

/// The diagonal between `side` and [`left_of`] it.
pub(super) const fn diagonal(side: usize) -> usize {
    4 + side
}

/// The node in a direction; `None` beyond an open border.
pub(super) fn beside(lattice: &Lattice, [x, y]: [usize; 2], direction: usize) -> Option<usize> {
    let [east, south] = STEPS[direction];
    lattice.offset([x, y, 0], [east, south, 0])
}

/// Directions in which a node has edges, as bits, were it not for borders.
pub(super) fn edges(lattice: &Lattice, [x, y]: [usize; 2]) -> u8 {
    match lattice.connectivity() {
        Connectivity::Four => SIDES,
        Connectivity::FourEight if (x + y) % 2 == 1 => SIDES,
        _ => u8::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::Boundary;

    #[test]
    fn directions_are_those_of_the_lattice() {
        for connectivity in [Connectivity::Four, Connectivity::FourEight, Connectivity::Eight] {
            let lattice =
                Lattice::plane([6, 6], 1.0, connectivity, [Boundary::Open; 2]).expect("a lattice");
            for at in [[2, 2], [2, 3]] {
                let node = lattice.node([at[0], at[1], 0]);
                let mut seen = 0;
                for edge in lattice.neighbours(node) {
                    let direction = usize::from(edge.direction);
                    assert_eq!(beside(&lattice, at, direction), Some(edge.node));
                    let back = lattice.coordinates(edge.node);
                    assert_eq!(
                        beside(&lattice, [back[0], back[1]], opposite(direction)),
                        Some(node)
                    );
                    seen |= 1 << direction;
                }
                assert_eq!(seen, edges(&lattice, at));
            }
        }
    }

    #[test]
    fn a_diagonal_lies_between_its_sides() {
        for side in 0..4 {
            let sum: [isize; 2] =
                std::array::from_fn(|axis| STEPS[side][axis] + STEPS[left_of(side)][axis]);
            assert_eq!(STEPS[diagonal(side)], sum);
            assert_eq!(right_of(left_of(side)), side);
        }
    }
}
