//! Which coast nodes changes concern.

use landform_graph::Lattice;

use super::disc_sums::half_width;

/// Coast nodes that may fall, as one bit a node, and those among them near to changes.
///
/// A node farther away from every change than the radius finds what it found before, and
/// withstands the sea again.
///
/// Cost: one look at 64 nodes for each row within reach of a change. Memory: 2 bits a node.
#[derive(Clone, Debug)]
pub(super) struct Concerned {
    size: [usize; 2],
    periodic: [bool; 2],
    /// Half of the width of the disc in each row, from its middle row on.
    half_widths: Vec<usize>,
    /// Words of 64 nodes in each row. Those of [`ROWS`] rows lie together, so that a disc lies in
    /// few lines of memory, however wide the map is.
    words: usize,
    may_fall: Vec<u64>,
    concerned: Vec<u64>,
    /// Words with concerned nodes.
    filled: Vec<u32>,
}

/// Rows whose words lie one after the other in memory: with 64 nodes a word, a line of memory.
const ROWS: usize = 8;

impl Concerned {
    /// No nodes; changes reach `radius` spacings far.
    pub(super) fn new(lattice: &Lattice, radius: f64) -> Self {
        let size = [lattice.width(), lattice.height()];
        let words = size[0].div_ceil(64);
        let rows = (radius as usize).min(size[1]);
        Self {
            size,
            periodic: [0, 1].map(|axis| lattice.is_periodic(axis)),
            half_widths: (0..=rows).map(|row| half_width(radius, row)).collect(),
            words,
            may_fall: vec![0; words * size[1].next_multiple_of(ROWS)],
            concerned: vec![0; words * size[1].next_multiple_of(ROWS)],
            filled: Vec::new(),
        }
    }

    /// Columns and rows of the map.
    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Index of a word of a row.
    fn index(&self, word: usize, y: usize) -> usize {
        (y / ROWS * self.words + word) * ROWS + y % ROWS
    }

    /// Row and first column of the word of an index.
    fn place(&self, index: usize) -> [usize; 2] {
        let (block, row) = (index / ROWS, index % ROWS);
        [block / self.words * ROWS + row, block % self.words * 64]
    }

    /// Says of a node whether it may fall.
    pub(super) fn set(&mut self, [x, y]: [usize; 2], may_fall: bool) {
        let index = self.index(x / 64, y);
        let word = &mut self.may_fall[index];
        *word = (*word & !(1 << (x % 64))) | u64::from(may_fall) << (x % 64);
    }

    /// Something at a place changes.
    pub(super) fn change(&mut self, [x, y]: [usize; 2]) {
        let [width, height] = self.size;
        // Every row is met once, over the shorter way where the axis is periodic.
        let north = if self.periodic[1] { (height - 1) / 2 } else { y };
        let south = if self.periodic[1] { height / 2 } else { height - 1 - y };
        let reach = self.half_widths.len() - 1;
        let [north, south] = [north, south].map(|rows| rows.min(reach));
        for row in 0..=north + south {
            let half = self.half_widths[north.abs_diff(row)];
            let y = (y + height + row - north) % height;
            if self.periodic[0] && 2 * half + 1 >= width {
                self.fill(y, 0, width);
                continue;
            }
            self.fill(y, x.saturating_sub(half), (x + half + 1).min(width));
            if self.periodic[0] && x < half {
                self.fill(y, x + width - half, width);
            } else if self.periodic[0] && x + half >= width {
                self.fill(y, 0, x + half + 1 - width);
            }
        }
    }

    /// Everything changes.
    pub(super) fn change_all(&mut self) {
        (0..self.size[1]).for_each(|y| self.fill(y, 0, self.size[0]));
    }

    /// Columns `start..end` of a row lie within reach of a change.
    fn fill(&mut self, y: usize, start: usize, end: usize) {
        for word in start / 64..=(end - 1) / 64 {
            let low = start.saturating_sub(64 * word);
            let high = (end - 1 - 64 * word).min(63);
            let index = self.index(word, y);
            let nodes = self.may_fall[index] & (u64::MAX << low) & (u64::MAX >> (63 - high));
            let before = self.concerned[index];
            if nodes & !before != 0 {
                self.concerned[index] |= nodes;
                if before == 0 {
                    self.filled.push(index as u32);
                }
            }
        }
    }

    /// Names the nodes that changes since the latest call concern and that may fall.
    pub(super) fn take(&mut self, mut visit: impl FnMut(usize)) {
        for index in std::mem::take(&mut self.filled) {
            let [y, first] = self.place(index as usize);
            // What may not fall any more since the change is left out.
            let mut nodes = std::mem::take(&mut self.concerned[index as usize]);
            nodes &= self.may_fall[index as usize];
            while nodes != 0 {
                visit(y * self.size[0] + first + nodes.trailing_zeros() as usize);
                nodes &= nodes - 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nodes_within_the_radius_are_concerned(
            size in [3_usize..150, 3_usize..14],
            boundary in proptest::array::uniform2(proptest::bool::ANY),
            radius in 0.0_f64..16.0,
            at in [0_usize..150, 0_usize..14],
            marked in 1_usize..5,
        ) {
            let boundary = boundary.map(|p| if p { Boundary::Periodic } else { Boundary::Open });
            let lattice = Lattice::plane(size, 1.0, Connectivity::Four, boundary).unwrap();
            let at = [0, 1].map(|axis| at[axis] % size[axis]);
            let mut concerned = Concerned::new(&lattice, radius);
            let may_fall = |node: usize| node.is_multiple_of(marked);
            let place = |node: usize| [node % size[0], node / size[0]];
            for node in 0..lattice.node_count() {
                concerned.set(place(node), true);
                concerned.set(place(node), may_fall(node));
            }
            concerned.change(at);
            let mut found = Vec::new();
            concerned.take(|node| found.push(node));
            found.sort_unstable();
            let squared = |node: usize, axis: usize| {
                let direct = place(node)[axis].abs_diff(at[axis]);
                let around = size[axis] - direct;
                if lattice.is_periodic(axis) { direct.min(around).pow(2) } else { direct.pow(2) }
            };
            let within = |&node: &usize| {
                (squared(node, 0) + squared(node, 1)) as f64 <= radius * radius && may_fall(node)
            };
            let expected: Vec<usize> = (0..lattice.node_count()).filter(within).collect();
            prop_assert_eq!(found, expected);
            concerned.take(|node| panic!("{node} was taken before"));
            concerned.change_all();
            let mut all = 0;
            concerned.take(|_| all += 1);
            prop_assert_eq!(all, lattice.node_count().div_ceil(marked));
        }
    }
}
