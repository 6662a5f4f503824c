//! Approximate inverses of matrices on parts of a grid.

use super::sparse::Matrix;

/// Unknowns below which a grid is not made coarser.
const COARSEST: usize = 64;
/// Double sweeps over the coarsest grid.
const COARSEST_SWEEPS: usize = 8;

/// Where the unknowns of a matrix lie: some of the nodes of a grid.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// Columns and rows of the grid.
    pub size: [usize; 2],
    /// Whether the grid closes on itself along each axis.
    pub periodic: [bool; 2],
    /// Column and row of each unknown.
    pub at: Vec<[u32; 2]>,
}

/// One V cycle of multigrid for a symmetric matrix, as an approximate inverse that is symmetric
/// itself: a preconditioner.
///
/// Unknowns may lie on any part of the grid (Dirichlet values elsewhere). Coarse unknowns stand at
/// every other node of every other row; coarse corrections are interpolated between them with
/// straight lines and cut off where a node is no unknown, and coarse matrices are those of the
/// corrections (truncated multigrid, Kornhuber 1994). Sweeps are those of Gauss and Seidel, one
/// forward on the way down and one backward on the way up.
#[derive(Debug)]
pub(super) struct Multigrid {
    levels: Vec<Level>,
}

/// A grid, from fine to coarse.
#[derive(Debug)]
struct Level {
    matrix: Matrix,
    /// Coarse unknowns, and their shares, that correct each unknown; empty on the coarsest grid.
    parents: Parents,
    x: Vec<f64>,
    right: Vec<f64>,
}

/// Up to four coarse unknowns with their shares for each fine one.
#[derive(Debug, Default)]
struct Parents {
    starts: Vec<usize>,
    entries: Vec<(u32, f64)>,
}

impl Parents {
    fn of(&self, fine: usize) -> &[(u32, f64)] {
        &self.entries[self.starts[fine]..self.starts[fine + 1]]
    }
}

impl Multigrid {
    /// The grids of a matrix whose unknowns lie at `places`.
    pub fn new(matrix: Matrix, places: Places) -> Self {
        let (mut levels, mut matrix, mut places) = (Vec::new(), matrix, places);
        while matrix.len() > COARSEST {
            let (parents, coarse) = coarsen(&places);
            let next = coarse_matrix(&matrix, &parents, coarse.at.len());
            levels.push(Level::new(std::mem::replace(&mut matrix, next), parents));
            places = coarse;
        }
        levels.push(Level::new(matrix, Parents::default()));
        Self { levels }
    }

    /// The matrix itself.
    pub fn matrix(&self) -> &Matrix {
        &self.levels[0].matrix
    }

    /// Writes to `x` an approximate solution for the given right side.
    pub fn solve(&mut self, right: &[f64], x: &mut [f64]) {
        self.levels[0].right.copy_from_slice(right);
        let coarsest = self.levels.len() - 1;
        for depth in 0..coarsest {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let (fine, coarse) = (&mut fine[depth], &mut coarse[0]);
            fine.x.fill(0.0);
            fine.sweep_forward();
            fine.restrict(&mut coarse.right);
        }
        let last = &mut self.levels[coarsest];
        last.x.fill(0.0);
        for _ in 0..COARSEST_SWEEPS {
            last.sweep_forward();
            last.sweep_backward();
        }
        for depth in (0..coarsest).rev() {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            fine[depth].correct(&coarse[0].x);
            fine[depth].sweep_backward();
        }
        x.copy_from_slice(&self.levels[0].x);
    }
}

impl Level {
    fn new(matrix: Matrix, parents: Parents) -> Self {
        let unknowns = matrix.len();
        Self { matrix, parents, x: vec![0.0; unknowns], right: vec![0.0; unknowns] }
    }

    fn sweep_forward(&mut self) {
        for row in 0..self.x.len() {
            self.x[row] += self.matrix.correction(row, &self.x, self.right[row]);
        }
    }

    fn sweep_backward(&mut self) {
        for row in (0..self.x.len()).rev() {
            self.x[row] += self.matrix.correction(row, &self.x, self.right[row]);
        }
    }

    /// Gathers what is left of the right side at the coarse unknowns.
    fn restrict(&self, coarse: &mut [f64]) {
        coarse.fill(0.0);
        for (row, right) in self.right.iter().enumerate() {
            let left = right - self.matrix.dot(row, &self.x);
            self.parents
                .of(row)
                .iter()
                .for_each(|&(at, share)| coarse[at as usize] += share * left);
        }
    }

    fn correct(&mut self, coarse: &[f64]) {
        for (row, x) in self.x.iter_mut().enumerate() {
            let parents = self.parents.of(row).iter();
            *x += parents.map(|&(at, share)| share * coarse[at as usize]).sum::<f64>();
        }
    }
}

