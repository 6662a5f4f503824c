//! Random midpoint displacement: diamond-square and 4-8 subdivision.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rand::RngExt;
use rand_distr::StandardNormal;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Generator, SynthError};

/// How a coarse surface becomes a finer one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum Subdivision {
    /// New vertices in the middle of squares are the mean of their four corners, those on edges
    /// the mean of their two ends, old ones stay: linear interpolation, which leaves creases on
    /// all lines of the coarse grid.
    Linear,
    /// New vertices are the mean of four, old ones stay (Fournier, Fussell and Carpenter 1982):
    /// leaves peaks and creases.
    DiamondSquare,
    /// 4-8 subdivision (Velho and Zorin 2001), but vertices of the coarse shape stay.
    FourEightFrozen,
    /// 4-8 subdivision of all vertices: without displacement the surface is C4 smooth.
    #[default]
    FourEight,
}

/// Random midpoint displacement (thesis, section 2.1.5, figures 2.4 to 2.6).
///
/// A coarse grid is made finer in half steps: first a vertex appears in the middle of every
/// square, then one in the middle of every diamond that this makes. A new vertex is the mean of
/// the four next to it (in linear subdivision, on edges, of their two ends) plus a random number of standard deviation `amplitude_m (d / D)^hurst`,
/// where `d` is the distance to the four and `D` the spacing of the coarse grid. In 4-8
/// subdivision old vertices then become half of what they were plus an eighth of each of their
/// four neighbours. Open borders are mirrors.
///
/// # Limits
/// 2-D only. A periodic axis needs a whole number of coarse cells. Fine detail depends on coarse
/// detail, so the lines of the coarse grid stay visible.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MidpointDisplacement {
    /// Mean height of a random coarse shape, and what is added to a given one.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Standard deviation of the heights of a random coarse shape, and scale of displacements.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Hurst exponent H: near 0 rough, near 1 smooth.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub hurst: f64,
    /// Halvings of the coarse grid, whose cells are 2^levels nodes wide: at most twice the
    /// lattice.
    #[schemars(range(min = 0, max = 16))]
    pub levels: u32,
    /// How the surface is made finer.
    pub subdivision: Subdivision,
    /// Heights of the coarse grid, rows from north to south; random if there are none.
    #[schemars(extend("x-unit" = "m"))]
    pub coarse_m: Vec<Vec<f64>>,
}

impl Default for MidpointDisplacement {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            amplitude_m: 100.0,
            hurst: 0.8,
            levels: 5,
            subdivision: Subdivision::FourEight,
            coarse_m: Vec::new(),
        }
    }
}

impl Generator for MidpointDisplacement {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        let mesh = self.check(lattice)?;
        let coarse = 1 << self.levels;
        let stream = RandomStream::new(seed, "midpoint displacement");
        let mut heights = self.coarse_shape(&mesh, &stream);
        let mut finer = heights.clone();
        for level in 0..self.levels {
            let reach = coarse >> (level + 1);
            for new in [NewVertices::Squares, NewVertices::Diamonds] {
                let share = new.distance(reach) / coarse as f64;
                let deviation = self.amplitude_m * share.powf(self.hurst);
                let refinement = Refinement { new, reach, coarse, subdivision: self.subdivision };
                refinement.apply(&mesh, &heights, &mut finer, |vertex| {
                    deviation * stream.at(0, vertex).sample::<f64, _>(StandardNormal)
                });
                std::mem::swap(&mut heights, &mut finer);
            }
        }
        let rows = heights.chunks(mesh.size[0]).take(lattice.height());
        Ok(rows
            .flat_map(|row| &row[..lattice.width()])
            .map(|height| height + self.mean_m)
            .collect())
    }
}

impl MidpointDisplacement {
    /// Checks the parameters and returns the mesh that covers the lattice.
    fn check(&self, lattice: &Lattice) -> Result<Mesh, SynthError> {
        let checks = Checks("MidpointDisplacement");
        checks.plane(lattice)?;
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.range("hurst", self.hurst, 0.0..=1.0)?;
        let narrowest = lattice.size().into_iter().filter(|&nodes| nodes > 1).min().unwrap_or(2);
        let most = (2 * (narrowest - 1)).ilog2().min(16);
        checks.range("levels", f64::from(self.levels), 0.0..=f64::from(most))?;
        let mesh = Mesh::covering(lattice, 1 << self.levels)?;
        let [columns, rows] = mesh.coarse_vertices(1 << self.levels);
        let right_size = self.coarse_m.len() == rows
            && self.coarse_m.iter().all(|heights| heights.len() == columns);
        if !self.coarse_m.is_empty() && !right_size {
            return Err(SynthError::CoarseShape { generator: checks.0, rows, columns });
        }
        self.coarse_m.iter().flatten().try_for_each(|&h| checks.elevation("coarse_m", h))?;
        Ok(mesh)
    }

