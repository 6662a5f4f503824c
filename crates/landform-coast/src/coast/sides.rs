//! The sides of land nodes that face the sea, and which follows which along the shore.

use landform_graph::{Connectivity, Lattice};

use super::Shore;
use super::compass::{STEPS, beside, diagonal, left_of, opposite, right_of};

/// A side of a land node that faces the sea: four times the node plus the direction.
pub(super) type Side = u32;

/// The side of `node` in a direction.
pub(super) fn side_of(node: usize, direction: usize) -> Side {
    (4 * node + direction) as Side
}

/// The node of a side and its direction.
#[inline]
pub(super) fn parts_of(side: Side) -> (usize, usize) {
    ((side / 4) as usize, (side % 4) as usize)
}

/// Whether a side is the first of a line that begins at an open border.
pub(super) fn begins(shore: &Shore, node: usize, direction: usize) -> bool {
    let at = shore.place(node);
    let inner = shore.lattice().is_interior([at[0], at[1], 0]);
    !inner && beside(shore.lattice(), at, right_of(direction)).is_none()
}

/// The side that follows `side` with land on the left, the step to its node and the place of
/// that; `None` where the line ends at an open border.
///
/// Each side leads to one other: straight on, around the corner of its own land, or across to
/// the land ahead. Where four nodes meet with land on one diagonal and sea on the other, the
/// land stays together when the lattice joins it and the sea does otherwise, so that lines of
/// land that the sea could not pass are never cut. On the 4-8 mesh exactly one of both has an
/// edge; with four neighbours the sea has none, with eight it has one.
///
/// It follows from what lies around the node of `side` alone.
#[inline]
pub(super) fn next_side(
    shore: &Shore,
    side: Side,
    at: [usize; 2],
) -> Option<(Side, [isize; 2], [usize; 2])> {
    let (node, direction) = parts_of(side);
    let ahead = left_of(direction);
    let is_sea = |direction: usize| shore.around(node) >> direction & 1 == 1;
    let lattice = shore.lattice();
    let (step, facing) = match (is_sea(ahead), is_sea(diagonal(direction))) {
        (true, true) => ([0, 0], ahead),
        (true, false) if !joins_land(lattice, at) => ([0, 0], ahead),
        (true, false) | (false, false) => (STEPS[diagonal(direction)], opposite(ahead)),
        (false, true) => (STEPS[ahead], direction),
    };
    let inner = lattice.is_interior([at[0], at[1], 0]);
    if !inner && beside(lattice, at, ahead).is_none() {
        return None;
    }
    if inner {
        let there = [0, 1].map(|axis| at[axis].wrapping_add_signed(step[axis]));
        let next = node.wrapping_add_signed(step[0] + step[1] * lattice.width() as isize);
        return Some((side_of(next, facing), step, there));
    }
    let next = lattice.offset([at[0], at[1], 0], [step[0], step[1], 0])?;
    let [x, y, _] = lattice.coordinates(next);
    Some((side_of(next, facing), step, [x, y]))
}

/// Whether land at `at` is joined to land across a corner when the other two nodes there are
/// sea.
fn joins_land(lattice: &Lattice, at: [usize; 2]) -> bool {
    match lattice.connectivity() {
        Connectivity::FourEight => (at[0] + at[1]).is_multiple_of(2),
        Connectivity::Eight => false,
        _ => true,
    }
}
