//! Sums over discs around nodes, brought up to date as single nodes change.

use landform_graph::Lattice;

/// The sum over a disc around each node of numbers that change here and there.
///
/// A node that changes belongs to the discs of all nodes within the radius: one span of nodes a
/// row. Each span is written at its two ends only, into a plane of differences, and sums are
/// running sums along the rows, made anew for rows that changed. Whole numbers make the sums
/// exact, so they never drift from those of a fresh search.
///
/// On periodic axes a node belongs to a disc once, by its nearest image.
///
/// Cost: 2 (2R + 1) writes a change, then one pass over each row that changed.
/// Memory: 8 bytes a node.
#[derive(Clone, Debug)]
pub(super) struct DiscSums {
    size: [usize; 2],
    periodic: [bool; 2],
    /// Half of the width of the disc in each row, from its middle row on.
    half_widths: Vec<usize>,
    /// Differences along rows, which have one place more than there are columns.
    differences: Vec<u32>,
    sums: Vec<u32>,
    changed: Vec<bool>,
}

impl DiscSums {
    /// Sums of zeros over discs of `radius` spacings.
    pub(super) fn new(lattice: &Lattice, radius: f64) -> Self {
        let size = [lattice.width(), lattice.height()];
        let rows = (radius as usize).min(size[1]);
        Self {
            size,
            periodic: [0, 1].map(|axis| lattice.is_periodic(axis)),
            half_widths: (0..=rows).map(|row| half_width(radius, row)).collect(),
            differences: vec![0; (size[0] + 1) * size[1]],
            sums: vec![0; size[0] * size[1]],
            changed: vec![false; size[1]],
        }
    }

    /// Adds `change` to the number at column `x`, row `y`.
    pub(super) fn add(&mut self, [x, y]: [usize; 2], change: i32) {
        let [width, height] = self.size;
        let change = change as u32;
        // Every row is met once, over the shorter way where the axis is periodic.
        let north = if self.periodic[1] { (height - 1) / 2 } else { y };
        let south = if self.periodic[1] { height / 2 } else { height - 1 - y };
        let reach = self.half_widths.len() - 1;
        let [north, south] = [north, south].map(|rows| rows.min(reach));
        for row in 0..=north + south {
            let away = north.abs_diff(row);
            let y = (y + height + row - north) % height;
            self.changed[y] = true;
            let half = self.half_widths[away];
            let row = &mut self.differences[y * (width + 1)..(y + 1) * (width + 1)];
            match self.periodic[0] {
                false => write(row, x.saturating_sub(half), (x + half + 1).min(width), change),
                true if 2 * half + 1 >= width => write(row, 0, width, change),
                true => {
                    let (start, end) = (x + width - half, x + half + 1);
                    match (start >= width, end <= width) {
                        (true, true) => write(row, start - width, end, change),
                        (false, _) => {
                            write(row, start, width, change);
                            write(row, 0, end, change);
                        }
                        (true, false) => {
                            write(row, start - width, width, change);
                            write(row, 0, end - width, change);
                        }
                    }
                }
            }
        }
    }

    /// Makes the sums follow the changes.
    pub(super) fn refresh(&mut self) {
        let width = self.size[0];
        let rows = self.differences.chunks_exact(width + 1).zip(self.sums.chunks_exact_mut(width));
        for ((differences, sums), changed) in rows.zip(&mut self.changed) {
            if std::mem::take(changed) {
                let mut sum = 0_u32;
                for (place, &difference) in sums.iter_mut().zip(differences) {
                    sum = sum.wrapping_add(difference);
                    *place = sum;
                }
            }
        }
    }

    /// The sum over the disc around a node, as of the latest [`DiscSums::refresh`].
    #[inline]
    pub(super) fn sum(&self, node: usize) -> u32 {
        self.sums[node]
    }
}

/// Columns to either side of the middle that a disc reaches, `row` rows from its middle.
fn half_width(radius: f64, row: usize) -> usize {
    let within = |column: usize| (column * column + row * row) as f64 <= radius * radius;
    let about = (radius * radius - (row * row) as f64).max(0.0).sqrt() as usize;
    // The root is rounded.
    if within(about + 1) { about + 1 } else { about }
}

fn write(row: &mut [u32], start: usize, end: usize, change: u32) {
    row[start] = row[start].wrapping_add(change);
    row[end] = row[end].wrapping_sub(change);
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
        fn sums_are_those_of_the_definition(
            size in [3_usize..14, 3_usize..14],
            boundary in proptest::array::uniform2(proptest::bool::ANY),
            radius in 0.0_f64..16.0,
            seed in 0_u64..1000,
        ) {
            let boundary = boundary.map(|p| if p { Boundary::Periodic } else { Boundary::Open });
            let lattice = Lattice::plane(size, 1.0, Connectivity::Four, boundary).unwrap();
            let random = RandomStream::new(seed, "changes");
            let mut sums = DiscSums::new(&lattice, radius);
            let mut values = vec![0; lattice.node_count()];
            for change in 0..20 {
                let node = random.block(change, 0, 0)[0] as usize % values.len();
                let amount = (random.block(change, 0, 0)[1] % 9) as i32 - 4;
                values[node] += amount;
                let [x, y, _] = lattice.coordinates(node);
                sums.add([x, y], amount);
                sums.refresh();
                for center in 0..values.len() {
                    let expected = by_definition(&lattice, &values, center, radius);
                    prop_assert_eq!(sums.sum(center) as i32, expected);
                }
            }
        }
    }
}
