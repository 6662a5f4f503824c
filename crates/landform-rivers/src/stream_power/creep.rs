//! Creep of hillslopes: linear diffusion by explicit steps.

use landform_graph::Lattice;
use rayon::prelude::*;

use crate::RiverError;
use crate::frame::Frame;

/// Lets ground creep: `dz/dt = D lap(z)` with the compact isotropic nine-point Laplacian
/// ([`crate::erosion::compact_laplacian`]), by forward Euler.
///
/// Explicit steps against an implicit scheme: see the book. Steps of at most 0.2 squared spacings make
/// no new highest or lowest points. What one node loses its neighbours gain; nothing crosses walls.
#[derive(Clone, Debug)]
pub struct Creep {
    frame: Frame,
    heights: Vec<f64>,
    next: Vec<f64>,
}

impl Creep {
    /// Bytes a node.
    pub const BYTES: usize = 16;

    /// Memory for creep on a plane.
    ///
    /// # Errors
    /// [`RiverError::Volume`].
    pub fn new(lattice: &Lattice) -> Result<Self, RiverError> {
        let frame = Frame::new(lattice)?;
        let [heights, next] = [vec![0.0; frame.len()], vec![0.0; frame.len()]];
        Ok(Self { frame, heights, next })
    }

    /// Lets the ground `z` (metres) creep for `steps` steps of `share` squared spacings of diffusion.
    /// The nodes of `fixed` keep their heights; `gained` takes, for each of them, the metres that they
    /// would have gained.
    ///
    /// # Panics
    /// If `z` does not have a value a node, or `gained` one for each fixed node.
    pub fn run(
        &mut self,
        z: &mut [f64],
        fixed: &[usize],
        [steps, share]: [f64; 2],
        gained: &mut [f64],
    ) {
        let Self { frame, heights, next } = self;
        let width = frame.width;
        gained.fill(0.0);
        let framed = frame.rows_of(heights).zip(z.par_chunks_exact(width));
        framed.for_each(|(framed, row)| framed[1..=width].copy_from_slice(row));
        for _ in 0..steps as usize {
            frame.extend(heights);
            frame.rows_of(next).enumerate().for_each(|(row, next)| {
                let rows = &heights[row * frame.stride..][..3 * frame.stride];
                creep_row(rows, share / 6.0, &mut next[1..=width]);
            });
            for (gained, &node) in gained.iter_mut().zip(fixed) {
                let at = frame.at(node);
                *gained += next[at] - heights[at];
                next[at] = heights[at];
            }
            std::mem::swap(heights, next);
        }
        let framed = frame.rows_of(heights).zip(z.par_chunks_exact_mut(width));
        framed.for_each(|(framed, row)| row.copy_from_slice(&framed[1..=width]));
    }
}

/// A step of a row, from it and the rows around it, framed. `part` is a sixth of the share.
fn creep_row(rows: &[f64], part: f64, next: &mut [f64]) {
    let stride = rows.len() / 3;
    let width = next.len();
    let from = |row: usize, column: usize| &rows[row * stride + column..][..width];
    let [north_west, north, north_east] = [0, 1, 2].map(|column| from(0, column));
    let [west, here, east] = [0, 1, 2].map(|column| from(1, column));
    let [south_west, south, south_east] = [0, 1, 2].map(|column| from(2, column));
    for x in 0..width {
        let axes = (east[x] + west[x]) + (north[x] + south[x]);
        let diagonals = (north_east[x] + south_west[x]) + (north_west[x] + south_east[x]);
        next[x] = here[x] + part * (4.0 * axes + diagonals - 20.0 * here[x]);
    }
}
