//! What the noises share: cells with random numbers of their own, and how their values come to
//! many points.

use landform_sim::random::{RandomStream, unit};

use super::patch::Patch;

/// The random numbers of the square cells of one octave, and where they start to repeat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    key: u64,
    /// Number of different cells along either axis; 0 where they never repeat.
    period: [i64; 2],
}

impl Cells {
    /// Cells of octave `number`, together with a random shift in cells.
    pub fn new(stream: &RandomStream, number: u64, period: [i64; 2]) -> (Self, [f64; 2]) {
        let [low, high, x, y] = stream.block(number, 0, 0);
        let key = u64::from(low) | u64::from(high) << 32;
        (Self { key, period }, [x, y].map(|word| 64.0 * unit(word)))
    }

    /// Number of different cells along the axes; 0 where they never repeat.
    pub fn period(&self) -> [i64; 2] {
        self.period
    }

    /// 64 random bits of the cell in `column` and `row`, which are wrapped first.
    #[inline]
    pub fn bits(&self, column: i64, row: i64) -> u64 {
        self.hash(wrapped(column, self.period[0]), wrapped(row, self.period[1]))
    }

    /// 64 random bits of two whole numbers.
    #[inline]
    pub fn hash(&self, column: i64, row: i64) -> u64 {
        // A round for either number and a final one: no two octaves are shifted copies.
        let mixed = mix(self.key ^ (column as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        mix(mixed ^ (row as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F))
    }
}

/// `number` modulo `period`, or as it is if there is none.
#[inline]
pub(super) fn wrapped(number: i64, period: i64) -> i64 {
    if period == 0 || (0..period).contains(&number) { number } else { number.rem_euclid(period) }
}

/// Spreads every bit over all of them: the finaliser of SplitMix64 with the constants of
/// Stafford's thirteenth variant.
#[inline]
fn mix(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

/// A noise made of square cells, between -1 and 1.
pub(super) trait CellNoise: Sized {
    /// What is random at a corner of the cells.
    type Corner: Copy;
    /// What is the same for all points of a cell.
    type Cell;
    /// The corners that a cell depends on: the first and the last along either axis, from its
    /// south-western one.
    const CORNERS: [i64; 2];

    /// A point in units of the wavelength, in the coordinates in which cells are unit squares.
    /// Both grow with both of the point's.
    #[inline]
    fn skewed(&self, point: [f64; 2]) -> [f64; 2] {
        point
    }

    /// The south-western corner of the cell in `column` and `row`.
    fn corner(&self, column: i64, row: i64) -> Self::Corner;

    /// A cell, from the corners so many columns and rows from its own.
    fn cell(&self, corner: impl Fn(i64, i64) -> Self::Corner) -> Self::Cell;

    /// The noise at a place in a cell, 0 to 1 along either skewed axis.
    fn value(&self, cell: &Self::Cell, place: [f64; 2]) -> f64;

    /// The noise at one point: the readable reference of [`CellNoise::fill`].
    #[cfg(test)]
    fn at(&self, point: [f64; 2]) -> f64 {
        let [u, v] = self.skewed(point);
        let [column, row] = [u.floor(), v.floor()];
        self.value(&self.cell_at([column, row]), [u - column, v - row])
    }

    /// The cell whose south-western corner is given.
    fn cell_at(&self, [column, row]: [f64; 2]) -> Self::Cell {
        self.cell(|east, north| self.corner(column as i64 + east, row as i64 + north))
    }

    /// The noise at many points: with the same bits, and fast where they are close together.
    fn fill(&self, points: &[[f64; 2]], values: &mut [f64]) {
        match Patch::over(self, points) {
            Some(patch) => patch.fill(points, values),
            None => self.fill_in_turn(points, values),
        }
    }

    /// The noise at points that may be far from each other, such as those of a row. Neighbours
    /// mostly share a cell, which is made once.
    fn fill_in_turn(&self, points: &[[f64; 2]], values: &mut [f64]) {
        let mut known = [f64::NAN; 2];
        let mut cell = None;
        for (value, &point) in values.iter_mut().zip(points) {
            let [u, v] = self.skewed(point);
            let corner = [u.floor(), v.floor()];
            if corner != known {
                known = corner;
                cell = None;
            }
            let cell = cell.get_or_insert_with(|| self.cell_at(corner));
            *value = self.value(cell, [u - corner[0], v - corner[1]]);
        }
    }
}
