//! The models on plain arrays, as fast as a person would write them without much thought.

use crate::model::{Model, Timed, timed};

/// Runs the model for so many steps.
pub fn run(model: Model, start: &[u8], side: usize, steps: usize) -> Timed {
    let mut cells = start.to_vec();
    let mut next = vec![0; cells.len()];
    let nanoseconds = timed(steps, || {
        match model {
            Model::Life => generation(&cells, &mut next, side),
            Model::Fire => {
                for (node, cell) in next.iter_mut().enumerate() {
                    let place = [node % side, node / side];
                    // Only trees look around.
                    *cell = match cells[node] {
                        1 => {
                            let around = model.around(place, side);
                            model.next(1, around.map(|[x, y]| cells[y * side + x]))
                        }
                        _ => 0,
                    };
                }
            }
        }
        std::mem::swap(&mut cells, &mut next);
    });
    Timed { nanoseconds, cells }
}

/// One generation of the Game of Life, by windows of three rows.
fn generation(cells: &[u8], next: &mut [u8], side: usize) {
    let row = |row: usize| &cells[row % side * side..][..side];
    let mut sums = vec![0; side + 2];
    for (y, next) in next.chunks_exact_mut(side).enumerate() {
        let rows = [row(y + side - 1), row(y), row(y + 1)];
        let columns = rows[0].iter().zip(rows[1]).zip(rows[2]);
        for (sum, ((north, here), south)) in sums[1..].iter_mut().zip(columns) {
            *sum = north + here + south;
        }
        (sums[0], sums[side + 1]) = (sums[side], sums[1]);
        for ((next, &alive), sums) in next.iter_mut().zip(rows[1]).zip(sums.windows(3)) {
            let all: u8 = sums[0] + sums[1] + sums[2];
            *next = u8::from(all == 3) | (u8::from(all == 4) & alive);
        }
    }
}
