//! The function of a [`super::Dendry`] at single places and on grids.

use super::fill::{Grid, fill};
use super::growth::Growth;
use super::heights::Hillslope;

/// A [`Dendry`](super::Dendry) made ready: its value at any place.
///
/// ```
/// use std::path::Path;
/// use landform_synth::Dendry;
///
/// let function = Dendry::default().function(Path::new(""), 10.0, 7)?;
/// // A tile equals the same region of the whole, bit for bit, and both the function at a place.
/// let whole = function.values([0, 0], [64, 64]);
/// let tile = function.values([32, 16], [32, 48]);
/// assert_eq!(tile[5], whole[37]);
/// assert_eq!(tile[5], function.value([37, 63]));
/// # Ok::<(), landform_synth::SynthError>(())
/// ```
#[derive(Debug)]
pub struct DendryFunction {
    pub(super) growth: Growth,
    pub(super) hillslope: Option<Hillslope>,
    pub(super) spacing_m: f64,
}

impl DendryFunction {
    /// The value in metres at a node, by columns east and rows north of the place 0, 0: what the
    /// paper defines, with nothing kept from one place to another. It takes a millisecond, or some
    /// tens for a terrain.
    pub fn value(&self, node: [i64; 2]) -> f64 {
        let point = node.map(|steps| self.place(steps));
        match &self.hillslope {
            Some(hillslope) => self.growth.height_by_definition(hillslope, point),
            None => self.growth.nearest_by_definition(point).0 * self.growth.cell_m,
        }
    }

    /// The values in metres at `[columns, rows]` nodes, the south-western one of which is `from`,
    /// in rows from the north: the same bits as [`DendryFunction::value`], from a tree that is
    /// grown once for all of them, in parallel.
    pub fn values(&self, from: [i64; 2], [width, height]: [usize; 2]) -> Vec<f64> {
        let columns = (0..width as i64).map(|column| self.place(from[0] + column)).collect();
        let rows = (0..height as i64).rev().map(|row| self.place(from[1] + row)).collect();
        fill(&self.growth, self.hillslope.as_ref(), &Grid { columns, rows })
    }

    /// Place of a column or row in cells of level 0.
    fn place(&self, steps: i64) -> f64 {
        steps as f64 * self.spacing_m / self.growth.cell_m
    }
}
