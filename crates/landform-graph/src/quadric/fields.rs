//! Gradient and Laplacian of whole fields, row by row.
//!
//! The inner nodes of a plane are computed from windows over three rows, in the same order of
//! operations as [`Quadric::fit`], so that both give the same bits; border nodes and volumes
//! use [`Quadric::fit`] itself. Rows are independent, so threads change nothing.

use rayon::prelude::*;

use super::Quadric;
use super::line::Line;
use crate::{Connectivity, Lattice};

/// Writes the derivatives of `field` to the east and to the north, in units of the field a
/// metre, at every node. All slices hold one value a node.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn gradient_field(lattice: &Lattice, field: &[f64], east: &mut [f64], north: &mut [f64]) {
    check_length(lattice, &[field.len(), east.len(), north.len()]);
    let width = lattice.width();
    let scale = 1.0 / lattice.spacing();
    let rows = east.par_chunks_mut(width).zip(north.par_chunks_mut(width)).enumerate();
    rows.for_each(|(row, (east, north))| {
        let border = |x: usize| {
            let gradient = Quadric::fit(lattice, field, row * width + x).gradient;
            (gradient.x, gradient.y)
        };
        let mut write = |x: usize, (to_east, to_north): (f64, f64)| {
            east[x] = to_east;
            north[x] = to_north;
        };
        let Some(window) = RowWindow::new(lattice, field, row) else {
            return (0..width).for_each(|x| write(x, border(x)));
        };
        let cross = lattice.connectivity() == Connectivity::Four;
        for_each_inner(width, |x| {
            let (x_slope, y_slope) = if cross { window.cross_slopes(x) } else { window.slopes(x) };
            write(x, (x_slope * scale, y_slope * -scale));
        });
        [0, width - 1].into_iter().for_each(|x| write(x, border(x)));
    });
}

/// Writes the Laplacian of `field`, in units of the field a square metre, at every node.
/// Both slices hold one value a node.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn laplacian_field(lattice: &Lattice, field: &[f64], laplacian: &mut [f64]) {
    check_length(lattice, &[field.len(), laplacian.len()]);
    let width = lattice.width();
    let scale = 1.0 / lattice.spacing();
    laplacian.par_chunks_mut(width).enumerate().for_each(|(row, out)| {
        let border = |x: usize| Quadric::fit(lattice, field, row * width + x).laplacian();
        let Some(window) = RowWindow::new(lattice, field, row) else {
            return (0..width).for_each(|x| out[x] = border(x));
        };
        let cross = lattice.connectivity() == Connectivity::Four;
        for_each_inner(width, |x| {
            let (xx, yy) = if cross { window.cross_curvatures(x) } else { window.curvatures(x) };
            out[x] = xx * scale * scale + yy * scale * scale;
        });
        [0, width - 1].into_iter().for_each(|x| out[x] = border(x));
    });
}

fn check_length(lattice: &Lattice, lengths: &[usize]) {
    for &length in lengths {
        assert_eq!(length, lattice.node_count(), "fields hold one value a node");
    }
}

fn for_each_inner(width: usize, visit: impl FnMut(usize)) {
    (1..width.saturating_sub(1)).for_each(visit);
}

/// The rows to the north and south of a row, and the row itself.
struct RowWindow<'a> {
    north: &'a [f64],
    middle: &'a [f64],
    south: &'a [f64],
}

impl<'a> RowWindow<'a> {
    /// `None` where the window of a plane's row leaves the lattice, and on volumes.
    fn new(lattice: &Lattice, field: &'a [f64], row: usize) -> Option<Self> {
        if lattice.connectivity().is_volume() {
            return None;
        }
        let beside = |step| lattice.offset([0, row, 0], [0, step, 0]);
        let width = lattice.width();
        let slice = |first: usize| &field[first..first + width];
        Some(Self {
            north: slice(beside(-1)?),
            middle: slice(row * width),
            south: slice(beside(1)?),
        })
    }

    #[inline(always)]
    fn lines(&self, x: usize) -> [Line; 3] {
        [self.north, self.middle, self.south].map(|row| Line::of(row[x - 1], row[x], row[x + 1]))
    }

    #[inline(always)]
    fn slopes(&self, x: usize) -> (f64, f64) {
        let [north, middle, south] = self.lines(x);
        let across = Line::of(north.slope, middle.slope, south.slope).mean;
        (across, Line::of(north.mean, middle.mean, south.mean).slope)
    }

    #[inline(always)]
    fn curvatures(&self, x: usize) -> (f64, f64) {
        let [north, middle, south] = self.lines(x);
        let across = Line::of(north.curvature, middle.curvature, south.curvature).mean;
        (across, Line::of(north.mean, middle.mean, south.mean).curvature)
    }

    #[inline(always)]
    fn cross(&self, x: usize) -> [Line; 2] {
        let middle = self.middle;
        let along = Line::of(middle[x - 1], middle[x], middle[x + 1]);
        [along, Line::of(self.north[x], middle[x], self.south[x])]
    }

    #[inline(always)]
    fn cross_slopes(&self, x: usize) -> (f64, f64) {
        let [along, down] = self.cross(x);
        (along.slope, down.slope)
    }

    #[inline(always)]
    fn cross_curvatures(&self, x: usize) -> (f64, f64) {
        let [along, down] = self.cross(x);
        (along.curvature, down.curvature)
    }
}
