//! Steps over a 2-D lattice in plain numbers, for kernels that take millions of them.

use landform_graph::Lattice;

/// Size and closure of a 2-D lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Whether columns close on themselves.
    pub wraps_columns: bool,
    /// Whether rows close on themselves.
    pub wraps_rows: bool,
}

impl Plane {
    /// The plane of a 2-D lattice.
    pub fn new(lattice: &Lattice) -> Self {
        Self {
            width: lattice.width(),
            height: lattice.height(),
            wraps_columns: lattice.is_periodic(0),
            wraps_rows: lattice.is_periodic(1),
        }
    }

    /// Column reached by moving `step` columns from `column`, `None` beyond an open border.
    #[inline]
    pub fn column(&self, column: usize, step: isize) -> Option<usize> {
        moved(column, step, self.width, self.wraps_columns)
    }

    /// Row reached by moving `step` rows from `row`, `None` beyond an open border.
    #[inline]
    pub fn row(&self, row: usize, step: isize) -> Option<usize> {
        moved(row, step, self.height, self.wraps_rows)
    }
}

#[inline]
fn moved(from: usize, step: isize, size: usize, wraps: bool) -> Option<usize> {
    let to = from as isize + step;
    if (0..size as isize).contains(&to) {
        Some(to as usize)
    } else if wraps {
        Some(to.rem_euclid(size as isize) as usize)
    } else {
        None
    }
}
