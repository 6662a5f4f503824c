//! The water columns of a lattice, in whole units, between import from fields and export to them.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::marks::{Marks, each_column, inner};
use super::units::{MOST_M, UNIT_M, metres, units};
use crate::RiverError;
use crate::error::{check_length, check_values};
use crate::frame::Frame;

/// Elevation beyond open borders: higher than anything that water reaches.
const WALL: i64 = i64::MAX / 4;

/// Rows that a thread takes at once.
pub(super) const ROWS: usize = 8;

/// The water columns of a lattice.
///
/// An iteration imports the fields ([`Columns::begin`]), adds water, lets it flow
/// ([`Sweeper`](super::Sweeper)), takes water away, and exports ([`Columns::finish`]). In between,
/// depths and levels are whole units (2^-32 m), so nothing is lost to rounding.
pub struct Columns {
    pub(super) frame: Frame,
    /// Ground, framed.
    pub(super) bed: Vec<i64>,
    /// Ground and water on it, framed.
    pub(super) level: Vec<i64>,
    /// What came in from neighbours since the iteration began, framed.
    pub(super) received: Vec<i64>,
    /// Nodes with water, and their copies in the frame.
    pub(super) wet: Marks,
}

impl Columns {
    /// Bytes a node that columns take.
    pub const BYTES: usize = 25;

    /// Columns for a lattice, empty so far.
    ///
    /// # Errors
    /// [`RiverError::Volume`].
    pub fn new(lattice: &Lattice) -> Result<Self, RiverError> {
        let frame = Frame::new(lattice)?;
        let count = frame.len();
        Ok(Self {
            bed: vec![WALL; count],
            level: vec![WALL; count],
            received: vec![0; count],
            wet: Marks::new(frame.stride, frame.height + 2),
            frame,
        })
    }

    /// Begins an iteration with `bed` (elevation, metres) and `water` (depth, metres).
    ///
    /// # Errors
    /// [`RiverError::Length`]; [`RiverError::Value`], also of negative depths.
    pub fn begin(&mut self, bed: &[f64], water: &[f64]) -> Result<(), RiverError> {
        let count = self.frame.width * self.frame.height;
        check_length("bed", bed.len(), count)?;
        check_length("water", water.len(), count)?;
        check_values("bed", bed, -MOST_M)?;
        check_values("water", water, 0.0)?;
        let Self { frame, bed: beds, level: levels, received, wet } = self;
        let width = frame.width;
        let rows = frame
            .rows_of(beds)
            .zip(frame.rows_of(levels))
            .zip(frame.rows_of(received))
            .zip(wet.rows_mut().skip(1));
        let fields = bed.par_chunks_exact(width).zip(water.par_chunks_exact(width));
        rows.zip(fields).with_min_len(ROWS).for_each(|(state, (bed_m, water_m))| {
            let (((bed, level), received), wet) = state;
            received.fill(0);
            wet.fill(0);
            for (at, (&bed_m, &water_m)) in (1..).zip(bed_m.iter().zip(water_m)) {
                let depth = units(water_m);
                bed[at] = units(bed_m);
                level[at] = bed[at] + depth;
                wet[at / 64] |= u64::from(depth > 0) << (at % 64);
            }
        });
        self.wrap();
        Ok(())
    }

    /// Adds so many units of water to a node.
    fn pour(&mut self, node: usize, amount: i64) {
        let at = self.frame.at(node);
        self.level[at] += amount;
        let (row, column) = (at / self.frame.stride, at % self.frame.stride);
        self.wet.set(row, column, self.level[at] > self.bed[at]);
    }

    /// Adds `depth_m` metres of water to every node, and those of `more_m` where that is given: one
    /// value a node. Returns how much it was in all, in metres of depth summed over nodes.
    ///
    /// # Errors
    /// [`RiverError::Length`]; [`RiverError::Value`] of rain that is negative.
    pub fn rain(&mut self, depth_m: f64, more_m: Option<&[f64]>) -> Result<f64, RiverError> {
        let Self { frame, bed, level, wet, .. } = self;
        let width = frame.width;
        if let Some(more_m) = more_m {
            check_length("rain", more_m.len(), width * frame.height)?;
            check_values("rain", more_m, 0.0)?;
        }
        let bed = &*bed;
        let rows = frame.rows_of(level).zip(wet.rows_mut().skip(1)).enumerate().with_min_len(ROWS);
        let fallen: Vec<i128> = rows
            .map(|(row, (level, wet))| {
                let bed = &bed[(row + 1) * frame.stride..][..frame.stride];
                let more = more_m.map(|values| &values[row * width..][..width]);
                let mut fallen = 0;
                for at in 1..=width {
                    let amount = units(depth_m + more.map_or(0.0, |more| more[at - 1]));
                    level[at] += amount;
                    wet[at / 64] |= u64::from(level[at] > bed[at]) << (at % 64);
                    fallen += i128::from(amount);
                }
                fallen
            })
            .collect();
        self.wrap();
        Ok(in_metres(fallen.iter().sum()))
    }

