//! Drainage of flats and of the surfaces of filled lakes.

use super::directions::{LEAVES, PIT};
use crate::grid::Grid;

/// Gives the cells of flats the direction of the shortest way, in steps at their level, to a
/// cell that is drained. Of several ways the search takes the one that it finds first: from
/// drained cells outwards, in the order of cells and directions.
pub(super) fn drain_flats(grid: &Grid, heights: &[f64], codes: &mut [u8]) {
    // Cells have numbers of 32 bits.
    let mut found: Vec<(u32, u8)> = Vec::new();
    for cell in (0..codes.len()).filter(|&cell| codes[cell] == PIT) {
        let way = grid.neighbours(cell).find(|&(_, next)| {
            heights[next] == heights[cell] && codes[next] <= LEAVES && codes[next] != PIT
        });
        if let Some((direction, _)) = way {
            found.push((cell as u32, direction as u8));
        }
    }
    for &(cell, direction) in &found {
        codes[cell as usize] = direction;
    }
    let mut next_found = 0;
    while let Some(&(cell, _)) = found.get(next_found) {
        next_found += 1;
        let cell = cell as usize;
        for (direction, beside) in grid.neighbours(cell) {
            if codes[beside] == PIT && heights[beside] == heights[cell] {
                codes[beside] = opposite(direction as u8);
                found.push((beside as u32, codes[beside]));
            }
        }
    }
}

/// The direction back: E and W, N and S, NE and SW, NW and SE.
fn opposite(direction: u8) -> u8 {
    direction & 4 | (direction + 2) & 3
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::STEPS;
    use crate::hydrology::testing::terrains;
    use crate::hydrology::{FlowDirections, fill_depressions};

    #[test]
    fn opposite_steps_cancel() {
        for (direction, [x, y]) in STEPS.into_iter().enumerate() {
            assert_eq!(STEPS[usize::from(opposite(direction as u8))], [-x, -y]);
        }
    }

    /// Steps to leave a flat, by sweeps over all cells until nothing changes.
    fn steps_by_sweeps(grid: &Grid, filled: &[f64], directions: &FlowDirections) -> Vec<usize> {
        let drained = |cell| directions.direction(cell).is_some() || directions.leaves(cell);
        let mut steps: Vec<usize> =
            (0..filled.len()).map(|cell| if drained(cell) { 0 } else { usize::MAX }).collect();
        loop {
            let before = steps.clone();
            for (cell, steps) in steps.iter_mut().enumerate() {
                let level = |&(_, next): &(usize, usize)| filled[next] == filled[cell];
                let least = grid.neighbours(cell).filter(level).map(|(_, next)| before[next]).min();
                *steps = (*steps).min(least.unwrap_or(usize::MAX).saturating_add(1));
            }
            if steps == before {
                return steps;
            }
        }
    }

    #[test]
    fn water_leaves_flats_by_the_fewest_steps() {
        for (grid, heights) in terrains() {
            let filled = fill_depressions(&grid, &heights).unwrap();
            let steepest = FlowDirections::steepest(&grid, &filled).unwrap();
            let steps = steps_by_sweeps(&grid, &filled, &steepest);
            let directions = FlowDirections::over_filled(&grid, &filled).unwrap();
            for (cell, &count) in steps.iter().enumerate() {
                match count {
                    0 => assert_eq!(directions.direction(cell), steepest.direction(cell)),
                    _ => {
                        let next = directions.receiver(cell);
                        assert!(next.is_none_or(|next| steps[next] == count - 1));
                    }
                }
            }
        }
    }
}
