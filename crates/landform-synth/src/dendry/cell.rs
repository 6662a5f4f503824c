//! The grids of the levels, and the key points in their cells.

use landform_sim::random::{RandomStream, unit};

/// A place in units of the cells of level 0.
pub(super) type Point = [f64; 2];

/// A cell of the grid of a level, whose cells are half as wide as those of the level before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub level: u32,
    /// Column from west and row from south.
    pub at: [i64; 2],
}

impl Cell {
    /// The cell of a level that holds a point.
    pub fn holding(level: u32, point: Point) -> Self {
        let scale = f64::from(1_u32 << level);
        Self { level, at: point.map(|x| (x * scale).floor() as i64) }
    }

    /// The cell of a coarser level that this one is a part of.
    pub fn ancestor(self, level: u32) -> Self {
        Self { level, at: self.at.map(|index| index >> (self.level - level)) }
    }

    /// Whether a point lies in it.
    pub fn holds(self, point: Point) -> bool {
        Self::holding(self.level, point) == self
    }

    /// Width of the cell.
    pub fn width(self) -> f64 {
        1.0 / f64::from(1_u32 << self.level)
    }

    /// A place in it: 0 to 1 along either axis.
    pub fn place(self, share: [f64; 2]) -> Point {
        [0, 1].map(|axis| (self.at[axis] as f64 + share[axis]) * self.width())
    }

    /// The cells within `reach` columns and rows of this one, from the south, and row by row from
    /// the west.
    pub fn around(self, reach: i64) -> impl Iterator<Item = Self> + Clone {
        let [x, y] = self.at;
        (y - reach..=y + reach).flat_map(move |row| {
            (x - reach..=x + reach).map(move |column| Self { level: self.level, at: [column, row] })
        })
    }
}

/// The key point of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key {
    pub point: Point,
    /// Whether the level adds it; else it is one of a coarser level.
    pub new: bool,
}

/// The random numbers of all cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keys {
    stream: RandomStream,
    epsilon: f64,
}

impl Keys {
    pub fn new(seed: u64, epsilon: f64) -> Self {
        Self { stream: RandomStream::new(seed, "dendry"), epsilon }
    }

    /// Random words of a cell.
    fn words(&self, cell: Cell, index: u32) -> [u32; 4] {
        let [column, row] = cell.at.map(|index| u64::from(index as u32));
        self.stream.block(column | row << 32, cell.level as usize, index)
    }

    /// The point that a cell would have of its own, and a number that decides between equals.
    fn own(&self, cell: Cell) -> (Point, u32) {
        let [x, y, tie, _] = self.words(cell, 0);
        let share = |word| self.epsilon + (1.0 - 2.0 * self.epsilon) * unit(word);
        (cell.place([share(x), share(y)]), tie)
    }

    /// The key point of a cell of level 0, and a number that decides between equals.
    pub fn first(&self, cell: Cell) -> (Point, u32) {
        self.own(cell)
    }

    /// The key point of a cell, given that of the cell it is a part of: that one, if it lies in
    /// it, or one of its own.
    pub fn below(&self, cell: Cell, above: Point) -> Key {
        match cell.holds(above) {
            true => Key { point: above, new: false },
            false => Key { point: self.own(cell).0, new: true },
        }
    }

    /// The key point of a cell of any level.
    pub fn of(&self, cell: Cell) -> Key {
        let first = Key { point: self.first(cell.ancestor(0)).0, new: true };
        (1..=cell.level).fold(first, |key, level| self.below(cell.ancestor(level), key.point))
    }

    /// How far, from -1 to 1, the branch of a cell is pushed aside at its bends.
    pub fn bends(&self, cell: Cell) -> [f64; 3] {
        let [a, b, c, _] = self.words(cell, 1);
        [a, b, c].map(|word| 2.0 * unit(word) - 1.0)
    }
}
