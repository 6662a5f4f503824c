//! How much of a terrain lies in depressions.

use serde::Serialize;

use super::fill_depressions;
use crate::grid::{Grid, GridError};

/// The depressions of a terrain: what [`fill_depressions`] raises.
///
/// Water moves between 8 neighbours and leaves at the edge of the grid and beside no-data; cells
/// that touch along a side or a corner belong to one depression, so that nested depressions
/// count once. Heights are taken as they are: integers make fewer, larger steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Depressions {
    /// Number of 8-connected patches of raised cells.
    pub count: usize,
    /// Raised cells as a share of the cells with data, in per cent; 0 if there are none.
    pub area_percent: f64,
    /// Volume of water that fills them, in cubic metres.
    pub volume: f64,
    /// Depth of the deepest cell below the level of its lake, in metres.
    pub deepest: f64,
}

impl Depressions {
    /// Fills a terrain and measures what was raised.
    ///
    /// # Errors
    /// See [`GridError`].
    pub fn new(grid: &Grid, heights: &[f64]) -> Result<Self, GridError> {
        Self::between(grid, heights, &fill_depressions(grid, heights)?)
    }

    /// Measures the depressions of `heights` whose filled surface is known.
    ///
    /// # Errors
    /// See [`GridError`].
    pub fn between(grid: &Grid, heights: &[f64], filled: &[f64]) -> Result<Self, GridError> {
        grid.check(heights)?;
        grid.check(filled)?;
        let mut raised = vec![false; heights.len()];
        let [mut depth_sum, mut deepest, mut cells, mut with_data] = [0.0_f64, 0.0, 0.0, 0.0];
        for (cell, (height, level)) in heights.iter().zip(filled).enumerate() {
            with_data += f64::from(u8::from(!height.is_nan()));
            if level > height {
                raised[cell] = true;
                cells += 1.0;
                depth_sum += level - height;
                deepest = deepest.max(level - height);
            }
        }
        Ok(Self {
            count: patches(grid, raised),
            area_percent: if with_data > 0.0 { 100.0 * cells / with_data } else { 0.0 },
            volume: depth_sum * grid.cell_area(),
            deepest,
        })
    }
}

/// Number of 8-connected patches of cells that are `inside`.
fn patches(grid: &Grid, mut inside: Vec<bool>) -> usize {
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..inside.len() {
        if !std::mem::take(&mut inside[start]) {
            continue;
        }
        count += 1;
        stack.push(start);
        while let Some(cell) = stack.pop() {
            for (_, next) in grid.neighbours(cell) {
                if std::mem::take(&mut inside[next]) {
                    stack.push(next);
                }
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two pits that touch at a corner are one patch; a third lies apart.
    #[test]
    fn two_lakes_are_measured() {
        let grid = Grid::new([7, 5], [2.0, 3.0]).unwrap();
        let mut heights = vec![10.0; 35];
        heights[8] = 4.0;
        heights[16] = 7.0;
        heights[26] = 9.0;
        heights[34] = f64::NAN;
        let measured = Depressions::new(&grid, &heights).unwrap();
        // The third lies beside the gap and is drained by it.
        let area_percent = 100.0 * 2.0 / 34.0;
        let expected = Depressions { count: 1, area_percent, volume: 9.0 * 6.0, deepest: 6.0 };
        assert_eq!(measured, expected);
        heights[34] = 10.0;
        assert_eq!(Depressions::new(&grid, &heights).unwrap().count, 2);
    }

    #[test]
    fn a_plane_and_a_terrain_without_data_have_none() {
        let grid = Grid::new([6, 6], [1.0; 2]).unwrap();
        let plane: Vec<f64> = (0..36).map(f64::from).collect();
        for heights in [plane, vec![f64::NAN; 36]] {
            assert_eq!(Depressions::new(&grid, &heights).unwrap(), Depressions::default());
        }
    }
}
