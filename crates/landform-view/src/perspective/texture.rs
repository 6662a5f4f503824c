//! Colours of a surface at every distance: a pyramid of ever coarser pictures.

use rayon::prelude::*;

use crate::light::{Rgb, mix};
use crate::surface::{Surface, bound};

/// Colours of the nodes of a surface and their means over 2 x 2, 4 x 4, ... nodes (mip maps;
/// Williams 1983, "Pyramidal parametrics"), so that distant ground is a mean and not a sample.
pub(crate) struct Texture {
    levels: Vec<Level>,
    periodic: bool,
}

struct Level {
    columns: usize,
    rows: usize,
    colours: Vec<Rgb>,
}

impl Texture {
    /// The pyramid over the colours of a surface's nodes.
    pub(crate) fn new(surface: &Surface, colours: Vec<Rgb>) -> Self {
        let mut levels = vec![Level { columns: surface.columns, rows: surface.rows, colours }];
        while let Some(last) = levels.last().filter(|last| last.columns.max(last.rows) > 1) {
            let coarser = last.halved();
            levels.push(coarser);
        }
        Self { levels, periodic: surface.periodic }
    }

    /// Colour at a place in nodes of the surface, averaged over about `width` nodes.
    pub(crate) fn colour(&self, column: f64, row: f64, width: f64) -> Rgb {
        let level = width.max(1.0).log2().min((self.levels.len() - 1) as f64);
        let finer = level as usize;
        let first = self.bilinear(finer, column, row);
        match self.levels.len() > finer + 1 {
            true => mix(first, self.bilinear(finer + 1, column, row), level.fract() as f32),
            false => first,
        }
    }

    /// Colour at a place in nodes of the surface, interpolated between the means of one level.
    fn bilinear(&self, level: usize, column: f64, row: f64) -> Rgb {
        let scale = (1_u64 << level) as f64;
        let level = &self.levels[level];
        let [column, row] = [column, row].map(|place| (place + 0.5) / scale - 0.5);
        let (west, north) = (column.floor(), row.floor());
        let (x, y) = ((column - west) as f32, (row - north) as f32);
        let node = |east: isize, south: isize| {
            let column = bound(west as isize + east, level.columns, self.periodic);
            let row = bound(north as isize + south, level.rows, self.periodic);
            level.colours[column + level.columns * row]
        };
        mix(mix(node(0, 0), node(1, 0), x), mix(node(0, 1), node(1, 1), x), y)
    }
}

impl Level {
    /// Means over 2 x 2 nodes; an odd last column or row counts twice.
    fn halved(&self) -> Self {
        let [columns, rows] = [self.columns, self.rows].map(|size| size.div_ceil(2));
        let mut colours = vec![[0.0; 3]; columns * rows];
        colours.par_chunks_mut(columns).enumerate().for_each(|(row, line)| {
            for (column, colour) in line.iter_mut().enumerate() {
                let across = [2 * column, (2 * column + 1).min(self.columns - 1)];
                let down = [2 * row, (2 * row + 1).min(self.rows - 1)];
                let node = |i: usize, j: usize| self.colours[across[i] + self.columns * down[j]];
                *colour =
                    mix(mix(node(0, 0), node(1, 0), 0.5), mix(node(0, 1), node(1, 1), 0.5), 0.5);
            }
        });
        Self { columns, rows, colours }
    }
}
