//! A field inside a frame of no-data, so that every cell has eight neighbours.

use crate::grid::{Grid, STEPS};

/// Values of a grid with a frame of NaN, one cell wide.
#[derive(Clone, Debug)]
pub(crate) struct Framed {
    /// The values, row by row, with the frame.
    pub values: Vec<f64>,
    /// Length of a row with the frame.
    pub stride: usize,
    columns: usize,
}

impl Framed {
    /// Puts a frame around the values of a grid.
    pub fn new(grid: &Grid, values: &[f64]) -> Self {
        let columns = grid.columns();
        let stride = columns + 2;
        let mut framed = Vec::with_capacity(stride * (grid.rows() + 2));
        framed.resize(stride, f64::NAN);
        for row in values.chunks_exact(columns) {
            framed.push(f64::NAN);
            framed.extend_from_slice(row);
            framed.push(f64::NAN);
        }
        framed.resize(framed.len() + stride, f64::NAN);
        Self { values: framed, stride, columns }
    }

    /// Index of a cell among the values with the frame.
    #[inline]
    pub fn index(&self, cell: usize) -> usize {
        cell + self.stride + 1 + 2 * (cell / self.columns)
    }

    /// What each of the eight steps adds to an index, wrapping.
    pub fn offsets(&self) -> [usize; 8] {
        STEPS.map(|[x, y]| (x + y * self.stride as isize) as usize)
    }

    /// The row of cells `row` with the one to its north and the one to its south, frames included.
    pub fn window(&self, row: usize) -> [&[f64]; 3] {
        let stride = self.stride;
        [row, row + 1, row + 2].map(|row| &self.values[row * stride..][..stride])
    }

    /// The values around the cell in `column` of the middle one of three rows, in the order of the
    /// eight steps.
    #[inline(always)]
    pub fn around([north, here, south]: [&[f64]; 3], column: usize) -> [f64; 8] {
        let [west, middle, east] = [column, column + 1, column + 2];
        [
            here[east],
            north[middle],
            here[west],
            south[middle],
            north[east],
            north[west],
            south[west],
            south[east],
        ]
    }

    /// The values without their frame.
    pub fn into_inner(mut self) -> Vec<f64> {
        let [columns, stride] = [self.columns, self.stride];
        let rows = self.values.len() / stride - 2;
        for row in 0..rows {
            let start = (row + 1) * stride + 1;
            self.values.copy_within(start..start + columns, row * columns);
        }
        self.values.truncate(rows * columns);
        self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_around_a_cell_are_those_of_the_steps() {
        let grid = Grid::new([4, 3], [1.0; 2]).unwrap();
        let values: Vec<f64> = (0..12).map(f64::from).collect();
        let framed = Framed::new(&grid, &values);
        for cell in 0..12 {
            let [column, row] = grid.position(cell);
            let around = Framed::around(framed.window(row), column);
            let steps = framed.offsets().map(|step| framed.index(cell).wrapping_add(step));
            let expected = steps.map(|index| framed.values[index]);
            assert_eq!(around.map(f64::to_bits), expected.map(f64::to_bits));
        }
    }

    #[test]
    fn the_frame_goes_on_and_comes_off() {
        let grid = Grid::new([3, 2], [1.0; 2]).unwrap();
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let framed = Framed::new(&grid, &values);
        assert_eq!(framed.values.len(), 20);
        assert_eq!(framed.values.iter().filter(|value| value.is_nan()).count(), 14);
        for (cell, value) in values.iter().enumerate() {
            assert_eq!(framed.values[framed.index(cell)], *value);
        }
        assert_eq!(framed.window(1)[0][1..4], values[..3]);
        assert_eq!(framed.into_inner(), values);
    }
}
