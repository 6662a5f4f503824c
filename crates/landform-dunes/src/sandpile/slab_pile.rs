//! Duran's pile of sliding slabs, in one dimension.

use landform_sim::random::RandomStream;

use super::{SandpileError, check_heights};

/// A pile of slabs in which a moving slab drags along those underneath (Duran 2000, as told in
/// section 2.2 of the thesis; the local limited model of Kadanoff, Nagel, Wu and Zhou 1989).
///
/// Slabs are added anywhere between a wall on the left and an open end on the right. Where a
/// column stands higher above the next than the critical fall, `slabs_together` slabs move on to
/// it. A slab dropped at random is (columns + 1) / 2 moves from the open end on average, so the
/// mean number of slides a slab is exactly that over `slabs_together`.
///
/// One slab at a time is trivial: avalanches of all sizes up to the number of columns are as
/// likely. Two together make the pile critical: this is why the moving slab has to drag.
#[derive(Clone, Debug)]
pub struct SlabPile {
    slabs_together: i32,
    critical_fall: i32,
    /// Fall from each column to the next.
    slopes: Vec<i32>,
    unstable: Vec<u32>,
    added: u64,
    fallen: u64,
}

impl SlabPile {
    /// An empty pile of `columns` columns where `slabs_together` slabs slide when a column is
    /// more than `slabs_together` slabs above the next.
    ///
    /// # Errors
    /// [`SandpileError`] without columns or with more than 2^28, and if `slabs_together` is not
    /// from 1 to 1000.
    pub fn new(columns: usize, slabs_together: u32) -> Result<Self, SandpileError> {
        if columns > 1 << 28 {
            return Err(SandpileError::Size { columns, rows: 1 });
        }
        Self::standing(&vec![0; columns], slabs_together)
    }

    /// The same with as many slabs in the columns as `heights` says. What is too steep slides when the
    /// next slab is added.
    ///
    /// # Errors
    /// As [`SlabPile::new`], and for columns of more than a million slabs.
    pub fn standing(heights: &[u32], slabs_together: u32) -> Result<Self, SandpileError> {
        let columns = heights.len();
        if columns == 0 || columns > 1 << 28 {
            return Err(SandpileError::Size { columns, rows: 1 });
        }
        if !(1..=1000).contains(&slabs_together) {
            return Err(SandpileError::Parameter {
                parameter: "slabs_together",
                value: f64::from(slabs_together),
                expected: "from 1 to 1000",
            });
        }
        check_heights(heights)?;
        let next = heights.iter().skip(1).chain([&0]);
        let mut pile = Self {
            slabs_together: slabs_together as i32,
            critical_fall: slabs_together as i32,
            slopes: heights
                .iter()
                .zip(next)
                .map(|(here, next)| *here as i32 - *next as i32)
                .collect(),
            unstable: Vec::new(),
            added: 0,
            fallen: 0,
        };
        (0..columns).for_each(|column| pile.list_if_unstable(column));
        Ok(pile)
    }

    /// Mean number of slides a slab in the critical state, exactly: `(columns + 1) / 2` moves of
    /// `slabs_together` slabs.
    pub fn mean_slides(columns: usize, slabs_together: u32) -> f64 {
        (columns as f64 + 1.0) / 2.0 / f64::from(slabs_together)
    }

    /// Adds a slab on a column, lets the pile relax and returns the number of slides.
    ///
    /// # Panics
    /// If the pile has no such column.
    pub fn add(&mut self, column: usize) -> u64 {
        self.added += 1;
        self.slopes[column] += 1;
        if column > 0 {
            self.slopes[column - 1] -= 1;
        }
        self.list_if_unstable(column);
        let mut slides = 0;
        while let Some(column) = self.unstable.pop() {
            let column = column as usize;
            while self.slopes[column] > self.critical_fall {
                self.slide(column);
                slides += 1;
            }
            if column > 0 {
                self.list_if_unstable(column - 1);
            }
            if column + 1 < self.slopes.len() {
                self.list_if_unstable(column + 1);
            }
        }
        slides
    }

    /// Adds a slab on a random column; `number` counts the slabs of the run, and piles that differ in
    /// `row` draw columns of their own.
    pub fn add_at_random(&mut self, stream: &RandomStream, number: u64, row: usize) -> u64 {
        let word = stream.block(number, row, 0)[0];
        self.add(((u64::from(word) * self.slopes.len() as u64) >> 32) as usize)
    }

    fn slide(&mut self, column: usize) {
        let slabs = self.slabs_together;
        self.slopes[column] -= slabs;
        if column > 0 {
            self.slopes[column - 1] += slabs;
        }
        match self.slopes.get_mut(column + 1) {
            Some(next) => {
                *next += slabs;
                self.slopes[column] -= slabs;
            }
            None => self.fallen += slabs as u64,
        }
    }

    fn list_if_unstable(&mut self, column: usize) {
        if self.slopes[column] > self.critical_fall {
            self.unstable.push(column as u32);
        }
    }

