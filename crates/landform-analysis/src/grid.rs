//! The grid that measures of real terrain work on: cells may be oblong and without data.

use std::ops::Range;

use thiserror::Error;

/// Why heights and a grid do not make a terrain that can be measured.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GridError {
    /// An axis has no cells, or there are more cells than can be numbered.
    #[error("the grid has {0} columns and {1} rows; it needs 1 to {most} cells", most = Grid::MOST_CELLS)]
    Size(usize, usize),
    /// A side of a cell is not a positive finite length.
    #[error("a cell is {0} m wide and {1} m high; both must be positive finite numbers of metres")]
    CellSize(f64, f64),
    /// The field does not belong to the grid.
    #[error("the field has {values} values but the grid has {cells} cells; pass one a cell")]
    Length {
        /// Number of values passed.
        values: usize,
        /// Number of cells of the grid.
        cells: usize,
    },
    /// A height is infinite or so large that its square could be.
    #[error(
        "the height of column {column}, row {row} is {value}; heights must stay below 1e100, \
         and a cell without data is NaN"
    )]
    Infinite {
        /// Column of the first such cell.
        column: usize,
        /// Row of that cell.
        row: usize,
        /// Its height.
        value: f64,
    },
}

/// The eight steps to the cells around one, as columns and rows, in the order of
/// `landform_graph::Lattice::neighbours`: E, N, W, S, NE, NW, SW, SE.
pub(crate) const STEPS: [[isize; 2]; 8] =
    [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];

/// Shape and cell size of a raster. Cell `column + columns * row`; row 0 is the north.
///
/// Heights on a grid are `f64` in metres, one a cell; a cell without data is NaN. For rasters in
/// degrees take the size of a cell on the ground at the middle of the raster (as
/// `landform_io::Georeference::ground_cell_size_m` does): the width of cells is then exact on the
/// middle row only and off by the change of the cosine of latitude elsewhere, 0.9 % half a degree
/// from the middle at 45 degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    size: [usize; 2],
    cell: [f64; 2],
}

impl Grid {
    /// Largest number of cells: they are numbered with 32 bits.
    pub const MOST_CELLS: usize = u32::MAX as usize - 1;

    /// A grid of `size` columns and rows whose cells are `cell` metres wide (east) and high
    /// (south).
    ///
    /// # Errors
    /// [`GridError::Size`] and [`GridError::CellSize`].
    pub fn new(size: [usize; 2], cell: [f64; 2]) -> Result<Self, GridError> {
        let [columns, rows] = size;
        let fits = |cells: usize| (1..=Self::MOST_CELLS).contains(&cells);
        if !columns.checked_mul(rows).is_some_and(fits) {
            return Err(GridError::Size(columns, rows));
        }
        if !cell.iter().all(|side| *side > 0.0 && side.is_finite()) {
            return Err(GridError::CellSize(cell[0], cell[1]));
        }
        Ok(Self { size, cell })
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.size[0]
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.size[1]
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.columns() * self.rows()
    }

    /// Width and height of a cell in metres.
    pub fn cell_size(&self) -> [f64; 2] {
        self.cell
    }

    /// Area of a cell in square metres.
    pub fn cell_area(&self) -> f64 {
        self.cell[0] * self.cell[1]
    }

    /// Whether a cell lies on the edge of the grid.
    pub fn is_edge(&self, cell: usize) -> bool {
        let [column, row] = self.position(cell);
        !self.inner(self.columns()).contains(&column) || !self.inner(self.rows()).contains(&row)
    }

    /// Column and row of a cell.
    pub fn position(&self, cell: usize) -> [usize; 2] {
        [cell % self.columns(), cell / self.columns()]
    }

    /// The up to eight cells around one, each with the number of the step that leads to it: see
    /// [`FlowDirections`](crate::hydrology::FlowDirections) for the order.
    pub fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, usize)> + use<'_> {
        let position = self.position(cell);
        STEPS.iter().enumerate().filter_map(move |(direction, step)| {
            let column = position[0].checked_add_signed(step[0])?;
            let row = position[1].checked_add_signed(step[1])?;
            (column < self.columns() && row < self.rows())
                .then(|| (direction, column + self.columns() * row))
        })
    }

    /// Length in metres of each of the eight steps to a neighbour, in the order E, N, W, S, NE, NW,
    /// SW, SE.
    pub fn step_lengths(&self) -> [f64; 8] {
        STEPS.map(|[x, y]| (x as f64 * self.cell[0]).hypot(y as f64 * self.cell[1]))
    }

    /// What each of the eight steps adds to the index of a cell.
    pub(crate) fn step_offsets(&self) -> [isize; 8] {
        STEPS.map(|[x, y]| x + y * self.columns() as isize)
    }

    /// Cells along an axis of `count` cells that have neighbours on both sides.
    pub(crate) fn inner(&self, count: usize) -> Range<usize> {
        1..count.max(2) - 1
    }

    /// Checks that there is one height a cell, each a moderate number or NaN.
    pub(crate) fn check(&self, heights: &[f64]) -> Result<(), GridError> {
        if heights.len() != self.cell_count() {
            return Err(GridError::Length { values: heights.len(), cells: self.cell_count() });
        }
        match heights.iter().position(|height| height.abs() >= 1e100) {
            None => Ok(()),
            Some(cell) => {
                let [column, row] = self.position(cell);
                Err(GridError::Infinite { column, row, value: heights[cell] })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_grids_and_fields_are_refused() {
        assert_eq!(Grid::new([0, 3], [1.0; 2]), Err(GridError::Size(0, 3)));
        assert!(Grid::new([1 << 40, 1 << 40], [1.0; 2]).is_err());
        for side in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Grid::new([2, 2], [1.0, side]).is_err());
        }
        let grid = Grid::new([2, 2], [1.0; 2]).unwrap();
        assert_eq!(grid.check(&[0.0; 3]), Err(GridError::Length { values: 3, cells: 4 }));
        let refused = grid.check(&[0.0, f64::NAN, f64::NEG_INFINITY, 0.0]).unwrap_err();
        assert!(refused.to_string().starts_with("the height of column 0, row 1 is -inf"));
    }

    #[test]
    fn neighbours_and_edges_are_those_of_the_picture() {
        let grid = Grid::new([3, 3], [3.0, 4.0]).unwrap();
        let around: Vec<usize> = grid.neighbours(4).map(|(_, cell)| cell).collect();
        assert_eq!(around, [5, 1, 3, 7, 2, 0, 6, 8]);
        assert_eq!(grid.neighbours(0).collect::<Vec<_>>(), [(0, 1), (3, 3), (7, 4)]);
        assert_eq!(grid.step_lengths(), [3.0, 4.0, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0]);
        assert_eq!((0..9).filter(|&cell| !grid.is_edge(cell)).collect::<Vec<_>>(), [4]);
        let line = Grid::new([1, 5], [1.0; 2]).unwrap();
        assert!((0..5).all(|cell| line.is_edge(cell)));
    }
}