    /// Adds `amount_m` metres of depth to each of `nodes`; returns the sum.
    pub fn feed(&mut self, nodes: &[usize], amount_m: f64) -> f64 {
        let amount = units(amount_m);
        nodes.iter().for_each(|&node| self.pour(node, amount));
        self.wrap();
        in_metres(i128::from(amount) * nodes.len() as i128)
    }

    /// Takes all water off `nodes`; returns the sum of their depths in metres.
    pub fn drain(&mut self, nodes: &[usize]) -> f64 {
        let mut drained = 0;
        for &node in nodes {
            let at = self.frame.at(node);
            let depth = self.level[at] - self.bed[at];
            if depth > 0 {
                self.pour(node, -depth);
                drained += i128::from(depth);
            }
        }
        self.wrap();
        in_metres(drained)
    }

    /// Takes a `share` of the water off every node, whole units and at least one, so that the last
    /// film goes too; returns the sum in metres of depth.
    pub fn lose(&mut self, share: f64) -> f64 {
        if share <= 0.0 {
            return 0.0;
        }
        let Self { frame, bed, level, wet, .. } = self;
        let Frame { width, stride, .. } = *frame;
        let rows = frame.rows_of(level).zip(wet.rows_mut().skip(1));
        let lost: Vec<i128> = rows
            .enumerate()
            .with_min_len(ROWS)
            .map(|(row, (level, wet))| {
                let bed = &bed[(row + 1) * stride..][..stride];
                let mut lost = 0;
                for (index, word) in wet.iter_mut().enumerate() {
                    let mut bits = *word & inner(index, width);
                    while bits != 0 {
                        let bit = bits & bits.wrapping_neg();
                        bits ^= bit;
                        let at = index * 64 + bit.trailing_zeros() as usize;
                        let depth = level[at] - bed[at];
                        let amount = ((depth as f64 * share).ceil() as i64).clamp(1, depth);
                        level[at] -= amount;
                        lost += i128::from(amount);
                        if amount == depth {
                            *word &= !bit;
                        }
                    }
                }
                lost
            })
            .collect();
        self.wrap();
        in_metres(lost.iter().sum())
    }

    /// Ends the iteration: writes depths to `water` and what came in from neighbours to `received`,
    /// both in metres. Depths that did not change keep their bits.
    ///
    /// Returns by how many metres the sum of depths is larger for rounding to whole units: 0 but for
    /// depths that something else than columns wrote.
    pub fn finish(&self, water: &mut [f64], received: &mut [f64]) -> f64 {
        let Frame { width, stride, .. } = self.frame;
        let rows = water.par_chunks_exact_mut(width).zip(received.par_chunks_exact_mut(width));
        let rounded: Vec<f64> = rows
            .enumerate()
            .with_min_len(ROWS)
            .map(|(row, (water, received))| {
                let first = (row + 1) * stride + 1;
                let mut rounded = 0.0;
                for (at, (water, received)) in (first..).zip(water.iter_mut().zip(received)) {
                    *received = metres(self.received[at]);
                    let depth = self.level[at] - self.bed[at];
                    let before = units(*water);
                    if depth != before {
                        rounded += metres(before) - *water;
                        *water = metres(depth);
                    }
                }
                rounded
            })
            .collect();
        rounded.iter().sum()
    }

    /// Puts copies of what lies inside beyond periodic borders.
    pub(super) fn wrap(&mut self) {
        self.frame.wrap(&mut self.bed);
        self.frame.wrap(&mut self.level);
        self.wet.wrap(&self.frame);
    }
}

/// A sum of units in metres.
fn in_metres(units: i128) -> f64 {
    units as f64 * UNIT_M
}

/// Calls `visit` with the framed indices of a row's nodes in a set of marks.
pub(super) fn each_of(
    marks: &Marks,
    frame: &Frame,
    row: usize,
    mut visit: impl FnMut(usize, usize),
) {
    each_column(marks.row(row), frame.width, |column| visit(row * frame.stride + column, column));
}
