//! The surface of least bending energy between level sets.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::bounded::{Bounds, Energy, minimise, ordered_sum};
use super::{LevelSets, LevelSetsError};

/// When the search for the least energy ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelaxationLimits {
    /// Share of the first projected gradient that is small enough.
    pub tolerance: f64,
    /// Most steps of the solver.
    pub steps: usize,
}

impl Default for RelaxationLimits {
    /// A thousandth of the first gradient, 10000 steps at most.
    fn default() -> Self {
        Self { tolerance: 1e-3, steps: 10_000 }
    }
}

/// What relaxation did to a surface.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Relaxation {
    /// Steps of the solver.
    pub steps: usize,
    /// Bending energy before.
    pub energy_before: f64,
    /// Bending energy after.
    pub energy_after: f64,
}

impl Relaxation {
    /// By how much the energy fell, in per cent: the thesis reports 43.67 for figure 4.16.
    pub fn reduction_percent(&self) -> f64 {
        if self.energy_before > 0.0 {
            100.0 * (1.0 - self.energy_after / self.energy_before)
        } else {
            0.0
        }
    }
}

/// Relaxes `heights` (metres, one value a node) to the surface of least bending energy between
/// the level sets: the bottom row of figure 4.16, after Szeliski and Terzopoulos (1989).
///
/// Nodes on a level set stay at its height; all others stay between the level sets round them, so
/// that level sets never cross. The result is unique but for the tolerance, and has the same
/// bits on any number of threads.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn relax_bending(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    limits: RelaxationLimits,
    heights: &mut [f64],
) -> Result<Relaxation, LevelSetsError> {
    levels.check(lattice)?;
    let expected = lattice.node_count();
    if heights.len() != expected {
        let found = heights.len();
        return Err(LevelSetsError::Length { field: "heights", expected, found });
    }
    let ranges: Vec<[f64; 2]> = (0..expected).map(|node| levels.range_m(node)).collect();
    let outside = |node: &usize| !(ranges[*node][0]..=ranges[*node][1]).contains(&heights[*node]);
    if let Some(node) = (0..expected).find(outside) {
        let (height_m, range) = (heights[node], ranges[node]);
        return Err(LevelSetsError::Outside { node, height_m, range });
    }
    let (low, high) = ranges.into_iter().map(|[low, high]| (low, high)).unzip();
    let plate = Plate::new(lattice);
    let energy_before = bending_energy(lattice, heights);
    let bounds = Bounds { low, high };
    let steps = minimise(&plate, &bounds, heights, limits.tolerance, limits.steps);
    Ok(Relaxation { steps, energy_before, energy_after: bending_energy(lattice, heights) })
}

/// Bending energy of a surface, `h_xx^2 + 2 h_xy^2 + h_yy^2` summed over the nodes in units of a
/// spacing: second differences along both axes where both neighbours exist, and the mixed one over
/// every square of four nodes.
pub fn bending_energy(lattice: &Lattice, heights: &[f64]) -> f64 {
    let plate = Plate::new(lattice);
    let square = |[xx, yy, xy]: [f64; 3]| xx * xx + yy * yy + 2.0 * xy * xy;
    ordered_sum(heights.len().min(lattice.node_count()), |node| square(plate.bends(heights, node)))
}

/// Second differences on a lattice: the thin plate.
struct Plate {
    width: usize,
    /// Column west and east of each column, row north and south of each row; `NONE` at borders.
    columns: Vec<[usize; 2]>,
    rows: Vec<[usize; 2]>,
}

/// Beyond an open border.
const NONE: usize = usize::MAX;

impl Plate {
    fn new(lattice: &Lattice) -> Self {
        let beside = |axis: usize| {
            let count = lattice.size()[axis];
            let round = lattice.is_periodic(axis);
            let before = move |index: usize| match index {
                0 if round => count - 1,
                0 => NONE,
                _ => index - 1,
            };
            let after = move |index: usize| match index + 1 {
                next if next < count => next,
                _ if round => 0,
                _ => NONE,
            };
            (0..count).map(|index| [before(index), after(index)]).collect()
        };
        Self { width: lattice.width(), columns: beside(0), rows: beside(1) }
    }

    /// Differences at a node: along the row, along the column, and over the square to its
    /// south-east; 0 where a node is missing.
    #[inline]
    fn bends(&self, heights: &[f64], node: usize) -> [f64; 3] {
        let (x, y) = (node % self.width, node / self.width);
        let ([west, east], [north, south]) = (self.columns[x], self.rows[y]);
        let row = y * self.width;
        let here = heights[node];
        let xx = match west != NONE && east != NONE {
            true => heights[row + west] - 2.0 * here + heights[row + east],
            false => 0.0,
        };
        let yy = match north != NONE && south != NONE {
            true => heights[north * self.width + x] - 2.0 * here + heights[south * self.width + x],
            false => 0.0,
        };
        let xy = match east != NONE && south != NONE {
            true => {
                let below = south * self.width;
                heights[below + east] - heights[below + x] - heights[row + east] + here
            }
            false => 0.0,
        };
        [xx, yy, xy]
    }
}

