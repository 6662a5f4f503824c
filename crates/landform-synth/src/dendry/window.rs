//! Rectangles of cells.

use rayon::prelude::*;

use super::cell::Cell;

/// The cells of a level within a rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    pub level: u32,
    /// The south-western cell.
    pub low: [i64; 2],
    /// The north-eastern cell.
    pub high: [i64; 2],
}

impl Window {
    /// The same with a margin of so many cells.
    pub fn grown(self, margin: i64) -> Self {
        Self {
            low: self.low.map(|index| index - margin),
            high: self.high.map(|index| index + margin),
            ..self
        }
    }

    /// The cells of the level before that these are parts of.
    pub fn parents(self) -> Self {
        Self {
            level: self.level - 1,
            low: self.low.map(|index| index >> 1),
            high: self.high.map(|index| index >> 1),
        }
    }

    fn columns(self) -> i64 {
        self.high[0] - self.low[0] + 1
    }

    fn count(self) -> usize {
        (self.columns() * (self.high[1] - self.low[1] + 1)) as usize
    }

    /// Number of a cell, row by row from the south-western one.
    pub fn index(self, cell: Cell) -> usize {
        let [column, row] = [0, 1].map(|axis| cell.at[axis] - self.low[axis]);
        (row * self.columns() + column) as usize
    }

    fn cell(self, index: usize) -> Cell {
        let (row, column) = (index as i64 / self.columns(), index as i64 % self.columns());
        Cell { level: self.level, at: [self.low[0] + column, self.low[1] + row] }
    }

    /// The cells in the order of their numbers.
    pub fn cells(self) -> impl Iterator<Item = Cell> {
        (0..self.count()).map(move |index| self.cell(index))
    }

    /// One value a cell, made in parallel.
    pub fn collect<T: Send>(self, make: impl Fn(Cell) -> T + Sync) -> Vec<T> {
        (0..self.count()).into_par_iter().map(|index| make(self.cell(index))).collect()
    }
}
