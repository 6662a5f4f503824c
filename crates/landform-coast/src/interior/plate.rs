//! The thin plate on a lattice: second differences and their equations.

use landform_graph::Lattice;

use super::bounded::ordered_sum;
use super::multigrid::Places;
use super::sparse::Matrix;

/// Beyond an open border.
const NONE: u32 = u32::MAX;

/// A thin plate whose heights stand at the nodes of a plane.
pub(super) struct Plate {
    /// Column west and east of each column, row north and south of each row; `NONE` at borders.
    columns: Vec<[u32; 2]>,
    rows: Vec<[u32; 2]>,
    periodic: [bool; 2],
}

/// A second difference: what its nodes are multiplied with.
type Bend = [(usize, f64); 4];

/// The kinds of second differences, each with its weight in the energy.
const KINDS: [(Kind, f64); 3] = [(Kind::Row, 1.0), (Kind::Column, 1.0), (Kind::Square, 2.0)];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Along the row of the node.
    Row,
    /// Along its column.
    Column,
    /// Over the square to its south-east.
    Square,
}

impl Plate {
    pub fn new(lattice: &Lattice) -> Self {
        let beside = |axis: usize| {
            let (count, round) = (lattice.size()[axis] as u32, lattice.is_periodic(axis));
            let before = move |index: u32| match index {
                0 if round => count - 1,
                0 => NONE,
                _ => index - 1,
            };
            let after = move |index: u32| match index + 1 {
                next if next < count => next,
                _ if round => 0,
                _ => NONE,
            };
            (0..count).map(|index| [before(index), after(index)]).collect()
        };
        let periodic = [0, 1].map(|axis| lattice.is_periodic(axis));
        Self { columns: beside(0), rows: beside(1), periodic }
    }

    /// The bending energy of heights, one for each node.
    pub fn energy(&self, heights: &[f64]) -> f64 {
        let value = |bend: Bend| bend.iter().map(|&(node, factor)| factor * heights[node]).sum();
        ordered_sum(heights.len(), |node| {
            let at = self.place(node);
            let bends = KINDS.map(|(kind, weight)| {
                let bend: f64 = self.bend(kind, at).map_or(0.0, value);
                weight * bend * bend
            });
            bends.iter().sum()
        })
    }

    /// `A` and `b` for the free nodes, whose heights are least in energy where `A x = b`; all
    /// other nodes keep their heights.
    pub fn equations(&self, free: &[u32], heights: &[f64]) -> (Matrix, Vec<f64>) {
        let mut number = vec![NONE; heights.len()];
        free.iter().zip(0..).for_each(|(&node, at)| number[node as usize] = at);
        let mut right = vec![0.0; free.len()];
        let mut row = Vec::new();
        let matrix = Matrix::new(free.len(), |at, entries| {
            self.row(free[at] as usize, &mut row);
            for &(node, factor) in &row {
                match number[node] {
                    NONE => right[at] -= factor * heights[node],
                    column => entries.push((column, factor)),
                }
            }
        });
        (matrix, right)
    }

    /// Where nodes lie on the grid.
    pub fn places(&self, nodes: &[u32]) -> Places {
        let size = [self.columns.len(), self.rows.len()];
        let at = nodes.iter().map(|&node| self.place(node as usize)).collect();
        Places { size, periodic: self.periodic, at }
    }

    fn place(&self, node: usize) -> [u32; 2] {
        let width = self.columns.len();
        [(node % width) as u32, (node / width) as u32]
    }

    /// How the energy depends on a node: half of its slope, as factors of the heights of nodes.
    fn row(&self, node: usize, row: &mut Vec<(usize, f64)>) {
        row.clear();
        for (kind, weight) in KINDS {
            for bend in self.bends_of(kind, self.place(node)).into_iter().flatten() {
                let is_own = |(of, _): &&(usize, f64)| *of == node;
                let own: f64 = bend.iter().filter(is_own).map(|(_, factor)| factor).sum();
                for (of, factor) in bend {
                    match row.iter_mut().find(|(node, _)| *node == of) {
                        Some((_, sum)) => *sum += weight * own * factor,
                        None => row.push((of, weight * own * factor)),
                    }
                }
            }
        }
    }

    /// The differences of a kind that a node is part of, each once.
    fn bends_of(&self, kind: Kind, [x, y]: [u32; 2]) -> [Option<Bend>; 4] {
        let ([west, east], [north, south]) = (self.columns[x as usize], self.rows[y as usize]);
        let middles = match kind {
            Kind::Row => [[x, y], [west, y], [east, y], [NONE; 2]],
            Kind::Column => [[x, y], [x, north], [x, south], [NONE; 2]],
            Kind::Square => [[x, y], [west, y], [x, north], [west, north]],
        };
        middles.map(|middle| (!middle.contains(&NONE)).then(|| self.bend(kind, middle)).flatten())
    }

