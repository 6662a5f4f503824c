//! Which parts of the map lie near to changes.

use landform_graph::Lattice;

/// The squares of the map within reach of what changed since the latest clearing.
///
/// A node outside them is farther away from every change than the radius, so that what was
/// found around it still holds. Squares are half a radius wide: coarse enough to cost little,
/// fine enough to leave most of the map out when few nodes change.
#[derive(Clone, Debug)]
pub(super) struct Vicinity {
    /// Width of a square in nodes.
    side: usize,
    /// Number of squares in a row and in a column.
    squares: [usize; 2],
    /// Squares around one that lie within reach.
    reach: isize,
    periodic: [bool; 2],
    changed: Vec<usize>,
    is_changed: Vec<bool>,
    is_near: Vec<bool>,
}

impl Vicinity {
    /// All of the map, within `radius` spacings of changes.
    pub(super) fn everywhere(lattice: &Lattice, radius: f64) -> Self {
        let side = ((radius / 2.0) as usize).max(4);
        let squares = [lattice.width(), lattice.height()].map(|nodes| nodes.div_ceil(side));
        let count = squares[0] * squares[1];
        Self {
            side,
            squares,
            // The last square of a periodic axis may be narrower than the others.
            reach: (radius / side as f64).ceil() as isize + 2,
            periodic: [0, 1].map(|axis| lattice.is_periodic(axis)),
            changed: Vec::new(),
            is_changed: vec![false; count],
            is_near: vec![true; count],
        }
    }

    /// Forgets all changes.
    pub(super) fn clear(&mut self) {
        self.is_near.fill(false);
    }

    /// Everything changes.
    pub(super) fn fill(&mut self) {
        self.is_near.fill(true);
    }

    /// A node, or one beside it, changes.
    pub(super) fn change(&mut self, at: [usize; 2]) {
        let square = self.square(at);
        if !std::mem::replace(&mut self.is_changed[square], true) {
            self.changed.push(square);
        }
    }

    /// Finds what lies near to the changes.
    pub(super) fn spread(&mut self) {
        let range = -self.reach..=self.reach;
        while let Some(square) = self.changed.pop() {
            self.is_changed[square] = false;
            let at = [square % self.squares[0], square / self.squares[0]];
            for south in range.clone() {
                let Some(row) = self.moved(at[1], south, 1) else { continue };
                for east in range.clone() {
                    if let Some(column) = self.moved(at[0], east, 0) {
                        self.is_near[column + row * self.squares[0]] = true;
                    }
                }
            }
        }
    }

    /// Whether a change may lie within the radius of a node.
    #[inline]
    pub(super) fn contains(&self, at: [usize; 2]) -> bool {
        self.is_near[self.square(at)]
    }

    fn square(&self, [x, y]: [usize; 2]) -> usize {
        x / self.side + y / self.side * self.squares[0]
    }

    /// The square some squares away along an axis; `None` beyond the map.
    fn moved(&self, square: usize, by: isize, axis: usize) -> Option<usize> {
        let count = self.squares[axis] as isize;
        let moved = square as isize + by;
        match self.periodic[axis] {
            true => Some(moved.rem_euclid(count) as usize),
            false => (0..count).contains(&moved).then_some(moved as usize),
        }
    }
}
