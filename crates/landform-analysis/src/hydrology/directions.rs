//! Single flow directions (D8) and what accumulates along them.

use rayon::prelude::*;

use super::flats::drain_flats;
use crate::framed::Framed;
use crate::grid::{Grid, GridError};

/// No neighbour is lower and water cannot leave: a pit, or a flat that is not drained.
pub(super) const PIT: u8 = 8;
/// Water leaves the grid here.
pub(super) const LEAVES: u8 = 9;
/// The cell has no data.
const NO_DATA: u8 = 10;

/// For every cell the one neighbour that its water flows to: the D8 algorithm (O'Callaghan and
/// Mark 1984).
///
/// That is the neighbour with the steepest descent, drop over distance; of several, the first in
/// the order E, N, W, S, NE, NW, SW, SE, in which directions are numbered from 0. An outlet
/// without a lower neighbour loses its water over the edge.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowDirections {
    grid: Grid,
    /// Number of the step to the receiver, or one of [`PIT`], [`LEAVES`] and [`NO_DATA`].
    codes: Vec<u8>,
}

impl FlowDirections {
    /// Directions of steepest descent. Pits and flats keep their water.
    ///
    /// # Errors
    /// See [`GridError`].
    pub fn steepest(grid: &Grid, heights: &[f64]) -> Result<Self, GridError> {
        grid.check(heights)?;
        Ok(Self::of(grid, &Framed::new(grid, heights)))
    }

    /// Directions on a surface without depressions, as [`fill_depressions`] makes it: steepest
    /// descent, and over flats and lakes the way with the fewest steps to where water leaves
    /// them. Every path ends at an outlet.
    ///
    /// On a surface with depressions their pits keep their water. In wide lakes the shortest ways
    /// run side by side, which is no picture of a river.
    ///
    /// [`fill_depressions`]: super::fill_depressions
    ///
    /// # Errors
    /// See [`GridError`].
    pub fn over_filled(grid: &Grid, filled: &[f64]) -> Result<Self, GridError> {
        grid.check(filled)?;
        let mut directions = Self::of(grid, &Framed::new(grid, filled));
        drain_flats(grid, filled, &mut directions.codes);
        Ok(directions)
    }

    fn of(grid: &Grid, heights: &Framed) -> Self {
        let mut codes = vec![PIT; grid.cell_count()];
        let inverse = grid.step_lengths().map(f64::recip);
        codes.par_chunks_exact_mut(grid.columns()).enumerate().for_each(|(row, codes)| {
            steepest_of_row(heights.window(row), inverse, codes);
        });
        Self { grid: *grid, codes }
    }

    /// Directions that a test makes up: the number of a step, or 8 for a pit. Steps over the edge
    /// lose their water.
    #[cfg(test)]
    pub(crate) fn from_steps(grid: &Grid, step: impl Fn(usize) -> u8) -> Self {
        let inside = |cell: usize, code: u8| {
            grid.neighbours(cell).any(|(direction, _)| direction == usize::from(code))
        };
        let code = |cell: usize| match step(cell) {
            code if code < PIT && !inside(cell, code) => LEAVES,
            code => code,
        };
        Self { grid: *grid, codes: (0..grid.cell_count()).map(code).collect() }
    }

    /// The grid that the directions belong to.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Number of the direction in which water leaves a cell for a neighbour: see
    /// [`FlowDirections`] for the order.
    pub fn direction(&self, cell: usize) -> Option<u8> {
        let code = self.codes[cell];
        (code < PIT).then_some(code)
    }

    /// Whether the water of a cell leaves the grid there.
    pub fn leaves(&self, cell: usize) -> bool {
        self.codes[cell] == LEAVES
    }

    /// Whether a cell has data.
    pub fn has_data(&self, cell: usize) -> bool {
        self.codes[cell] != NO_DATA
    }

    /// The neighbour that receives the water of a cell; `None` for pits, where water leaves the
    /// grid and where there are no data.
    pub fn receiver(&self, cell: usize) -> Option<usize> {
        let offset = *self.grid.step_offsets().get(usize::from(self.codes[cell]))?;
        Some(cell.wrapping_add_signed(offset))
    }

