//! The Oslo model: a rice pile in one dimension.

use landform_sim::random::RandomStream;

use super::{SandpileError, check_heights};

/// The Oslo model (Christensen, Corral, Frette, Feder and Jossang 1996).
///
/// Grains are added at the wall on the left. Where the pile is steeper than a threshold of 1 or
/// 2, its top grain moves one column to the right, or off the pile at the open end, and the
/// threshold of the column is drawn again. Every grain makes as many moves as there are
/// columns, so the mean avalanche in the critical state is exactly that size.
///
/// Thresholds depend on the column and on how often it toppled, not on the order of moves, so
/// the state after a grain does not either.
#[derive(Clone, Debug)]
pub struct OsloPile {
    stream: RandomStream,
    /// Number of the pile among those of a stream.
    row: u32,
    /// Fall from each column to the next.
    slopes: Vec<i32>,
    /// Whether the threshold of each column is 2 and not 1.
    high: Vec<bool>,
    topplings: Vec<u64>,
    unstable: Vec<u32>,
    added: u64,
    fallen: u64,
}

impl OsloPile {
    /// An empty pile of `columns` columns.
    ///
    /// # Errors
    /// [`SandpileError::Size`] without columns or with more than 2^28.
    pub fn new(columns: usize, seed: u64) -> Result<Self, SandpileError> {
        if columns > 1 << 28 {
            return Err(SandpileError::Size { columns, rows: 1 });
        }
        Self::standing(&vec![0; columns], &vec![0; columns], 0, seed)
    }

    /// A pile with as many grains in its columns as `heights` says, each of which has toppled as often as
    /// `topplings` says. Piles of one seed that differ in `row` have thresholds of their own. What is too
    /// steep moves when the next grain is added.
    ///
    /// # Errors
    /// [`SandpileError`] without columns, with more than 2^28, where the two differ in length, and for
    /// columns of more than a million grains.
    pub fn standing(
        heights: &[u32],
        topplings: &[u32],
        row: u32,
        seed: u64,
    ) -> Result<Self, SandpileError> {
        let columns = heights.len();
        if columns == 0 || columns > 1 << 28 || topplings.len() != columns {
            return Err(SandpileError::Size { columns, rows: 1 });
        }
        check_heights(heights)?;
        let stream = RandomStream::new(seed, "oslo thresholds");
        let next = heights.iter().skip(1).chain([&0]);
        let high = |(column, &count): (usize, &u32)| {
            threshold_is_high(&stream, [column, row as usize], u64::from(count))
        };
        let mut pile = Self {
            high: topplings.iter().enumerate().map(high).collect(),
            slopes: heights
                .iter()
                .zip(next)
                .map(|(here, next)| *here as i32 - *next as i32)
                .collect(),
            topplings: topplings.iter().map(|&count| u64::from(count)).collect(),
            stream,
            row,
            unstable: Vec::new(),
            added: 0,
            fallen: 0,
        };
        (0..columns).for_each(|column| pile.list_if_unstable(column));
        Ok(pile)
    }

    /// Adds a grain at the wall, lets the pile relax and returns the number of moves.
    pub fn add(&mut self) -> u64 {
        self.added += 1;
        self.slopes[0] += 1;
        self.list_if_unstable(0);
        let mut moves = 0;
        while let Some(column) = self.unstable.pop() {
            let column = column as usize;
            while self.is_unstable(column) {
                self.topple(column);
                moves += 1;
            }
            if column > 0 {
                self.list_if_unstable(column - 1);
            }
            if column + 1 < self.slopes.len() {
                self.list_if_unstable(column + 1);
            }
        }
        moves
    }

    fn topple(&mut self, column: usize) {
        self.slopes[column] -= 1;
        if column > 0 {
            self.slopes[column - 1] += 1;
        }
        match self.slopes.get_mut(column + 1) {
            Some(next) => {
                *next += 1;
                self.slopes[column] -= 1;
            }
            None => self.fallen += 1,
        }
        self.topplings[column] += 1;
        let place = [column, self.row as usize];
        self.high[column] = threshold_is_high(&self.stream, place, self.topplings[column]);
    }

    fn is_unstable(&self, column: usize) -> bool {
        self.slopes[column] > 1 + i32::from(self.high[column])
    }

    fn list_if_unstable(&mut self, column: usize) {
        if self.is_unstable(column) {
            self.unstable.push(column as u32);
        }
    }

