//! Filling of depressions by a priority flood.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::framed::Framed;
use crate::grid::{Grid, GridError};

/// Raises every cell to the lowest level at which water leaves it: the surface of all lakes when
/// they are full.
///
/// Water moves between the 8 neighbours and leaves at outlets: cells on the edge of the grid and
/// beside no-data. The level of a cell is the least, over all paths to an outlet, of the highest
/// cell on the path. Cells without data (NaN) stay.
///
/// # Algorithm
/// Priority flood (Barnes, Lehman and Mulla 2014): the flood enters at the outlets and takes cells
/// from the lowest level upwards. Cells that the flood climbs to are done at once and need no
/// heap (the idea of Zhou, Sun and Fu 2016); only those wait on it that it may spill over, as a
/// lower cell beside them is still dry when the climb has ended. The level is unique, so neither
/// ties nor the order of visits can change a bit. Cost: constant a cell, and n log n for the n
/// cells on the heap, mostly those on divides.
///
/// # Errors
/// See [`GridError`].
///
/// # Example
/// ```
/// use landform_analysis::grid::Grid;
/// use landform_analysis::hydrology::fill_depressions;
///
/// let grid = Grid::new([3, 3], [1.0; 2])?;
/// let bowl = [9.0, 9.0, 9.0, 9.0, 1.0, 7.0, 9.0, 9.0, 9.0];
/// assert_eq!(fill_depressions(&grid, &bowl)?[4], 7.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fill_depressions(grid: &Grid, heights: &[f64]) -> Result<Vec<f64>, GridError> {
    grid.check(heights)?;
    let mut flood = Flood::new(grid, heights);
    while let Some(Reverse((_, cell))) = flood.spills.pop() {
        flood.spread(cell as usize);
    }
    Ok(flood.levels.into_inner())
}

/// What the flood has reached, and where it goes on. Cells are numbered with the frame.
struct Flood {
    /// Level of the cells that were reached, height of the others.
    levels: Framed,
    /// Steps to the neighbours.
    offsets: [usize; 8],
    /// Whether a cell was reached or has no data.
    reached: Vec<bool>,
    /// Cells that the flood may spill over, lowest first.
    spills: BinaryHeap<Reverse<(u64, u64)>>,
    /// Cells to go on from at once, none below the flood.
    climb: Vec<usize>,
    /// Cells climbed to that had a dry and lower neighbour.
    rims: Vec<usize>,
}

impl Flood {
    fn new(grid: &Grid, heights: &[f64]) -> Self {
        let levels = Framed::new(grid, heights);
        let reached = levels.values.iter().map(|level| level.is_nan()).collect();
        let offsets = levels.offsets();
        let spills = BinaryHeap::new();
        let mut flood =
            Self { levels, offsets, reached, spills, climb: Vec::new(), rims: Vec::new() };
        for cell in 0..heights.len() {
            let cell = flood.levels.index(cell);
            let missing = |offset: usize| flood.levels.values[cell.wrapping_add(offset)].is_nan();
            if !missing(0) && offsets.into_iter().any(missing) {
                flood.reached[cell] = true;
                flood.wait(cell);
            }
        }
        flood
    }

    /// Puts a cell on the heap.
    fn wait(&mut self, cell: usize) {
        self.spills.push(Reverse((order_key(self.levels.values[cell]), cell as u64)));
    }

    /// Spills over a cell, fills what lies behind it and climbs from there as far as it goes.
    fn spread(&mut self, spill: usize) {
        let flood_level = self.levels.values[spill];
        self.climb.push(spill);
        while let Some(cell) = self.climb.pop() {
            if self.climb_from(cell, flood_level) {
                self.rims.push(cell);
            }
        }
        for rim in 0..self.rims.len() {
            let cell = self.rims[rim];
            if self.offsets.iter().any(|&offset| !self.reached[cell.wrapping_add(offset)]) {
                self.wait(cell);
            }
        }
        self.rims.clear();
    }

    /// Reaches the dry neighbours of a cell but for those below it, which are reached and raised
    /// only if the cell is at the level of the flood. Returns whether any were left dry.
    #[inline]
    fn climb_from(&mut self, cell: usize, flood_level: f64) -> bool {
        let level = self.levels.values[cell];
        let mut left = false;
        for offset in self.offsets {
            let neighbour = cell.wrapping_add(offset);
            if self.reached[neighbour] {
                continue;
            }
            if self.levels.values[neighbour] < level {
                if level > flood_level {
                    left = true;
                    continue;
                }
                self.levels.values[neighbour] = level;
            }
            self.reached[neighbour] = true;
            self.climb.push(neighbour);
        }
        left
    }
}

/// Integers in the order of the numbers that they stand for; both zeros are one number.
fn order_key(height: f64) -> u64 {
    let bits = (height + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// The plain priority flood: every cell goes over the heap. What [`fill_depressions`] is tested
/// against.
#[cfg(test)]
pub(crate) fn fill_by_heap_alone(grid: &Grid, heights: &[f64]) -> Vec<f64> {
    let outlet = |cell: usize| {
        grid.is_edge(cell) || grid.neighbours(cell).any(|(_, next)| heights[next].is_nan())
    };
    let mut levels = vec![f64::NAN; heights.len()];
    let mut heap = BinaryHeap::new();
    for cell in (0..heights.len()).filter(|&cell| !heights[cell].is_nan() && outlet(cell)) {
        levels[cell] = heights[cell];
        heap.push(Reverse((order_key(heights[cell]), cell)));
    }
    while let Some(Reverse((_, cell))) = heap.pop() {
        for (_, next) in grid.neighbours(cell) {
            if levels[next].is_nan() && !heights[next].is_nan() {
                levels[next] = heights[next].max(levels[cell]);
                heap.push(Reverse((order_key(levels[next]), next)));
            }
        }
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hydrology::testing::{bits, terrains};

    #[test]
    fn the_fast_flood_gives_the_bits_of_the_plain_one() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            assert_eq!(bits(&filled), bits(&fill_by_heap_alone(&grid, &heights)), "{grid:?}");
        }
    }

    #[test]
    fn filling_twice_changes_nothing() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            assert_eq!(bits(&filled), bits(&fill_depressions(&grid, &filled).unwrap()));
        }
    }

    /// A lake beside a gap in the data drains into the gap.
    #[test]
    fn no_data_is_an_outlet() {
        let grid = Grid::new([5, 5], [1.0; 2]).unwrap();
        let mut heights = vec![9.0; 25];
        heights[12] = 1.0;
        assert_eq!(fill_depressions(&grid, &heights).unwrap()[12], 9.0);
        heights[6] = f64::NAN;
        assert_eq!(fill_depressions(&grid, &heights).unwrap()[12], 1.0);
    }

    #[test]
    fn keys_have_the_order_of_numbers() {
        let numbers = [-1e99, -2.0, -1e-300, 0.0, 1e-300, 1.5, 2.0, 1e99];
        let keys = numbers.map(order_key);
        assert!(keys.is_sorted_by(|low, high| low < high));
        assert_eq!(order_key(-0.0), order_key(0.0));
    }
}