    /// Visits every cell with data after all cells whose water it receives, in an order that is
    /// always the same: `visit(cell, direction, receiver)`; the last two are `None` where the
    /// path of the water ends.
    pub fn visit_downstream(&self, mut visit: impl FnMut(usize, Option<u8>, Option<usize>)) {
        const VISITED: u8 = u8::MAX;
        let offsets = self.grid.step_offsets();
        let receiver = |cell: usize| {
            let offset = offsets.get(usize::from(self.codes[cell]))?;
            Some(cell.wrapping_add_signed(*offset))
        };
        let mut donors = vec![0_u8; self.codes.len()];
        for cell in 0..self.codes.len() {
            if let Some(next) = receiver(cell) {
                donors[next] += 1;
            }
        }
        for source in 0..self.codes.len() {
            let mut cell = source;
            while donors[cell] == 0 {
                donors[cell] = VISITED;
                let next = receiver(cell);
                if self.codes[cell] != NO_DATA {
                    visit(cell, next.map(|_| self.codes[cell]), next);
                }
                let Some(next) = next else { break };
                donors[next] -= 1;
                cell = next;
            }
        }
    }

    /// Number of cells whose water passes each cell, itself included; 0 where there are no data.
    /// Times [`Grid::cell_area`] it is the contributing area.
    pub fn contributing_cells(&self) -> Vec<u32> {
        let mut cells: Vec<u32> =
            self.codes.iter().map(|&code| u32::from(code != NO_DATA)).collect();
        self.visit_downstream(|cell, _, receiver| {
            if let Some(receiver) = receiver {
                cells[receiver] += cells[cell];
            }
        });
        cells
    }
}

/// Directions of a row of cells, from it and the rows to its north and south with their frames.
fn steepest_of_row(rows: [&[f64]; 3], inverse: [f64; 8], codes: &mut [u8]) {
    let rows = rows.map(|row| &row[..codes.len() + 2]);
    for (x, code) in codes.iter_mut().enumerate() {
        let height = rows[1][x + 1];
        let around = Framed::around(rows, x);
        let mut steepest = 0.0;
        let mut direction = PIT;
        for (step, (next, inverse)) in around.iter().zip(inverse).enumerate() {
            let slope = (height - next) * inverse;
            if slope > steepest {
                steepest = slope;
                direction = step as u8;
            }
        }
        if direction == PIT {
            direction = ending(height, &around);
        }
        *code = direction;
    }
}

/// Why water does not flow on from a cell to a neighbour.
#[cold]
fn ending(height: f64, around: &[f64; 8]) -> u8 {
    match height.is_nan() {
        true => NO_DATA,
        false if around.iter().any(|height| height.is_nan()) => LEAVES,
        false => PIT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hydrology::fill_depressions;
    use crate::hydrology::testing::terrains;

    /// The definition, cell by cell.
    fn steepest_by_definition(grid: &Grid, heights: &[f64], cell: usize) -> Option<u8> {
        let lengths = grid.step_lengths();
        let mut best = (0.0, None);
        for (direction, next) in grid.neighbours(cell) {
            let slope = (heights[cell] - heights[next]) * lengths[direction].recip();
            if slope > best.0 {
                best = (slope, Some(direction as u8));
            }
        }
        best.1
    }

    #[test]
    fn rows_give_the_directions_of_the_definition() {
        for (grid, heights) in terrains() {
            let directions = FlowDirections::steepest(&grid, &heights).unwrap();
            for cell in 0..heights.len() {
                let expected = steepest_by_definition(&grid, &heights, cell);
                assert_eq!(directions.direction(cell), expected, "{grid:?} cell {cell}");
                assert_eq!(directions.has_data(cell), !heights[cell].is_nan());
            }
        }
    }

    /// The number of cells above a cell, found by following every cell downstream.
    #[test]
    fn areas_are_those_of_all_paths_followed() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
            let mut passed = vec![0; heights.len()];
            for start in (0..heights.len()).filter(|&cell| directions.has_data(cell)) {
                let mut cell = start;
                passed[cell] += 1;
                while let Some(next) = directions.receiver(cell) {
                    assert!(filled[next] <= filled[cell]);
                    cell = next;
                    passed[cell] += 1;
                    assert!(passed[cell] <= heights.len() as u32, "a path runs in a circle");
                }
                assert!(directions.leaves(cell), "a path ends inside at {cell} of {grid:?}");
            }
            assert_eq!(directions.contributing_cells(), passed);
        }
    }

    #[test]
    fn all_water_of_a_filled_terrain_leaves_it() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
            let cells = directions.contributing_cells();
            let left: u32 =
                (0..cells.len()).filter(|&cell| directions.leaves(cell)).map(|c| cells[c]).sum();
            let rained = heights.iter().filter(|height| !height.is_nan()).count();
            assert_eq!(left as usize, rained);
        }
    }
}
