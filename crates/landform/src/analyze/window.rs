//! The largest part of a raster without gaps.

use landform_analysis::grid::Grid;
use serde::Serialize;

/// A rectangle of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Window {
    /// First column, from the west.
    pub column: usize,
    /// First row, from the north.
    pub row: usize,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
}

impl Window {
    /// The rectangle with the most cells among those without a cell that is NaN; of several the
    /// one that ends first. `None` when all cells are NaN.
    ///
    /// Cost: one pass over the cells. Each row is the foot of columns of complete cells above it,
    /// and the largest rectangle below such a skyline is found with a stack.
    pub fn largest_complete(grid: &Grid, heights: &[f64]) -> Option<Self> {
        let columns = grid.columns();
        let mut depths = vec![0; columns];
        let mut best: Option<Self> = None;
        for (row, line) in heights.chunks_exact(columns).enumerate() {
            for (depth, height) in depths.iter_mut().zip(line) {
                *depth = if height.is_nan() { 0 } else { *depth + 1 };
            }
            let Some((column, width, depth)) = largest_below(&depths) else { continue };
            if width * depth > best.map_or(0, |best| best.cell_count()) {
                best = Some(Self { column, row: row + 1 - depth, columns: width, rows: depth });
            }
        }
        best
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.columns * self.rows
    }

    /// The values of its cells, from those of a raster with `columns` columns.
    pub fn cut<T: Copy>(&self, values: &[T], columns: usize) -> Vec<T> {
        let mut part = Vec::with_capacity(self.cell_count());
        for line in values.chunks_exact(columns).skip(self.row).take(self.rows) {
            part.extend_from_slice(&line[self.column..self.column + self.columns]);
        }
        part
    }
}

/// First column, width and depth of the largest rectangle below a skyline.
fn largest_below(depths: &[usize]) -> Option<(usize, usize, usize)> {
    // Columns from which a rectangle of a depth may still go on, the deepest last.
    let mut open: Vec<(usize, usize)> = Vec::new();
    let mut best = None;
    let mut most = 0;
    for (column, depth) in depths.iter().copied().chain([0]).enumerate() {
        let mut start = column;
        while let Some((first, deeper)) = open.pop_if(|&mut (_, open)| open >= depth) {
            if (column - first) * deeper > most {
                most = (column - first) * deeper;
                best = Some((first, column - first, deeper));
            }
            start = first;
        }
        open.push((start, depth));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every rectangle, tried one by one.
    fn reference(grid: &Grid, heights: &[f64]) -> usize {
        let complete = |window: &Window| {
            window.cut(heights, grid.columns()).iter().all(|height| !height.is_nan())
        };
        let mut most = 0;
        for cell in 0..grid.cell_count() {
            let [column, row] = grid.position(cell);
            for columns in 1..=grid.columns() - column {
                for rows in 1..=grid.rows() - row {
                    let window = Window { column, row, columns, rows };
                    if complete(&window) {
                        most = most.max(window.cell_count());
                    }
                }
            }
        }
        most
    }

    #[test]
    fn the_window_is_as_large_as_any_and_has_no_gap() {
        for seed in 0..60_u64 {
            let size = [1 + seed as usize % 7, 1 + seed as usize / 7];
            let grid = Grid::new(size, [1.0; 2]).unwrap();
            let heights: Vec<f64> = (0..grid.cell_count() as u64)
                .map(|cell| match (cell * 7919 + seed * 104_729) % 13 {
                    0..3 => f64::NAN,
                    other => other as f64,
                })
                .collect();
            let found = Window::largest_complete(&grid, &heights);
            let cells = found.map_or(0, |window| window.cell_count());
            assert_eq!(cells, reference(&grid, &heights), "{size:?} {heights:?}");
            let part = found.map_or(Vec::new(), |window| window.cut(&heights, grid.columns()));
            assert!(part.len() == cells && part.iter().all(|height| !height.is_nan()));
        }
    }

    #[test]
    fn a_raster_without_gaps_is_its_own_window() {
        let grid = Grid::new([5, 3], [1.0; 2]).unwrap();
        let whole = Window { column: 0, row: 0, columns: 5, rows: 3 };
        assert_eq!(Window::largest_complete(&grid, &[0.0; 15]), Some(whole));
        assert_eq!(Window::largest_complete(&grid, &[f64::NAN; 15]), None);
    }
}