    /// Number of grains in each column.
    pub fn heights(&self) -> Vec<u64> {
        let mut heights: Vec<u64> = Vec::with_capacity(self.slopes.len());
        let mut height = 0_i64;
        for &slope in self.slopes.iter().rev() {
            height += i64::from(slope);
            heights.push(height as u64);
        }
        heights.reverse();
        heights
    }

    /// How often each column has toppled.
    pub fn topplings(&self) -> &[u64] {
        &self.topplings
    }

    /// Grains added and grains fallen off the open end.
    pub fn ledger(&self) -> [u64; 2] {
        [self.added, self.fallen]
    }
}

/// Threshold of a column of a row after it toppled `topplings` times: one bit of a random block that
/// serves for 128 topplings.
fn threshold_is_high(stream: &RandomStream, [column, row]: [usize; 2], topplings: u64) -> bool {
    let words = stream.block(topplings / 128, column, row as u32);
    let bit = topplings % 128;
    words[(bit / 32) as usize] >> (bit % 32) & 1 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boundary slope rule checked on heights, straight from the definition.
    fn add_by_definition(heights: &mut [u64], topplings: &mut [u64], stream: &RandomStream) -> u64 {
        heights[0] += 1;
        let mut moves = 0;
        loop {
            let unstable = (0..heights.len()).rev().find(|&column| {
                let next = heights.get(column + 1).copied().unwrap_or(0);
                let high = threshold_is_high(stream, [column, 0], topplings[column]);
                heights[column] > next + 1 + u64::from(high)
            });
            let Some(column) = unstable else { return moves };
            heights[column] -= 1;
            topplings[column] += 1;
            moves += 1;
            if column + 1 < heights.len() {
                heights[column + 1] += 1;
            }
        }
    }

    #[test]
    fn slopes_agree_with_heights_in_another_order() {
        let mut pile = OsloPile::new(12, 3).unwrap();
        let [mut heights, mut topplings] = [vec![0; 12], vec![0; 12]];
        for grain in 0..600 {
            let moves = add_by_definition(&mut heights, &mut topplings, &pile.stream);
            assert_eq!(pile.add(), moves, "grain {grain}");
            assert_eq!(pile.heights(), heights, "grain {grain}");
        }
        let [added, fallen] = pile.ledger();
        assert_eq!(added, fallen + heights.iter().sum::<u64>());
        assert!(fallen > 0);
    }

    #[test]
    fn the_mean_avalanche_is_the_size_of_the_pile() {
        for columns in [16, 64] {
            let mut pile = OsloPile::new(columns, 1).unwrap();
            // The pile is critical once it leans at its mean slope, about 1.7.
            let transient = 4 * columns * columns;
            (0..transient).for_each(|_| {
                pile.add();
            });
            let grains = 100_000;
            let mean = (0..grains).map(|_| pile.add()).sum::<u64>() as f64 / f64::from(grains);
            assert!((mean / columns as f64 - 1.0).abs() < 0.005, "{columns}: {mean}");
        }
    }

    #[test]
    fn a_pile_that_was_put_down_goes_on() {
        let mut pile = OsloPile::new(20, 3).unwrap();
        assert!((0..500).map(|_| pile.add()).sum::<u64>() > 500);
        let heights: Vec<u32> = pile.heights().iter().map(|&height| height as u32).collect();
        let topplings: Vec<u32> = pile.topplings().iter().map(|&count| count as u32).collect();
        let mut again = OsloPile::standing(&heights, &topplings, 0, 3).unwrap();
        let mut other = OsloPile::standing(&heights, &topplings, 1, 3).unwrap();
        let moves = |pile: &mut OsloPile| (0..200).map(|_| pile.add()).collect::<Vec<_>>();
        let expected = moves(&mut pile);
        assert_eq!(moves(&mut again), expected);
        assert_ne!(moves(&mut other), expected, "another row");
        // A wall of grains slides down, and none is lost.
        let mut wall = OsloPile::standing(&[40, 0, 0, 0], &[0; 4], 0, 1).unwrap();
        assert!(wall.add() > 40);
        assert_eq!(wall.heights().iter().sum::<u64>() + wall.ledger()[1], 41);
    }

    #[test]
    fn impossible_piles_are_refused() {
        assert!(OsloPile::new(0, 1).is_err());
        assert!(OsloPile::new(usize::MAX, 1).is_err());
        assert!(OsloPile::standing(&[1, 2], &[0], 0, 1).is_err());
        assert!(OsloPile::standing(&[u32::MAX], &[0], 0, 1).is_err());
    }
}
