//! Sets of nodes of a framed plane as bits, so that what is dry costs a sixty-fourth.

use rayon::prelude::*;

use crate::frame::Frame;

/// A bit for every value of a framed plane, each row beginning with a word of its own.
#[derive(Clone, Debug)]
pub(crate) struct Marks {
    words_a_row: usize,
    words: Vec<u64>,
}

impl Marks {
    /// An empty set for `rows` rows of `stride` values.
    pub(crate) fn new(stride: usize, rows: usize) -> Self {
        let words_a_row = stride.div_ceil(64);
        Self { words_a_row, words: vec![0; words_a_row * rows] }
    }

    /// The words of a row.
    pub(crate) fn row(&self, row: usize) -> &[u64] {
        &self.words[row * self.words_a_row..][..self.words_a_row]
    }

    /// The words of all rows, row by row.
    pub(crate) fn rows_mut(&mut self) -> rayon::slice::ChunksExactMut<'_, u64> {
        self.words.par_chunks_exact_mut(self.words_a_row)
    }

    /// Whether the set has the value at `column`.
    pub(crate) fn has(&self, row: usize, column: usize) -> bool {
        self.row(row)[column / 64] >> (column % 64) & 1 == 1
    }

    /// Puts the value at `column` into the set or takes it out.
    pub(crate) fn set(&mut self, row: usize, column: usize, member: bool) {
        let word = &mut self.words[row * self.words_a_row + column / 64];
        let bit = 1 << (column % 64);
        *word = if member { *word | bit } else { *word & !bit };
    }

    /// Repeats the marks of the other side of a framed plane beyond its periodic borders.
    pub(crate) fn wrap(&mut self, frame: &Frame) {
        let Frame { width, height, .. } = *frame;
        if frame.is_periodic(0) {
            for row in 1..=height {
                let [first, last] = [self.has(row, 1), self.has(row, width)];
                self.set(row, 0, last);
                self.set(row, width + 1, first);
            }
        }
        if frame.is_periodic(1) {
            self.copy_row(height, 0);
            self.copy_row(1, height + 1);
        }
    }

    /// Repeats the other side of a framed plane beyond its periodic borders, as [`Frame::wrap`], in
    /// rows where this set has a node at a border: enough where no other values changed.
    pub(crate) fn wrap_values<T: Copy>(&self, frame: &Frame, values: &mut [T]) {
        let Frame { width, height, stride, .. } = *frame;
        if frame.is_periodic(0) {
            for row in 1..=height {
                if self.has(row, 1) || self.has(row, width) {
                    let values = &mut values[row * stride..][..stride];
                    (values[0], values[width + 1]) = (values[width], values[1]);
                }
            }
        }
        if frame.is_periodic(1) {
            for (from, to) in [(height, 0), (1, height + 1)] {
                if !is_empty(self.row(from)) {
                    values.copy_within(from * stride..(from + 1) * stride, to * stride);
                }
            }
        }
    }

    /// Makes row `to` what row `from` is.
    fn copy_row(&mut self, from: usize, to: usize) {
        let words = self.words_a_row;
        self.words.copy_within(from * words..(from + 1) * words, to * words);
    }

    /// Makes this the set of all values of inner rows in or beside `core`, diagonals included.
    pub(crate) fn surround(&mut self, core: &Self) {
        let last = self.words.len() / self.words_a_row - 1;
        self.rows_mut().enumerate().with_min_len(64).for_each(|(row, words)| {
            if row == 0 || row == last {
                return words.fill(0);
            }
            let rows = [row - 1, row, row + 1].map(|row| core.row(row));
            if rows.iter().all(|row| is_empty(row)) {
                return words.fill(0);
            }
            let column = |word: usize| rows[0][word] | rows[1][word] | rows[2][word];
            let count = words.len();
            for (word, out) in words.iter_mut().enumerate() {
                let here = column(word);
                let before = if word > 0 { column(word - 1) } else { 0 };
                let after = if word + 1 < count { column(word + 1) } else { 0 };
                *out = here | here << 1 | here >> 1 | before >> 63 | after << 63;
            }
        });
    }
}

/// Calls `visit` with the columns of a row from 1 to `width` that are in the set, in order.
#[inline(always)]
pub(crate) fn each_column(words: &[u64], width: usize, mut visit: impl FnMut(usize)) {
    for (word, &bits) in words.iter().enumerate() {
        if bits == 0 {
            continue;
        }
        let mut bits = bits & inner(word, width);
        while bits != 0 {
            visit(word * 64 + bits.trailing_zeros() as usize);
            bits &= bits - 1;
        }
    }
}

/// Whether none of the bits is set.
fn is_empty(words: &[u64]) -> bool {
    words.iter().fold(0, |all, word| all | word) == 0
}

/// The bits of a word that belong to columns from 1 to `width`.
#[inline]
pub(crate) fn inner(word: usize, width: usize) -> u64 {
    let below = |columns: usize| match columns.saturating_sub(word * 64) {
        count @ 0..64 => (1 << count) - 1,
        _ => u64::MAX,
    };
    below(width + 1) & !below(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn surroundings_are_the_values_beside(
            (width, height) in (1_usize..150, 1_usize..6),
            seed in any::<u64>(),
        ) {
            let mut core = Marks::new(width + 2, height + 2);
            let random = landform_sim::random::RandomStream::new(seed, "marks");
            for row in 0..height + 2 {
                for column in 0..width + 2 {
                    core.set(row, column, random.unit(row as u64, column, 0) < 0.05);
                }
            }
            let mut around = Marks::new(width + 2, height + 2);
            around.surround(&core);
            for row in 1..=height {
                let mut found = Vec::new();
                each_column(around.row(row), width, |column| found.push(column));
                let beside = |&column: &usize| {
                    (row - 1..=row + 1).any(|y| (column - 1..=column + 1).any(|x| core.has(y, x)))
                };
                let expected: Vec<usize> = (1..=width).filter(beside).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }
}
