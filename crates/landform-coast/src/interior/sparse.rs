//! Symmetric matrices with few entries a row.

use rayon::prelude::*;

/// Rows that one task handles at least.
const LEAST_ROWS: usize = 2048;

/// A symmetric matrix, row by row.
#[derive(Debug)]
pub(super) struct Matrix {
    /// Where each row begins among the entries, and where the last one ends.
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Matrix {
    /// Makes a matrix of rows that `fill` writes, as pairs of column and value; each column comes
    /// once in a row.
    pub fn new(rows: usize, mut fill: impl FnMut(usize, &mut Vec<(u32, f64)>)) -> Self {
        let (mut starts, mut diagonal) = (vec![0], vec![0.0; rows]);
        let (mut columns, mut values, mut entries) = (Vec::new(), Vec::new(), Vec::new());
        for (row, diagonal) in diagonal.iter_mut().enumerate() {
            entries.clear();
            fill(row, &mut entries);
            for &(column, value) in &entries {
                if column as usize == row {
                    *diagonal = value;
                }
                columns.push(column);
                values.push(value);
            }
            starts.push(columns.len());
        }
        Self { starts, columns, values, diagonal }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// The largest entry of the diagonal.
    pub fn largest_diagonal(&self) -> f64 {
        self.diagonal.iter().copied().fold(0.0, f64::max)
    }

    /// Entries of a row: columns and values.
    #[inline]
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[row]..self.starts[row + 1];
        let columns = self.columns[range.clone()].iter().map(|&column| column as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// A row times `x`.
    #[inline]
    pub fn dot(&self, row: usize, x: &[f64]) -> f64 {
        self.row(row).map(|(column, value)| value * x[column]).sum()
    }

    /// Writes the matrix times `x`.
    pub fn apply(&self, x: &[f64], product: &mut [f64]) {
        product
            .par_iter_mut()
            .enumerate()
            .with_min_len(LEAST_ROWS)
            .for_each(|(row, product)| *product = self.dot(row, x));
    }

    /// What row `row` adds to `x[row]` in a step of Gauss and Seidel for the given right side.
    #[inline]
    pub fn correction(&self, row: usize, x: &[f64], right: f64) -> f64 {
        let diagonal = self.diagonal[row];
        // A row without a diagonal is empty: nothing depends on its value.
        if diagonal > 0.0 { (right - self.dot(row, x)) / diagonal } else { 0.0 }
    }

    /// The rows and columns that are chosen, in their order.
    pub fn among(&self, chosen: &[u32]) -> Self {
        let mut place = vec![u32::MAX; self.len()];
        chosen.iter().zip(0..).for_each(|(&row, at)| place[row as usize] = at);
        Self::new(chosen.len(), |row, entries| {
            let own = self.row(chosen[row] as usize);
            let kept = own.map(|(column, value)| (place[column], value));
            entries.extend(kept.filter(|&(column, _)| column != u32::MAX));
        })
    }
}
