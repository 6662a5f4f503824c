//! Changes of the numbers along a row, by spans.

use super::blocks::{BLOCK, RowOfBlocks};

/// Spans of a row in which numbers change, written at their ends.
///
/// Blocks of columns that lie in any span are marked, so that most of a long row is passed over
/// when its changes lie close together.
#[derive(Clone, Debug)]
pub(super) struct RowChanges {
    /// What changes from each column to the next, with one place beyond the last block.
    differences: Vec<i32>,
    /// Blocks of columns with changes, one bit each.
    marked: Vec<u64>,
}

impl RowChanges {
    /// No changes in rows of `width` columns.
    pub(super) fn new(width: usize) -> Self {
        let blocks = width.div_ceil(BLOCK);
        Self { differences: vec![0; blocks * BLOCK + 1], marked: vec![0; blocks.div_ceil(64)] }
    }

    /// Changes the numbers in columns `start..end` by an amount.
    pub(super) fn write(&mut self, start: usize, end: usize, amount: i32) {
        self.write_spans(std::iter::once((start, end, amount)));
    }

    /// Changes the numbers in spans of columns, from its start up to its end, by amounts.
    #[inline]
    pub(super) fn write_spans(&mut self, spans: impl Iterator<Item = (usize, usize, i32)>) {
        let (mut from, mut to) = (usize::MAX, 0);
        for (start, end, amount) in spans {
            self.differences[start] = self.differences[start].wrapping_add(amount);
            self.differences[end] = self.differences[end].wrapping_sub(amount);
            // Spans that hang together are marked at once.
            if start > to {
                self.mark(from, to);
                from = start;
            }
            (from, to) = (from.min(start), to.max(end));
        }
        self.mark(from, to);
    }

    /// Marks the blocks of columns `start..end`.
    fn mark(&mut self, start: usize, end: usize) {
        if start >= end {
            return;
        }
        let (first, last) = (start / BLOCK, (end - 1) / BLOCK);
        for word in first / 64..=last / 64 {
            let low = first.saturating_sub(64 * word);
            let high = (last - 64 * word).min(63);
            self.marked[word] |= (u64::MAX << low) & (u64::MAX >> (63 - high));
        }
    }

    /// Changes the numbers of a row and forgets the changes; names the columns of numbers that are
    /// below zero then, and that lie near to changes.
    pub(super) fn apply(&mut self, numbers: &mut RowOfBlocks<'_>, mut below: impl FnMut(usize)) {
        let mut sum = 0_i32;
        let mut next = 0;
        for word in 0..self.marked.len() {
            let mut marks = std::mem::take(&mut self.marked[word]);
            while marks != 0 {
                let block = 64 * word + marks.trailing_zeros() as usize;
                marks &= marks - 1;
                if block != next {
                    self.end_spans(next);
                    sum = 0;
                }
                next = block + 1;
                let differences = &mut self.differences[block * BLOCK..next * BLOCK];
                let numbers = numbers.block(block);
                // The sign bit tells whether any of them is below zero.
                let mut signs = 0;
                for (number, difference) in numbers.iter_mut().zip(differences) {
                    sum = sum.wrapping_add(std::mem::take(difference));
                    *number += sum;
                    signs |= *number;
                }
                if signs < 0 {
                    let negative = numbers.iter().enumerate().filter(|(_, number)| **number < 0);
                    negative.for_each(|(column, _)| below(block * BLOCK + column));
                }
            }
        }
        self.end_spans(next);
    }

    /// Forgets the ends of spans that end with the block before this one.
    fn end_spans(&mut self, block: usize) {
        self.differences[block * BLOCK] = 0;
    }
}
