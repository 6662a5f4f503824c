//! The shore as lines: the sides of land nodes that face the sea, one after another.

use landform_graph::{Connectivity, Lattice};

use super::Shore;
use super::compass::{SIDES, STEPS, beside, diagonal, left_of, opposite, right_of};

/// A side of a land node that faces the sea: four times the node plus the direction.
pub(super) type Side = u32;

/// The side of `node` in a direction.
pub(super) fn side_of(node: usize, direction: usize) -> Side {
    (4 * node + direction) as Side
}

/// No place in a line.
const NOWHERE: u32 = u32::MAX;

/// One line of shore: a range of the places of [`ShoreLines`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// First place.
    pub(super) start: usize,
    /// The place after the last one.
    pub(super) end: usize,
    /// Whether the last side leads to the first one again; other lines end at open borders.
    pub(super) closed: bool,
    /// Columns and rows by which a closed line has moved when it comes back to its first side:
    /// not zero when it runs around a periodic lattice.
    pub(super) winding: [i32; 2],
}

/// All lines of a shore, traced with land on the left.
///
/// Each side leads to one other: straight on, around the corner of its own land, or across to
/// the land ahead. Where four nodes meet with land on one diagonal and sea on the other, the
/// land stays together when the lattice joins it and the sea does otherwise, so that lines of
/// land that the sea could not pass are never cut. On the 4-8 mesh exactly one of both has an
/// edge; with four neighbours the sea has none, with eight it has one.
///
/// Cost: constant a side. Memory: 16 bytes a node, 12 a side.
#[derive(Clone, Debug)]
pub(super) struct ShoreLines {
    /// Place of each side, four a node.
    places: Vec<u32>,
    sides: Vec<Side>,
    /// Columns and rows of the land nodes along each line, not wrapped on periodic axes.
    at: Vec<[i32; 2]>,
    lines: Vec<Line>,
    /// Number of the line of each place.
    numbers: Vec<u32>,
}

