//! Sums over discs around nodes, brought up to date as single nodes change.

use landform_graph::Lattice;

use super::blocks::Blocks;
use super::row_changes::RowChanges;

/// The sum over a disc around each node of numbers that change here and there, beside a limit of
/// the node.
///
/// A node that changes belongs to the discs of all nodes within the radius: one span of nodes a
/// row. Row by row, each span is written at its two ends only, and a running sum over the part
/// of the row that lies in any span changes the sums. Whole numbers make them exact, so they
/// never drift from those of a fresh search.
///
/// What is stored is by how much each sum is above its limit: those that sink below are found
/// in passing.
///
/// On periodic axes a node belongs to a disc once, by its nearest image.
///
/// Cost: 2 (2R + 1) writes a change, then one pass over what lies within reach of changes.
/// Memory: 4 bytes a node.
#[derive(Clone, Debug)]
pub(super) struct DiscSums {
    size: [usize; 2],
    periodic: [bool; 2],
    /// Half of the width of the disc in each row, from its middle row on.
    half_widths: Vec<usize>,
    /// Sum over the disc around each node, less its limit.
    margins: Blocks,
    changes: Vec<Change>,
    limited: Vec<u32>,
    row: RowChanges,
    below: Vec<u32>,
}

/// A change of the number at a node, whose row may be an image beyond a periodic border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Change {
    y: i32,
    x: u32,
    amount: i32,
}

impl DiscSums {
    /// Sums of zeros over discs of `radius` spacings, with limits of zero.
    pub(super) fn new(lattice: &Lattice, radius: f64) -> Self {
        let size = [lattice.width(), lattice.height()];
        let rows = (radius as usize).min(size[1]);
        Self {
            size,
            periodic: [0, 1].map(|axis| lattice.is_periodic(axis)),
            half_widths: (0..=rows).map(|row| half_width(radius, row)).collect(),
            margins: Blocks::new(size),
            changes: Vec::new(),
            limited: Vec::new(),
            row: RowChanges::new(size[0]),
            below: Vec::new(),
        }
    }

    /// Adds `amount` to the number at column `x`, row `y` with the next refresh.
    pub(super) fn add(&mut self, [x, y]: [usize; 2], amount: i32) {
        let (x, y, height) = (x as u32, y as i32, self.size[1] as i32);
        self.changes.push(Change { y, x, amount });
        if self.periodic[1] {
            let [north, south] = self.reach();
            if y + south >= height {
                self.changes.push(Change { y: y - height, x, amount });
            }
            if y < north {
                self.changes.push(Change { y: y + height, x, amount });
            }
        }
    }

    /// Rows north and south of a node up to which it belongs to discs. Every row is met once,
    /// over the shorter way where the axis is periodic.
    fn reach(&self) -> [i32; 2] {
        let (reach, height) = (self.half_widths.len() - 1, self.size[1]);
        match self.periodic[1] {
            true => [reach.min((height - 1) / 2) as i32, reach.min(height / 2) as i32],
            false => [reach as i32; 2],
        }
    }

    /// Moves the limit of a node.
    pub(super) fn move_limit(&mut self, node: usize, by: i32) {
        *self.margins.get_mut(node) -= by;
        self.limited.push(node as u32);
    }

    /// Makes the sums follow the changes.
    pub(super) fn refresh(&mut self) {
        let mut changes = std::mem::take(&mut self.changes);
        changes.sort_unstable();
        let [north, south] = self.reach();
        let mut rows: &[Change] = &changes;
        let mut y = 0;
        // Row by row, over the changes that reach it.
        while let Some(first) = rows.first() {
            y = y.max(first.y - north);
            if y >= self.size[1] as i32 {
                break;
            }
            if first.y + south < y {
                rows = &rows[rows.partition_point(|change| change.y == first.y)..];
                continue;
            }
            let beside = rows.chunk_by(|one, other| one.y == other.y);
            for changes in beside.take_while(|changes| changes[0].y - north <= y) {
                self.write(changes, self.half_widths[changes[0].y.abs_diff(y) as usize]);
            }
            let start = y as usize * self.size[0];
            let mut row = self.margins.row(y as usize);
            self.row.apply(&mut row, |x| self.below.push((start + x) as u32));
            y += 1;
        }
        changes.clear();
        self.changes = changes;
        let margins = &self.margins;
        self.below.extend(self.limited.drain(..).filter(|&node| margins.get(node as usize) < 0));
    }

