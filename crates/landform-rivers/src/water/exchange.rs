//! A sweep: all nodes give to their lower neighbours at the same moment.
//!
//! Four passes, each of which writes every node from its own surroundings only:
//!
//! 1. *share*: a wet node decides what its neighbours are to get ([`Sharing`]);
//! 2. *take*: a node adds up what it is offered. It takes no more than brings it to the level that
//!    the highest giver would be left with, and the same part of every offer;
//! 3. *settle*: a giver keeps what was not taken;
//! 4. *move*: levels change.
//!
//! In a pond, several nodes see the same hollow at once and each would fill it; the limit of the
//! second pass keeps them from making a hill of it, and no level rises above the highest or falls
//! below the lowest around. On a slope receivers lie far below givers and the limit does nothing.
//!
//! Nothing depends on an order of nodes, so the sweep has no direction: symmetric ground keeps water
//! symmetric, bit for bit.

use rayon::prelude::*;

use super::columns::{Columns, ROWS, each_of};
use super::marks::Marks;
use super::sharing::Sharing;
use crate::frame::Frame;

/// A sweep by rule `S`, and its memory: framed values, of which only those of nodes near water are
/// touched, and all are back at nothing when the sweep is over.
pub(super) struct Exchange<S: Sharing> {
    /// What wet nodes decided.
    share: Vec<S::Share>,
    /// What nodes give: first what they offer, after the third pass what was taken.
    given: Vec<i64>,
    /// What nodes take.
    gain: Vec<i64>,
    /// Part of each offer that nodes take, 1 for all.
    part: Vec<f64>,
    /// Nodes in or beside wet ones.
    near: Marks,
    /// Rows where a node does not take all it is offered.
    limited: Vec<bool>,
}

impl<S: Sharing> Exchange<S> {
    pub(super) fn new(frame: &Frame) -> Self {
        let count = frame.len();
        Self {
            share: vec![S::NOTHING; count],
            given: vec![0; count],
            gain: vec![0; count],
            part: vec![1.0; count],
            near: Marks::new(frame.stride, frame.height + 2),
            limited: vec![false; frame.height + 2],
        }
    }

    /// Lets water flow once.
    pub(super) fn sweep(&mut self, columns: &mut Columns) {
        self.near.surround(&columns.wet);
        self.share(columns);
        self.take(columns);
        if self.limited.contains(&true) {
            self.settle(columns);
        }
        self.shift(columns);
        self.near.wrap_values(&columns.frame, &mut columns.level);
        columns.wet.wrap(&columns.frame);
    }

    /// First pass: wet nodes decide.
    fn share(&mut self, columns: &Columns) {
        let Columns { frame, bed, level, wet, .. } = columns;
        let rows = frame.rows_of(&mut self.share).zip(frame.rows_of(&mut self.given));
        rows.enumerate().with_min_len(ROWS).for_each(|(row, (share, given))| {
            each_of(wet, frame, row + 1, |at, column| {
                let around = frame.around(level, at);
                let degree = frame.degree(row + 1, column);
                let decided = S::share(level[at], level[at] - bed[at], &around[..degree]);
                (share[column], given[column]) = decided;
            });
        });
        self.near.wrap_values(frame, &mut self.share);
        self.near.wrap_values(frame, &mut self.given);
    }

    /// Second pass: nodes near water add up their offers and take what they can.
    fn take(&mut self, columns: &Columns) {
        let Columns { frame, level, .. } = columns;
        let Self { share, given, gain, part, near, limited } = self;
        let rows = frame.rows_of(gain).zip(frame.rows_of(part)).zip(limited[1..].par_iter_mut());
        rows.enumerate().with_min_len(ROWS).for_each(|(row, ((gain, part), limited))| {
            *limited = false;
            each_of(near, frame, row + 1, |at, column| {
                let degree = frame.degree(row + 1, column);
                let (levels, shares) = (frame.around(level, at), frame.around(share, at));
                let offer = |k: usize| S::gift(shares[k], levels[k], level[at]);
                let offered: i64 = (0..degree).map(offer).sum();
                gain[column] = offered;
                if offered > 0 {
                    let left = frame.around(given, at);
                    let givers = (0..degree).filter(|&k| offer(k) > 0);
                    let highest = givers.map(|k| levels[k] - left[k]).max().unwrap_or(level[at]);
                    let room = (highest - level[at]).max(0);
                    if room < offered {
                        *limited = true;
                        part[column] = room as f64 / offered as f64;
                        gain[column] = (0..degree).map(|k| taken(offer(k), part[column])).sum();
                    }
                }
            });
        });
        near.wrap_values(frame, part);
    }

    /// Third pass: givers keep what was not taken.
    fn settle(&mut self, columns: &Columns) {
        let Columns { frame, level, wet, .. } = columns;
        let Self { share, given, part, limited, .. } = self;
        let periodic = frame.is_periodic(1);
        let rows = frame.rows_of(given).enumerate().with_min_len(ROWS);
        rows.for_each(|(row, given)| {
            let beside = limited[row] || limited[row + 1] || limited[row + 2];
            let at_border = periodic && (row == 0 || row + 1 == frame.height);
            if !beside && !at_border {
                return;
            }
            each_of(wet, frame, row + 1, |at, column| {
                let (levels, parts) = (frame.around(level, at), frame.around(part, at));
                let offer = |k: usize| S::gift(share[at], level[at], levels[k]);
                let neighbours = 0..frame.degree(row + 1, column);
                given[column] = neighbours.map(|k| taken(offer(k), parts[k])).sum();
            });
        });
    }

    /// Fourth pass: levels change, and the memory is made ready for the next sweep.
    fn shift(&mut self, columns: &mut Columns) {
        let Columns { frame, bed, level, received, wet } = columns;
        let frame = &*frame;
        let Self { share, given, gain, part, near, .. } = self;
        let memory = frame
            .rows_of(share)
            .zip(frame.rows_of(given))
            .zip(frame.rows_of(gain))
            .zip(frame.rows_of(part));
        let state = frame.rows_of(level).zip(frame.rows_of(received)).zip(wet.rows_mut().skip(1));
        let rows = memory.zip(state).enumerate().with_min_len(ROWS);
        rows.for_each(|(row, ((((share, given), gain), part), ((level, received), wet)))| {
            let bed = &bed[(row + 1) * frame.stride..][..frame.stride];
            each_of(near, frame, row + 1, |_, column| {
                level[column] += gain[column] - given[column];
                received[column] += gain[column];
                let bit = 1 << (column % 64);
                let word = &mut wet[column / 64];
                *word = if level[column] > bed[column] { *word | bit } else { *word & !bit };
                (share[column], part[column]) = (S::NOTHING, 1.0);
                (given[column], gain[column]) = (0, 0);
            });
        });
        let Self { share, given, part, near, .. } = self;
        near.wrap_values(frame, share);
        near.wrap_values(frame, given);
        near.wrap_values(frame, part);
    }
}

/// What is taken of an offer.
#[inline(always)]
fn taken(offer: i64, part: f64) -> i64 {
    if part == 1.0 { offer } else { ((offer as f64 * part) as i64).min(offer) }
}