impl Energy for Plate {
    /// Every node gathers from the differences that it is part of.
    fn gradient(&self, heights: &[f64], gradient: &mut [f64]) {
        let mut bends = vec![[0.0; 3]; heights.len()];
        bends.par_iter_mut().enumerate().with_min_len(1024).for_each(|(node, bend)| {
            *bend = self.bends(heights, node);
        });
        let width = self.width;
        gradient.par_chunks_mut(width).enumerate().for_each(|(y, gradient)| {
            let [north, south] = self.rows[y];
            for (x, gradient) in gradient.iter_mut().enumerate() {
                let [west, east] = self.columns[x];
                let bend = |x: usize, y: usize| match x != NONE && y != NONE {
                    true => bends[y * width + x],
                    false => [0.0; 3],
                };
                let here = bend(x, y);
                let along = bend(west, y)[0] - 2.0 * here[0] + bend(east, y)[0];
                let across = bend(x, north)[1] - 2.0 * here[1] + bend(x, south)[1];
                let mixed = here[2] - bend(west, y)[2] - bend(x, north)[2] + bend(west, north)[2];
                *gradient = along + across + 2.0 * mixed;
            }
        });
    }

    /// That of the biharmonic operator on the checkerboard.
    fn largest_eigenvalue(&self) -> f64 {
        64.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::hermite;
    use super::super::testing::{Cone, random_levels};
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(boundary: [Boundary; 2]) -> Lattice {
        Lattice::plane([9, 7], 2.0, Connectivity::Eight, boundary).unwrap()
    }

    /// `x A x` is the energy, whatever `x`, and `A` is symmetric.
    #[test]
    fn the_gradient_is_that_of_the_energy() {
        for boundary in [[Boundary::Open; 2], [Boundary::Periodic, Boundary::Open]] {
            let lattice = lattice(boundary);
            let plate = Plate::new(&lattice);
            let x: Vec<f64> = (0..63).map(|i| f64::from(i * i * 7 % 23)).collect();
            let mut gradient = vec![0.0; 63];
            plate.gradient(&x, &mut gradient);
            let product: f64 = x.iter().zip(&gradient).map(|(x, g)| x * g).sum();
            assert!((product - bending_energy(&lattice, &x)).abs() < 1e-9 * product);
            for node in 0..63 {
                let mut unit = vec![0.0; 63];
                unit[node] = 1.0;
                let mut column = vec![0.0; 63];
                plate.gradient(&unit, &mut column);
                let dot: f64 = column.iter().zip(&x).map(|(c, x)| c * x).sum();
                assert!((dot - gradient[node]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn planes_do_not_bend_and_checkerboards_bend_most() {
        let open = lattice([Boundary::Open; 2]);
        let plane: Vec<f64> = (0..63).map(|n| 3.0 * (n % 9) as f64 - (n / 9) as f64).collect();
        assert!(bending_energy(&open, &plane) < 1e-20);
        let even = Lattice::plane([8, 8], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]);
        let plate = Plate::new(&even.unwrap());
        let board: Vec<f64> =
            (0..64).map(|n| if (n % 8 + n / 8) % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let mut gradient = vec![0.0; 64];
        plate.gradient(&board, &mut gradient);
        let ratio = board.iter().zip(&gradient).map(|(b, g)| g / b);
        assert!(ratio.into_iter().all(|ratio| (ratio - plate.largest_eigenvalue()).abs() < 1e-9));
    }

    /// The Hermite surface relaxes to one of less energy that no small change between the level
    /// sets improves.
    #[test]
    fn relaxation_finds_the_least_energy() {
        let (lattice, band, on_level) = random_levels([30, 24], 4);
        let levels = LevelSets { band: &band, on_level: &on_level, interval_m: 5.0 };
        let mut heights = hermite(&lattice, &levels).unwrap();
        let limits = RelaxationLimits { tolerance: 1e-9, steps: 100_000 };
        let relaxed = relax_bending(&lattice, &levels, limits, &mut heights).unwrap();
        assert!(relaxed.steps < limits.steps);
        assert!(relaxed.reduction_percent() > 5.0, "{relaxed:?}");
        for node in 0..lattice.node_count() {
            let [low, high] = levels.range_m(node);
            for change in [-1e-3, 1e-3] {
                let mut changed = heights.clone();
                changed[node] = (heights[node] + change).clamp(low, high);
                let energy = bending_energy(&lattice, &changed);
                assert!(energy >= relaxed.energy_after - 1e-9, "{node}");
            }
        }
    }

    #[test]
    fn heights_between_level_sets_only() {
        let cone = Cone::new(21, 5);
        let levels = cone.levels();
        let mut heights = vec![-1.0; 441];
        let refused =
            relax_bending(&cone.lattice, &levels, RelaxationLimits::default(), &mut heights);
        assert!(matches!(refused, Err(LevelSetsError::Outside { node: 0, .. })), "{refused:?}");
        let refused = relax_bending(&cone.lattice, &levels, RelaxationLimits::default(), &mut []);
        assert!(matches!(refused, Err(LevelSetsError::Length { field: "heights", .. })));
    }
}