    /// The difference of a kind at a node; none where a node is missing.
    fn bend(&self, kind: Kind, [x, y]: [u32; 2]) -> Option<Bend> {
        let ([west, east], [north, south]) = (self.columns[x as usize], self.rows[y as usize]);
        let width = self.columns.len();
        let node =
            |x: u32, y: u32| (x != NONE && y != NONE).then_some(x as usize + width * y as usize);
        let here = node(x, y)?;
        Some(match kind {
            Kind::Row => [(node(west, y)?, 1.0), (here, -2.0), (node(east, y)?, 1.0), (here, 0.0)],
            Kind::Column => {
                [(node(x, north)?, 1.0), (here, -2.0), (node(x, south)?, 1.0), (here, 0.0)]
            }
            Kind::Square => [
                (here, 1.0),
                (node(east, y)?, -1.0),
                (node(x, south)?, -1.0),
                (node(east, south)?, 1.0),
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    const BOUNDARIES: [[Boundary; 2]; 3] =
        [[Boundary::Open; 2], [Boundary::Periodic, Boundary::Open], [Boundary::Periodic; 2]];

    fn lattice(size: [usize; 2], boundary: [Boundary; 2]) -> Lattice {
        Lattice::plane(size, 2.0, Connectivity::Eight, boundary).unwrap()
    }

    /// `x A x` is the energy, whatever `x`, and `A` is symmetric, also where differences overlap.
    #[test]
    fn the_equations_are_those_of_the_energy() {
        for (size, boundary) in BOUNDARIES.map(|b| ([9, 7], b)).into_iter().chain([
            ([3, 6], BOUNDARIES[2]),
            ([4, 2], BOUNDARIES[1]),
            ([2, 2], BOUNDARIES[0]),
        ]) {
            let plate = Plate::new(&lattice(size, boundary));
            let nodes = size[0] * size[1];
            let all: Vec<u32> = (0..nodes as u32).collect();
            let x: Vec<f64> = (0..nodes).map(|i| (i * i * 7 % 23) as f64).collect();
            let (matrix, right) = plate.equations(&all, &x);
            let mut image = vec![0.0; nodes];
            matrix.apply(&x, &mut image);
            let product: f64 = x.iter().zip(&image).map(|(x, image)| x * image).sum();
            assert!((product - plate.energy(&x)).abs() <= 1e-12 * product, "{size:?}");
            assert!(right.iter().all(|&right| right == 0.0));
            let entry = |row: usize, column: usize| {
                matrix.row(row).find(|(at, _)| *at == column).map_or(0.0, |(_, value)| value)
            };
            for (row, column) in (0..nodes).flat_map(|row| (0..row).map(move |c| (row, c))) {
                assert_eq!(entry(row, column), entry(column, row));
            }
        }
    }

    /// Nodes that keep their heights are on the right side: the equations hold on a plane.
    #[test]
    fn planes_do_not_bend() {
        let plate = Plate::new(&lattice([9, 7], BOUNDARIES[0]));
        let plane: Vec<f64> = (0..63).map(|n| 3.0 * (n % 9) as f64 - (n / 9) as f64).collect();
        assert!(plate.energy(&plane) < 1e-20);
        let free: Vec<u32> = (0..63).filter(|node| node % 3 > 0).collect();
        let (matrix, right) = plate.equations(&free, &plane);
        let x: Vec<f64> = free.iter().map(|&node| plane[node as usize]).collect();
        for (row, right) in right.iter().enumerate() {
            assert!((matrix.dot(row, &x) - right).abs() < 1e-12);
        }
    }

    /// The biharmonic operator multiplies a checkerboard by 64.
    #[test]
    fn checkerboards_bend_most() {
        let plate = Plate::new(&lattice([8, 8], BOUNDARIES[2]));
        let sign = |n: usize| if (n % 8 + n / 8).is_multiple_of(2) { 1.0 } else { -1.0 };
        let board: Vec<f64> = (0..64).map(sign).collect();
        let (matrix, _) = plate.equations(&(0..64).collect::<Vec<u32>>(), &board);
        for (row, value) in board.iter().enumerate() {
            assert!((matrix.dot(row, &board) - 64.0 * value).abs() < 1e-12);
        }
    }
}