    /// Number of slabs in each column.
    pub fn heights(&self) -> Vec<i64> {
        let mut heights: Vec<i64> = Vec::with_capacity(self.slopes.len());
        let mut height = 0;
        for &slope in self.slopes.iter().rev() {
            height += i64::from(slope);
            heights.push(height);
        }
        heights.reverse();
        heights
    }

    /// Slabs added and slabs fallen off the open end.
    pub fn ledger(&self) -> [u64; 2] {
        [self.added, self.fallen]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn add_by_definition(heights: &mut [i64], column: usize, slabs: i64) -> u64 {
        heights[column] += 1;
        let mut slides = 0;
        loop {
            let next = |column: usize| heights.get(column + 1).copied().unwrap_or(0);
            let unstable = (0..heights.len()).find(|&i| heights[i] - next(i) > slabs);
            let Some(column) = unstable else { return slides };
            heights[column] -= slabs;
            slides += 1;
            if column + 1 < heights.len() {
                heights[column + 1] += slabs;
            }
        }
    }

    #[test]
    fn slopes_agree_with_heights_in_another_order() {
        let stream = RandomStream::new(4, "slabs");
        for slabs in 1..4 {
            let mut pile = SlabPile::new(11, slabs).unwrap();
            let mut heights = vec![0; 11];
            for number in 0..800 {
                let column = stream.block(number, 0, 0)[0] as usize % 11;
                let slides = add_by_definition(&mut heights, column, i64::from(slabs));
                assert_eq!(pile.add(column), slides, "{slabs} together, slab {number}");
                assert_eq!(pile.heights(), heights);
            }
            let [added, fallen] = pile.ledger();
            assert_eq!(added, fallen + heights.iter().sum::<i64>() as u64);
            assert!(fallen > 0 && heights.iter().all(|&height| height >= 0));
        }
    }

    /// Slides caused by slabs that are added once the pile is critical.
    fn slides(columns: usize, together: u32, slabs: u64) -> Vec<u64> {
        let stream = RandomStream::new(2, "slabs");
        let mut pile = SlabPile::new(columns, together).unwrap();
        let transient = 8 * (columns * columns) as u64 * u64::from(together);
        (0..transient).for_each(|number| {
            pile.add_at_random(&stream, number, 0);
        });
        (0..slabs).map(|number| pile.add_at_random(&stream, transient + number, 0)).collect()
    }

    #[test]
    fn mean_slides_are_half_the_pile_over_the_slabs_together() {
        for together in [1, 2, 3] {
            let sizes = slides(63, together, 400_000);
            let mean = sizes.iter().sum::<u64>() as f64 / sizes.len() as f64;
            let expected = SlabPile::mean_slides(63, together);
            assert_eq!(expected * f64::from(together), 32.0);
            assert!((mean / expected - 1.0).abs() < 0.01, "{together}: {mean}");
        }
    }

    /// The point of section 2.2 of the thesis.
    #[test]
    fn only_dragged_slabs_make_avalanches_beyond_the_pile() {
        let columns = 63;
        let alone = slides(columns, 1, 100_000);
        assert_eq!(alone.iter().copied().max(), Some(columns as u64));
        let quarter = |sizes: &[u64], from: u64| {
            sizes.iter().filter(|&&size| (from..from + 16).contains(&size)).count() as f64
        };
        assert!((quarter(&alone, 1) / quarter(&alone, 48) - 1.0).abs() < 0.05, "all as likely");
        let dragged = slides(columns, 2, 100_000);
        assert!(dragged.iter().copied().max() > Some(10 * columns as u64));
        assert!(quarter(&dragged, 1) > 5.0 * quarter(&dragged, 48));
    }

    #[test]
    fn a_pile_that_was_put_down_goes_on() {
        let mut pile = SlabPile::new(20, 2).unwrap();
        assert!((0..900).map(|number| pile.add(number % 20)).sum::<u64>() > 900);
        let heights: Vec<u32> = pile.heights().iter().map(|&height| height as u32).collect();
        let mut again = SlabPile::standing(&heights, 2).unwrap();
        let slides = |pile: &mut SlabPile| (0..200).map(|n| pile.add(n % 20)).collect::<Vec<_>>();
        assert_eq!(slides(&mut again), slides(&mut pile));
        let mut wall = SlabPile::standing(&[40, 0, 0, 0], 2).unwrap();
        assert!(wall.add(3) > 20, "a wall slides down");
        assert_eq!(wall.heights().iter().sum::<i64>() + wall.ledger()[1] as i64, 41);
    }

    #[test]
    fn impossible_piles_are_refused() {
        assert!(SlabPile::new(0, 2).is_err());
        assert!(SlabPile::new(5, 0).is_err());
        assert!(SlabPile::new(5, u32::MAX).is_err());
        assert!(SlabPile::standing(&[0, 1_000_001], 2).is_err());
    }
}