    /// Heights of the mesh, of which only the vertices of the coarse grid mean something.
    fn coarse_shape(&self, mesh: &Mesh, stream: &RandomStream) -> Vec<f64> {
        let coarse = 1 << self.levels;
        let mut heights = vec![0.0; mesh.size[0] * mesh.size[1]];
        for y in (0..mesh.size[1]).step_by(coarse) {
            for x in (0..mesh.size[0]).step_by(coarse) {
                let vertex = x + mesh.size[0] * y;
                heights[vertex] = match self.coarse_m.get(y / coarse) {
                    Some(row) => row[x / coarse],
                    None => {
                        self.amplitude_m * stream.at(0, vertex).sample::<f64, _>(StandardNormal)
                    }
                };
            }
        }
        heights
    }
}

/// The vertices of the finest grid, whole coarse cells along both axes.
#[derive(Clone, Copy, Debug)]
struct Mesh {
    size: [usize; 2],
    periodic: [bool; 2],
}

impl Mesh {
    /// The mesh of coarse cells `coarse` nodes wide that covers `lattice`.
    fn covering(lattice: &Lattice, coarse: usize) -> Result<Self, SynthError> {
        let periodic = [0, 1].map(|axis| lattice.is_periodic(axis));
        let mut size = [lattice.width(), lattice.height()];
        for (axis, name) in ['x', 'y'].into_iter().enumerate() {
            if !periodic[axis] {
                size[axis] = (size[axis] - 1).next_multiple_of(coarse) + 1;
            } else if !size[axis].is_multiple_of(coarse) {
                let generator = "MidpointDisplacement";
                let remedy = "take fewer levels, or a multiple of 2^levels nodes";
                return Err(SynthError::DoesNotClose { generator, axis: name, remedy });
            }
        }
        Ok(Self { size, periodic })
    }

    /// Number of columns and rows of the coarse grid.
    fn coarse_vertices(&self, coarse: usize) -> [usize; 2] {
        self.size.map(|vertices| vertices.div_ceil(coarse))
    }

    /// The coordinate `distance` away along an axis: round the mesh, or reflected at its border.
    #[inline]
    fn moved(&self, axis: usize, from: usize, distance: isize) -> usize {
        let last = self.size[axis] as isize - 1;
        let to = from as isize + distance;
        let inside = match (0..=last).contains(&to) {
            true => to,
            false if self.periodic[axis] => to.rem_euclid(last + 1),
            false if to < 0 => (-to).min(last),
            false => (2 * last - to).max(0),
        };
        inside as usize
    }

    /// Mean of the heights of the two vertices at `reach` from a vertex along an axis.
    #[inline]
    fn between(&self, heights: &[f64], [x, y]: [usize; 2], axis: usize, reach: usize) -> f64 {
        let reach = reach as isize;
        let height = |distance: isize| match axis {
            0 => heights[self.moved(0, x, distance) + self.size[0] * y],
            _ => heights[x + self.size[0] * self.moved(1, y, distance)],
        };
        0.5 * (height(-reach) + height(reach))
    }

    /// Sum of the heights of the four vertices at `reach` from a vertex.
    #[inline]
    fn around(&self, heights: &[f64], [x, y]: [usize; 2], new: NewVertices, reach: usize) -> f64 {
        let reach = reach as isize;
        let offsets = match new {
            NewVertices::Squares => {
                [[-reach, -reach], [reach, -reach], [-reach, reach], [reach; 2]]
            }
            NewVertices::Diamonds => [[0, -reach], [-reach, 0], [reach, 0], [0, reach]],
        };
        let height = |[east, south]: [isize; 2]| {
            heights[self.moved(0, x, east) + self.size[0] * self.moved(1, y, south)]
        };
        offsets.map(height).iter().sum()
    }
}

/// Where the vertices of a half step appear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NewVertices {
    /// In the middle of squares: the four vertices next to one lie on its diagonals.
    Squares,
    /// In the middle of diamonds: the four lie along the axes.
    Diamonds,
}