/// The next coarser grid, and how it corrects the finer one. Coarse nodes that correct nothing are
/// left out.
fn coarsen(places: &Places) -> (Parents, Places) {
    let size = places.size.map(|count| count.div_ceil(2));
    let mut number = vec![u32::MAX; size[0] * size[1]];
    let mut coarse = Places { size, periodic: places.periodic, at: Vec::new() };
    let mut parents = Parents { starts: vec![0], entries: Vec::new() };
    for &[x, y] in &places.at {
        let [across, down] = [(x, 0), (y, 1)].map(|(at, axis)| {
            between(at, places.size[axis] as u32, size[axis] as u32, places.periodic[axis])
        });
        for &(y, share_y) in down.iter().filter(|(_, share)| *share > 0.0) {
            for &(x, share_x) in across.iter().filter(|(_, share)| *share > 0.0) {
                let node = &mut number[x as usize + size[0] * y as usize];
                if *node == u32::MAX {
                    *node = coarse.at.len() as u32;
                    coarse.at.push([x, y]);
                }
                parents.entries.push((*node, share_x * share_y));
            }
        }
        parents.starts.push(parents.entries.len());
    }
    (parents, coarse)
}

/// The two coarse nodes beside a fine one along an axis, with their shares.
fn between(at: u32, fine: u32, coarse: u32, periodic: bool) -> [(u32, f64); 2] {
    let before = at / 2;
    match at % 2 {
        0 => [(before, 1.0), (0, 0.0)],
        _ if before + 1 < coarse => [(before, 0.5), (before + 1, 0.5)],
        _ if periodic && at + 1 == fine && before > 0 => [(before, 0.5), (0, 0.5)],
        _ => [(before, 1.0), (0, 0.0)],
    }
}

/// The matrix of the corrections: coarse unknowns with the energy of what they do to the fine ones.
fn coarse_matrix(fine: &Matrix, parents: &Parents, unknowns: usize) -> Matrix {
    let mut children: Vec<Vec<(u32, f64)>> = vec![Vec::new(); unknowns];
    for row in 0..fine.len() {
        for &(at, share) in parents.of(row) {
            children[at as usize].push((row as u32, share));
        }
    }
    let mut place = vec![u32::MAX; unknowns];
    Matrix::new(unknowns, |row, entries| {
        for &(child, share) in &children[row] {
            for (column, value) in fine.row(child as usize) {
                for &(at, column_share) in parents.of(column) {
                    let slot = &mut place[at as usize];
                    if *slot == u32::MAX {
                        *slot = entries.len() as u32;
                        entries.push((at, 0.0));
                    }
                    entries[*slot as usize].1 += share * value * column_share;
                }
            }
        }
        entries.iter().for_each(|&(at, _)| place[at as usize] = u32::MAX);
    })
}

#[cfg(test)]
mod tests {
    use super::super::plate::Plate;
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    /// A plate that is held along lines `gap` nodes apart, and off its lines the unknowns.
    fn held_plate(size: [usize; 2], gap: u32, boundary: [Boundary; 2]) -> (Matrix, Places) {
        let lattice = Lattice::plane(size, 1.0, Connectivity::Eight, boundary).unwrap();
        let plate = Plate::new(&lattice);
        let free: Vec<u32> = (0..lattice.node_count() as u32)
            .filter(|n| !(n % size[0] as u32).is_multiple_of(gap))
            .collect();
        let (matrix, _) = plate.equations(&free, &vec![0.0; lattice.node_count()]);
        (matrix, plate.places(&free))
    }

    fn any_vector(unknowns: usize, factor: usize) -> Vec<f64> {
        (0..unknowns).map(|at| (at * at * factor % 101) as f64 - 50.0).collect()
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn a_cycle_is_symmetric_and_positive() {
        for boundary in [[Boundary::Open; 2], [Boundary::Periodic; 2]] {
            let (matrix, places) = held_plate([37, 23], 9, boundary);
            let unknowns = matrix.len();
            let mut grids = Multigrid::new(matrix, places);
            let [a, b] = [7, 13].map(|factor| any_vector(unknowns, factor));
            let (mut of_a, mut of_b) = (a.clone(), b.clone());
            grids.solve(&a, &mut of_a);
            grids.solve(&b, &mut of_b);
            assert!((dot(&of_a, &b) - dot(&a, &of_b)).abs() < 1e-9 * dot(&a, &of_a).abs());
            assert!(dot(&a, &of_a) > 0.0);
        }
    }

    /// The error in the norm of the energy after one cycle, whatever it was, on gaps of four and of
    /// 32 nodes.
    #[test]
    fn a_cycle_takes_most_of_an_error_away() {
        for gap in [4, 32] {
            let (matrix, places) = held_plate([97, 65], gap, [Boundary::Open; 2]);
            let unknowns = matrix.len();
            let mut grids = Multigrid::new(matrix, places);
            let mut error = any_vector(unknowns, 7);
            let (mut image, mut found) = (error.clone(), error.clone());
            let mut rates = Vec::new();
            for _ in 0..12 {
                grids.matrix().apply(&error, &mut image);
                let before = dot(&error, &image);
                grids.solve(&image, &mut found);
                error.iter_mut().zip(&found).for_each(|(error, found)| *error -= found);
                grids.matrix().apply(&error, &mut image);
                rates.push((dot(&error, &image) / before).sqrt());
            }
            assert!(rates.iter().all(|&rate| rate < 0.8), "gap {gap}: {rates:?}");
        }
    }
}