impl ShoreLines {
    /// Memory for the lines of a lattice.
    pub(super) fn new(nodes: usize) -> Self {
        Self {
            places: vec![NOWHERE; 4 * nodes],
            sides: Vec::new(),
            at: Vec::new(),
            lines: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// The line that holds a place.
    pub(super) fn line_of(&self, place: usize) -> Line {
        self.lines[self.numbers[place] as usize]
    }

    /// The side at a place.
    pub(super) fn side(&self, place: usize) -> Side {
        self.sides[place]
    }

    /// Columns and rows of the land nodes at all places, not wrapped on periodic axes.
    pub(super) fn at(&self) -> &[[i32; 2]] {
        &self.at
    }

    /// Place of a side of the shore.
    pub(super) fn place(&self, side: Side) -> usize {
        self.places[side as usize] as usize
    }

    /// Traces the shore anew. `coast` names every land node with a side at sea, in any order
    /// that does not depend on chance; other nodes are passed over.
    pub(super) fn trace(&mut self, shore: &Shore, coast: &[u32]) {
        self.sides.iter().for_each(|&side| self.places[side as usize] = NOWHERE);
        self.sides.clear();
        self.at.clear();
        self.lines.clear();
        self.numbers.clear();
        let open = [0, 1].map(|axis| !shore.lattice().is_periodic(axis));
        if open.contains(&true) {
            // Lines that end at borders are traced from their beginnings.
            coast.iter().for_each(|&node| self.trace_from(shore, node as usize, begins));
        }
        coast.iter().for_each(|&node| self.trace_from(shore, node as usize, |_, _, _| true));
    }

    /// Traces the lines from those sides of a node that may begin one.
    fn trace_from(
        &mut self,
        shore: &Shore,
        node: usize,
        may_begin: impl Fn(&Shore, usize, usize) -> bool,
    ) {
        let exposed = shore.around(node) & SIDES;
        for direction in (0..4).filter(|direction| exposed >> direction & 1 == 1) {
            let side = side_of(node, direction);
            if self.places[side as usize] == NOWHERE && may_begin(shore, node, direction) {
                self.follow(shore, side);
            }
        }
    }

    /// Traces one line from its first side.
    fn follow(&mut self, shore: &Shore, first: Side) {
        let (start, number) = (self.sides.len(), self.lines.len() as u32);
        let place = shore.place((first / 4) as usize);
        let mut at = place.map(|along| along as i32);
        let mut here = place;
        let mut side = first;
        let winding = loop {
            self.places[side as usize] = self.sides.len() as u32;
            self.sides.push(side);
            self.at.push(at);
            self.numbers.push(number);
            let Some((next, step, there)) = next_side(shore, side, here) else { break None };
            at = [0, 1].map(|axis| at[axis] + step[axis] as i32);
            if next == first {
                break Some([0, 1].map(|axis| at[axis] - self.at[start][axis]));
            }
            (side, here) = (next, there);
        };
        let closed = winding.is_some();
        let winding = winding.unwrap_or_default();
        self.lines.push(Line { start, end: self.sides.len(), closed, winding });
    }
}

/// Whether a side is the first of a line that begins at an open border.
fn begins(shore: &Shore, node: usize, direction: usize) -> bool {
    let at = shore.place(node);
    let inner = shore.lattice().is_interior([at[0], at[1], 0]);
    !inner && beside(shore.lattice(), at, right_of(direction)).is_none()
}

/// The side that follows `side` with land on the left, the step to its node and the place of
/// that; `None` where the line ends at an open border.
#[inline]
pub(super) fn next_side(
    shore: &Shore,
    side: Side,
    at: [usize; 2],
) -> Option<(Side, [isize; 2], [usize; 2])> {
    let (node, direction) = ((side / 4) as usize, (side % 4) as usize);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::testing::{any_land, any_lattice, coast_of};
    use landform_graph::Boundary;
    use proptest::prelude::*;

    fn traced(lattice: &Lattice, land: &[u8]) -> (Shore, ShoreLines) {
        let shore = Shore::new(lattice, land);
        let mut lines = ShoreLines::new(land.len());
        lines.trace(&shore, &coast_of(&shore, land));
        (shore, lines)
    }

    proptest! {
        #[test]
        fn every_side_at_sea_lies_on_one_line(lattice in any_lattice(), seed in 0_u64..500) {
            let land = any_land(&lattice, seed);
            let (_, lines) = traced(&lattice, &land);
            let mut seen = vec![0; 4 * land.len()];
            lines.sides.iter().for_each(|&side| seen[side as usize] += 1);
            for node in 0..land.len() {
                let [x, y, _] = lattice.coordinates(node);
                for direction in 0..4 {
                    let sea = beside(&lattice, [x, y], direction).is_some_and(|n| land[n] == 0);
                    let expected = u32::from(land[node] > 0 && sea);
                    prop_assert_eq!(seen[4 * node + direction], expected);
                }
            }
        }

        #[test]
        fn steps_along_lines_are_short_and_closed_lines_close(
            lattice in any_lattice(),
            seed in 0_u64..500,
        ) {
            let land = any_land(&lattice, seed);
            let (shore, lines) = traced(&lattice, &land);
            for line in &lines.lines {
                for place in line.start..line.end {
                    prop_assert_eq!(lines.line_of(place), *line);
                    prop_assert_eq!(lines.place(lines.side(place)), place);
                    let at = shore.place((lines.side(place) / 4) as usize);
                    let next = next_side(&shore, lines.side(place), at);
                    if place + 1 < line.end {
                        prop_assert_eq!(next.map(|next| next.0), Some(lines.side(place + 1)));
                        let [from, to] = [lines.at()[place], lines.at()[place + 1]];
                        let step = [to[0] - from[0], to[1] - from[1]].map(i32::abs);
                        prop_assert!(step.iter().all(|&step| step <= 1));
                    } else {
                        let first = line.closed.then(|| lines.side(line.start));
                        prop_assert_eq!(next.map(|next| next.0), first);
                    }
                }
            }
        }
    }

    #[test]
    fn corners_that_touch_follow_the_edges_of_the_lattice() {
        // Land at (1, 1) and (2, 2), whose columns and rows add to even numbers.
        let mut land = [0; 16];
        (land[5], land[10]) = (1, 1);
        let mut other = [0; 16];
        (other[6], other[9]) = (1, 1);
        for (connectivity, even, odd) in [
            (Connectivity::Four, 1, 1),
            (Connectivity::FourEight, 1, 2),
            (Connectivity::Eight, 2, 2),
        ] {
            let lattice = Lattice::plane([4, 4], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            assert_eq!(traced(&lattice, &land).1.lines.len(), even, "{connectivity:?}");
            assert_eq!(traced(&lattice, &other).1.lines.len(), odd, "{connectivity:?}");
        }
    }
}