impl NewVertices {
    /// Distance from a new vertex to the four that it is the mean of.
    fn distance(self, reach: usize) -> f64 {
        match self {
            Self::Squares => reach as f64 * std::f64::consts::SQRT_2,
            Self::Diamonds => reach as f64,
        }
    }
}

/// A half step of subdivision: half of the vertices that it leaves are new.
#[derive(Clone, Copy, Debug)]
struct Refinement {
    new: NewVertices,
    /// Half the width of the squares.
    reach: usize,
    /// Width of the squares of the coarse grid.
    coarse: usize,
    subdivision: Subdivision,
}

impl Refinement {
    /// Writes all vertices of the finer surface from those of the coarser one; `displacement` of
    /// a new vertex is added.
    fn apply(
        &self,
        mesh: &Mesh,
        heights: &[f64],
        finer: &mut [f64],
        displacement: impl Fn(usize) -> f64 + Sync,
    ) {
        let width = mesh.size[0];
        let rows = finer.par_chunks_mut(width).enumerate();
        rows.filter(|(y, _)| y % self.reach == 0).for_each(|(y, row)| {
            for x in (0..width).step_by(self.reach) {
                let [column, line] = [x / self.reach % 2, y / self.reach % 2];
                let old = heights[x + width * y];
                row[x] = match (self.new, column, line) {
                    (_, 0, 0) => self.smoothed(mesh, heights, [x, y], old),
                    (NewVertices::Diamonds, 1, 1) => self.smoothed(mesh, heights, [x, y], old),
                    (NewVertices::Squares, 0, 1) | (NewVertices::Squares, 1, 0) => continue,
                    _ => {
                        let mean = match (self.subdivision, self.new) {
                            (Subdivision::Linear, NewVertices::Diamonds) => {
                                mesh.between(heights, [x, y], 1 - column, self.reach)
                            }
                            _ => 0.25 * mesh.around(heights, [x, y], self.new, self.reach),
                        };
                        mean + displacement(x + width * y)
                    }
                };
            }
        });
    }

    /// New height of an old vertex.
    fn smoothed(&self, mesh: &Mesh, heights: &[f64], [x, y]: [usize; 2], old: f64) -> f64 {
        let of_coarse_shape = x % self.coarse == 0 && y % self.coarse == 0;
        let stays = match self.subdivision {
            Subdivision::DiamondSquare | Subdivision::Linear => true,
            Subdivision::FourEightFrozen => of_coarse_shape,
            Subdivision::FourEight => false,
        };
        if stays {
            return old;
        }
        // The nearest old vertices: along the axes of squares, then along their diagonals.
        let sum = match self.new {
            NewVertices::Squares => {
                mesh.around(heights, [x, y], NewVertices::Diamonds, 2 * self.reach)
            }
            NewVertices::Diamonds => mesh.around(heights, [x, y], NewVertices::Squares, self.reach),
        };
        0.5 * old + 0.125 * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(size: [usize; 2], boundary: Boundary) -> Lattice {
        Lattice::plane(size, 1.0, Connectivity::Eight, [boundary; 2]).unwrap()
    }

    /// A half step of 4-8 subdivision as a convolution: every old height spreads over the finer
    /// grid by the square of a hat along both of its axes.
    fn spread(heights: &[f64], side: usize, new: NewVertices, reach: usize) -> Vec<f64> {
        let mut finer = vec![0.0; side * side];
        for (vertex, height) in heights.iter().enumerate() {
            for (first, first_share) in [(-1, 0.25), (0, 0.5), (1, 0.25)] {
                for (second, second_share) in [(-1, 0.25), (0, 0.5), (1, 0.25)] {
                    let offset: [isize; 2] = match new {
                        NewVertices::Squares => [first + second, first - second],
                        NewVertices::Diamonds => [first, second],
                    };
                    let [x, y] = [vertex % side, vertex / side].map(|at| at as isize);
                    let to = [x + offset[0] * reach as isize, y + offset[1] * reach as isize];
                    let [x, y] = to.map(|at| at.rem_euclid(side as isize) as usize);
                    finer[x + side * y] += 2.0 * first_share * second_share * height;
                }
            }
        }
        finer
    }

    /// Without displacement every cell of the coarse grid is a bilinear patch.
    #[test]
    fn linear_subdivision_interpolates_between_the_corners_of_a_cell() {
        let surface = MidpointDisplacement {
            amplitude_m: 0.0,
            levels: 3,
            subdivision: Subdivision::Linear,
            coarse_m: vec![vec![0.0, 8.0, -4.0], vec![16.0, 32.0, 0.0], vec![8.0, 56.0, -32.0]],
            ..Default::default()
        };
        for (boundary, side) in [(Boundary::Open, 17), (Boundary::Periodic, 24)] {
            let found = surface.generate(&lattice([side, side], boundary), 1).unwrap();
            for (node, height) in found.iter().enumerate() {
                let [x, y] = [node % side, node / side];
                let corner = |column: usize, row: usize| surface.coarse_m[row % 3][column % 3];
                let [east, south] = [x % 8, y % 8].map(|part| part as f64 / 8.0);
                let along = |row| corner(x / 8, row) * (1.0 - east) + corner(x / 8 + 1, row) * east;
                let expected = along(y / 8) * (1.0 - south) + along(y / 8 + 1) * south;
                assert!((height - expected).abs() < 1e-9, "{boundary:?} {x} {y}");
            }
        }
    }

    #[test]
    fn four_eight_subdivision_is_that_of_a_box_spline() {
        let surface = MidpointDisplacement {
            amplitude_m: 0.0,
            levels: 3,
            coarse_m: vec![vec![0.0, 3.0, -1.0], vec![5.0, 2.0, 0.0], vec![1.0, 7.0, -4.0]],
            ..Default::default()
        };
        let found = surface.generate(&lattice([24, 24], Boundary::Periodic), 1).unwrap();
        let mut expected = vec![0.0; 24 * 24];
        for (row, heights) in surface.coarse_m.iter().enumerate() {
            for (column, height) in heights.iter().enumerate() {
                expected[8 * column + 24 * 8 * row] = *height;
            }
        }
        for reach in [4, 2, 1] {
            expected = spread(&expected, 24, NewVertices::Squares, reach);
            expected = spread(&expected, 24, NewVertices::Diamonds, reach);
        }
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
        }
    }