    /// Writes changes at the nodes of a row, from west to east, into a row whose discs reach so
    /// many columns to either side.
    #[inline]
    fn write(&mut self, changes: &[Change], half: usize) {
        let (width, row) = (self.size[0], &mut self.row);
        if !self.periodic[0] {
            return row.write_spans(changes.iter().map(|change| {
                let x = change.x as usize;
                (x.saturating_sub(half), (x + half + 1).min(width), change.amount)
            }));
        }
        for &Change { x, amount, .. } in changes {
            let (start, end) = (x as usize + width - half.min(width), x as usize + half + 1);
            if 2 * half + 1 >= width {
                row.write(0, width, amount);
            } else if start >= width && end <= width {
                row.write(start - width, end, amount);
            } else {
                row.write(start % width, width, amount);
                row.write(0, end % width, amount);
            }
        }
    }

    /// The sum over the disc around a node less its limit, as of the latest
    /// [`DiscSums::refresh`].
    #[inline]
    pub(super) fn margin(&self, node: usize) -> i32 {
        self.margins.get(node)
    }

    /// Moves the nodes whose sums are below their limits since the latest call to `below`, some of
    /// them twice.
    pub(super) fn take_below(&mut self, below: &mut Vec<u32>) {
        let margins = &self.margins;
        below.extend(self.below.drain(..).filter(|&node| margins.get(node as usize) < 0));
    }
}

/// Columns to either side of the middle that a disc reaches, `row` rows from its middle.
pub(super) fn half_width(radius: f64, row: usize) -> usize {
    let within = |column: usize| (column * column + row * row) as f64 <= radius * radius;
    let about = (radius * radius - (row * row) as f64).max(0.0).sqrt() as usize;
    // The root is rounded.
    if within(about + 1) { about + 1 } else { about }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::RandomStream;
    use proptest::prelude::*;

    /// Sum over a disc by looking at every node.
    fn by_definition(lattice: &Lattice, values: &[i32], center: usize, radius: f64) -> i32 {
        let away = |node: usize| -> f64 {
            let [from, to] = [center, node].map(|node| lattice.coordinates(node));
            let along = |axis: usize| {
                let direct = from[axis].abs_diff(to[axis]);
                let around = lattice.size()[axis] - direct;
                if lattice.is_periodic(axis) { direct.min(around) } else { direct }
            };
            (along(0).pow(2) + along(1).pow(2)) as f64
        };
        (0..values.len()).filter(|&node| away(node) <= radius * radius).map(|n| values[n]).sum()
    }

    proptest! {
        #[test]
        fn sums_and_limits_are_those_of_the_definition(
            size in [3_usize..70, 3_usize..14],
            boundary in proptest::array::uniform2(proptest::bool::ANY),
            radius in 0.0_f64..16.0,
            together in 1_usize..6,
            seed in 0_u64..1000,
        ) {
            let boundary = boundary.map(|p| if p { Boundary::Periodic } else { Boundary::Open });
            let lattice = Lattice::plane(size, 1.0, Connectivity::Four, boundary).unwrap();
            let random = RandomStream::new(seed, "changes");
            let mut sums = DiscSums::new(&lattice, radius);
            let mut values = vec![0; lattice.node_count()];
            let mut limits = vec![0; lattice.node_count()];
            let mut below = std::collections::BTreeSet::new();
            for change in 0..20 {
                let [place, amount, limit, by] = random.block(change, 0, 0);
                let node = place as usize % values.len();
                let amount = (amount % 9) as i32 - 4;
                values[node] += amount;
                let [x, y, _] = lattice.coordinates(node);
                sums.add([x, y], amount);
                let (node, by) = (limit as usize % values.len(), (by % 9) as i32 - 4);
                limits[node] += by;
                sums.move_limit(node, by);
                if !(change as usize).is_multiple_of(together) {
                    continue;
                }
                sums.refresh();
                let mut found = Vec::new();
                sums.take_below(&mut found);
                for (center, limit) in limits.iter().enumerate() {
                    let margin = by_definition(&lattice, &values, center, radius) - limit;
                    prop_assert_eq!(sums.margin(center), margin);
                    if margin >= 0 {
                        below.remove(&(center as u32));
                        prop_assert!(!found.contains(&(center as u32)));
                    } else if below.insert(center as u32) {
                        prop_assert!(found.contains(&(center as u32)), "not found: {}", center);
                    }
                }
            }
        }
    }
}
