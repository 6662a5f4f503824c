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
/// The values are those of [`Quadric::fit`], bit for bit, on any number of threads; of a
/// volume's gradient the upward part is left out. Cost: inner nodes of a plane are computed
/// from row windows at a small multiple of a memory copy, all others one by one.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn gradient_field(lattice: &Lattice, field: &[f64], east: &mut [f64], north: &mut [f64]) {
    check_length(lattice, &[field.len(), east.len(), north.len()]);
    let width = lattice.width();
    let scale = 1.0 / lattice.spacing();
    let rows = east.par_chunks_mut(width).zip(north.par_chunks_mut(width)).enumerate();
    rows.for_each(|(row, (east, north))| {
        let inner = RowWindow::new(lattice, field, row).map_or(0..0, |window| {
            let out = east[1..].iter_mut().zip(&mut north[1..]);
            match lattice.connectivity() {
                Connectivity::Four => write_slopes(window.crosses().map(slopes), scale, out),
                _ => write_slopes(window.squares().map(slopes), scale, out),
            }
            1..width - 1
        });
        for x in (0..width).filter(|x| !inner.contains(x)) {
            let gradient = Quadric::fit(lattice, field, row * width + x).gradient;
            (east[x], north[x]) = (gradient.x, gradient.y);
        }
    });
}

/// Writes the Laplacian of `field`, in units of the field a square metre, at every node.
/// Both slices hold one value a node.
///
/// The values are those of [`Quadric::fit`], bit for bit, on any number of threads. They are
/// derivatives of the fitted surface, not fluxes: an explicit step of diffusion with them
/// does not conserve volume at open borders.
///
/// # Panics
/// If a slice is not as long as the lattice.
pub fn laplacian_field(lattice: &Lattice, field: &[f64], laplacian: &mut [f64]) {
    check_length(lattice, &[field.len(), laplacian.len()]);
    let width = lattice.width();
    let scale = 1.0 / lattice.spacing();
    laplacian.par_chunks_mut(width).enumerate().for_each(|(row, out)| {
        let inner = RowWindow::new(lattice, field, row).map_or(0..0, |window| {
            let to = out[1..].iter_mut();
            match lattice.connectivity() {
                Connectivity::Four => write_sums(window.crosses().map(curvatures), scale, to),
                _ => write_sums(window.squares().map(curvatures), scale, to),
            }
            1..width - 1
        });
        for x in (0..width).filter(|x| !inner.contains(x)) {
            out[x] = Quadric::fit(lattice, field, row * width + x).laplacian();
        }
    });
}

fn check_length(lattice: &Lattice, lengths: &[usize]) {
    for &length in lengths {
        assert_eq!(length, lattice.node_count(), "fields hold one value a node");
    }
}

#[inline(always)]
fn write_slopes<'a>(
    slopes: impl Iterator<Item = (f64, f64)>,
    scale: f64,
    out: impl Iterator<Item = (&'a mut f64, &'a mut f64)>,
) {
    for ((x_slope, y_slope), (east, north)) in slopes.zip(out) {
        *east = x_slope * scale;
        *north = y_slope * -scale;
    }
}

#[inline(always)]
fn write_sums<'a>(
    curvatures: impl Iterator<Item = (f64, f64)>,
    scale: f64,
    out: impl Iterator<Item = &'a mut f64>,
) {
    for ((xx, yy), out) in curvatures.zip(out) {
        *out = xx * scale * scale + yy * scale * scale;
    }
}

/// What fits along the two axes say of the middle node: see [`RowWindow`].
#[derive(Clone, Copy)]
struct Middle {
    along: Line,
    down: Line,
}

#[inline(always)]
fn slopes(middle: Middle) -> (f64, f64) {
    (middle.along.slope, middle.down.slope)
}

#[inline(always)]
fn curvatures(middle: Middle) -> (f64, f64) {
    (middle.along.curvature, middle.down.curvature)
}

/// The rows to the north and south of a row, and the row itself.
struct RowWindow<'a> {
    north: &'a [f64],
    middle: &'a [f64],
    south: &'a [f64],
}

impl<'a> RowWindow<'a> {
    /// `None` where the window of a plane's row leaves the lattice, on planes without inner
    /// columns, and on volumes.
    fn new(lattice: &Lattice, field: &'a [f64], row: usize) -> Option<Self> {
        let width = lattice.width();
        if lattice.connectivity().is_volume() || width < 3 {
            return None;
        }
        let beside = |step| lattice.offset([0, row, 0], [0, step, 0]);
        let slice = |first: usize| &field[first..first + width];
        Some(Self {
            north: slice(beside(-1)?),
            middle: slice(row * width),
            south: slice(beside(1)?),
        })
    }

    /// Least-squares fits over 3 x 3 nodes, for every inner column.
    fn squares(self) -> impl Iterator<Item = Middle> {
        let windows = |row: &'a [f64]| row.array_windows().map(|&[a, b, c]| Line::of(a, b, c));
        let rows = windows(self.north).zip(windows(self.middle)).zip(windows(self.south));
        rows.map(|((north, middle), south)| {
            let mean =
                |part: fn(Line) -> f64| Line::of(part(north), part(middle), part(south)).mean;
            let (slope, curvature) = (mean(Line::slope), mean(Line::curvature));
            let along = Line { mean: 0.0, slope, curvature };
            Middle { along, down: Line::of(north.mean, middle.mean, south.mean) }
        })
    }

    /// Parabolas through the node along both axes, for every inner column.
    fn crosses(self) -> impl Iterator<Item = Middle> {
        let beside = self.north[1..].iter().zip(&self.south[1..]);
        self.middle.array_windows().zip(beside).map(|(&[a, b, c], (&north, &south))| Middle {
            along: Line::of(a, b, c),
            down: Line::of(north, b, south),
        })
    }
}