    /// Figures 2.4 to 2.6: the raised point of a 3 x 3 grid.
    fn peak(subdivision: Subdivision) -> Vec<f64> {
        let surface = MidpointDisplacement {
            amplitude_m: 0.0,
            levels: 5,
            subdivision,
            coarse_m: vec![vec![0.0; 3], vec![0.0, 1.0, 0.0], vec![0.0; 3]],
            ..Default::default()
        };
        surface.generate(&lattice([65, 65], Boundary::Open), 1).unwrap()
    }

    /// Largest second difference in the interior, relative to the height of the surface.
    fn crease(heights: &[f64]) -> f64 {
        let highest = heights.iter().copied().fold(0.0, f64::max);
        let bend = |node: usize, step: usize| {
            (heights[node - step] + heights[node + step] - 2.0 * heights[node]).abs()
        };
        let inner = (1..64).flat_map(|y| (1..64).map(move |x| x + 65 * y));
        inner.map(|node| bend(node, 1).max(bend(node, 65))).fold(0.0, f64::max) / highest
    }

    #[test]
    fn diamond_square_leaves_creases() {
        let [square, frozen, smooth] =
            [Subdivision::DiamondSquare, Subdivision::FourEightFrozen, Subdivision::FourEight]
                .map(peak);
        assert_eq!([square[32 + 65 * 32], frozen[32 + 65 * 32]], [1.0, 1.0]);
        assert!(
            crease(&square) > 2.0 * crease(&smooth),
            "{}, {}",
            crease(&square),
            crease(&smooth)
        );
    }

    #[test]
    fn diamond_square_keeps_the_coarse_shape() {
        let surface = MidpointDisplacement {
            subdivision: Subdivision::DiamondSquare,
            levels: 2,
            coarse_m: vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]],
            ..Default::default()
        };
        let found = surface.generate(&lattice([9, 5], Boundary::Open), 1).unwrap();
        let coarse = [0, 4, 8, 36, 40, 44].map(|node| found[node]);
        assert_eq!(coarse, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let wrong = MidpointDisplacement { levels: 1, ..surface };
        let refused = wrong.generate(&lattice([9, 5], Boundary::Open), 1).unwrap_err();
        assert_eq!(
            refused,
            SynthError::CoarseShape { generator: "MidpointDisplacement", rows: 3, columns: 5 }
        );
    }
}
