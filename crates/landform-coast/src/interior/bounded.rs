//! Least of a quadratic energy between bounds.

use rayon::prelude::*;

use super::multigrid::{Multigrid, Places};
use super::sparse::Matrix;

/// Values of a dot product that are added up one after the other, so that sums have the same bits
/// on any number of threads.
const CHUNK: usize = 4096;
/// Share of the gradient between the bounds that a round leaves.
const ROUND_TOLERANCE: f64 = 0.05;
/// Steps of conjugate gradients in a round, at most.
const ROUND_STEPS: usize = 100;

/// A quadratic energy `x A x / 2 - b x` of unknowns between bounds.
pub(super) struct Bounded {
    /// `A`, symmetric and positive or semi-definite.
    pub matrix: Matrix,
    /// `b`.
    pub right: Vec<f64>,
    /// Where the unknowns lie.
    pub places: Places,
    pub low: Vec<f64>,
    pub high: Vec<f64>,
}

/// How far a search for the least energy has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Progress {
    /// Rounds.
    pub rounds: usize,
    /// Projected gradient beside the first one.
    pub residual: f64,
}

impl Bounded {
    /// Lowers the energy of `x`, which lies between the bounds, until the projected gradient has
    /// fallen below `tolerance` times what it was, or to what rounding leaves, or for `most` rounds.
    ///
    /// Method: a round is a double sweep of Gauss and Seidel between the bounds, which finds out
    /// the unknowns that lie on them, then conjugate gradients with multigrid among the others,
    /// cut off at the bounds, with the best length along what is left (truncated nonsmooth Newton
    /// multigrid, Graeser and Kornhuber 2009). No part of a round raises the energy, and sweeps
    /// alone would lead to the least one.
    pub fn minimise(&self, x: &mut [f64], tolerance: f64, most: usize) -> Progress {
        let mut gradient = vec![0.0; x.len()];
        self.gradient(x, &mut gradient);
        let first = self.projected(x, &gradient);
        let enough = (tolerance * first).max(self.noise(x));
        let (mut rounds, mut left) = (0, first);
        while rounds < most && left > enough {
            self.sweep(x);
            self.gradient(x, &mut gradient);
            self.correct(x, &gradient);
            self.gradient(x, &mut gradient);
            left = self.projected(x, &gradient);
            rounds += 1;
        }
        Progress { rounds, residual: if rounds > 0 { left / first } else { 0.0 } }
    }

    /// Length of a gradient that is nothing but rounding.
    fn noise(&self, x: &[f64]) -> f64 {
        // The entries of a row of the plate add up to less than four times the largest diagonal.
        let terms = 4.0 * self.matrix.largest_diagonal() * dot(x, x).sqrt();
        f64::EPSILON * (terms + dot(&self.right, &self.right).sqrt())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) {
        self.matrix.apply(x, gradient);
        gradient.iter_mut().zip(&self.right).for_each(|(gradient, right)| *gradient -= right);
    }

    /// Length of the part of the gradient along which unknowns may move.
    fn projected(&self, x: &[f64], gradient: &[f64]) -> f64 {
        let free = |at: usize| match (x[at] <= self.low[at], x[at] >= self.high[at]) {
            (true, true) => 0.0,
            (true, false) => gradient[at].min(0.0),
            (false, true) => gradient[at].max(0.0),
            (false, false) => gradient[at],
        };
        ordered_sum(x.len(), |at| free(at).powi(2)).sqrt()
    }

    /// Every unknown in turn takes the best value between its bounds, forth and back.
    fn sweep(&self, x: &mut [f64]) {
        for at in (0..x.len()).chain((0..x.len()).rev()) {
            let best = x[at] + self.matrix.correction(at, x, self.right[at]);
            x[at] = best.clamp(self.low[at], self.high[at]);
        }
    }

    /// Moves the unknowns between their bounds towards their least energy.
    fn correct(&self, x: &mut [f64], gradient: &[f64]) {
        let inside = |at: &u32| {
            let at = *at as usize;
            self.low[at] < x[at] && x[at] < self.high[at]
        };
        let inside: Vec<u32> = (0..x.len() as u32).filter(inside).collect();
        let at = inside.iter().map(|&at| self.places.at[at as usize]).collect();
        let places = Places { at, ..self.places };
        let right: Vec<f64> = inside.iter().map(|&at| -gradient[at as usize]).collect();
        let solution = conjugate_gradients(self.matrix.among(&inside), places, &right);
        let mut direction = vec![0.0; x.len()];
        for (&at, change) in inside.iter().zip(solution) {
            let at = at as usize;
            direction[at] = (x[at] + change).clamp(self.low[at], self.high[at]) - x[at];
        }
        let mut image = vec![0.0; x.len()];
        self.matrix.apply(&direction, &mut image);
        let slope = dot(gradient, &direction);
        let bend = dot(&direction, &image);
        // Cut off at the bounds, a direction may lead uphill; sweeps go on then.
        let length = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 0.0 };
        for (at, x) in x.iter_mut().enumerate() {
            *x = (*x + length * direction[at]).clamp(self.low[at], self.high[at]);
        }
    }
}

/// Solves `A x = right` to a share of [`ROUND_TOLERANCE`], by conjugate gradients with multigrid as
/// preconditioner.
fn conjugate_gradients(matrix: Matrix, places: Places, right: &[f64]) -> Vec<f64> {
    let unknowns = right.len();
    let mut grids = Multigrid::new(matrix, places);
    let mut x = vec![0.0; unknowns];
    let [mut conditioned, mut image] = [(); 2].map(|()| vec![0.0; unknowns]);
    let mut left = right.to_vec();
    let enough = ROUND_TOLERANCE * dot(right, right).sqrt();
    grids.solve(&left, &mut conditioned);
    let mut direction = conditioned.clone();
    let mut descent = dot(&left, &conditioned);
    for _ in 0..ROUND_STEPS {
        grids.matrix().apply(&direction, &mut image);
        let bend = dot(&direction, &image);
        // Without a bend nothing is left to do, or nothing changes along the direction.
        if bend.is_nan() || bend <= 0.0 {
            break;
        }
        let length = descent / bend;
        x.iter_mut().zip(&direction).for_each(|(x, along)| *x += length * along);
        left.iter_mut().zip(&image).for_each(|(left, image)| *left -= length * image);
        if dot(&left, &left).sqrt() <= enough {
            break;
        }
        grids.solve(&left, &mut conditioned);
        let next = dot(&left, &conditioned);
        let keep = next / descent;
        descent = next;
        let turn = |(along, steepest): (&mut f64, &f64)| *along = steepest + keep * *along;
        direction.iter_mut().zip(&conditioned).for_each(turn);
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    ordered_sum(a.len().min(b.len()), |at| a[at] * b[at])
}

/// A sum over nodes with the same bits on any number of threads.
pub(super) fn ordered_sum(nodes: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let chunks = nodes.div_ceil(CHUNK);
    let sum_of_chunk = |chunk: usize| {
        let end = (CHUNK * (chunk + 1)).min(nodes);
        (CHUNK * chunk..end).map(&term).sum::<f64>()
    };
    let sums: Vec<f64> = (0..chunks).into_par_iter().map(sum_of_chunk).collect();
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::super::plate::Plate;
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    /// A string with fixed ends at height 0 between bounds.
    fn string(low: Vec<f64>, high: Vec<f64>) -> Bounded {
        let nodes = low.len();
        let matrix = Matrix::new(nodes, |row, entries| {
            entries.push((row as u32, 2.0));
            let beside = [row.wrapping_sub(1), row + 1];
            let inner = beside.into_iter().filter(|&next| next < nodes);
            entries.extend(inner.map(|next| (next as u32, -1.0)));
        });
        let at = (0..nodes as u32).map(|x| [x, 0]).collect();
        let places = Places { size: [nodes, 1], periodic: [false; 2], at };
        Bounded { matrix, right: vec![0.0; nodes], places, low, high }
    }

    /// A string over an obstacle is straight from its ends to the obstacle.
    #[test]
    fn a_string_over_a_peg_is_straight() {
        let nodes = 301;
        let mut low = vec![-1.0_f64; nodes];
        low[30] = 6.0;
        let mut x: Vec<f64> = low.iter().map(|low| low.max(3.0)).collect();
        let progress = string(low, vec![10.0; nodes]).minimise(&mut x, 1e-10, 100);
        assert!(progress.residual <= 1e-10, "{progress:?}");
        for (node, x) in x.iter().enumerate() {
            let exact = match node {
                0..=30 => 6.0 * (node + 1) as f64 / 31.0,
                _ => 6.0 * (nodes - node) as f64 / 271.0,
            };
            assert!((x - exact).abs() < 1e-6, "{x} for {exact} at {node}");
        }
    }

    /// A plane does not bend: the gradient is rounding, of which nothing can be asked.
    #[test]
    fn the_least_energy_is_known_when_it_is_there() {
        let lattice = Lattice::plane([40, 30], 1.0, Connectivity::Eight, [Boundary::Open; 2]);
        let plate = Plate::new(&lattice.unwrap());
        let free: Vec<u32> = (0..1200).filter(|node| node % 11 > 0).collect();
        let plane = |node: u32| 1e3 / 3.0 + 0.1 * f64::from(node % 40) + f64::from(node / 40) / 7.0;
        let heights: Vec<f64> = (0..1200).map(plane).collect();
        let (matrix, right) = plate.equations(&free, &heights);
        let mut x: Vec<f64> = free.iter().map(|&node| plane(node)).collect();
        let (low, high) = x.iter().map(|x| (x - 1.0, x + 1.0)).unzip();
        let bounded = Bounded { matrix, right, places: plate.places(&free), low, high };
        let progress = bounded.minimise(&mut x, 1e-6, 10);
        assert_eq!((progress.rounds, progress.residual), (0, 0.0));
    }

    #[test]
    fn values_that_are_held_fast_stay() {
        let fixed = vec![1.0, 2.0, 3.0];
        let mut x = fixed.clone();
        let progress = string(fixed.clone(), fixed.clone()).minimise(&mut x, 1e-6, 10);
        assert_eq!((progress.rounds, progress.residual), (0, 0.0));
        assert_eq!(x, fixed);
    }

    /// The reference: sweeps alone, until nothing moves.
    #[test]
    fn rounds_find_what_sweeps_alone_find() {
        let lattice = Lattice::plane([24, 20], 1.0, Connectivity::Eight, [Boundary::Open; 2]);
        let (plate, nodes) = (Plate::new(&lattice.unwrap()), 480);
        let held = |node: &u32| node.is_multiple_of(7) && node % 24 % 5 < 3;
        let free: Vec<u32> = (0..nodes).filter(|node| !held(node)).collect();
        let heights: Vec<f64> = (0..nodes).map(|node| f64::from(node * node * 11 % 17)).collect();
        let (matrix, right) = plate.equations(&free, &heights);
        let low: Vec<f64> = free.iter().map(|&node| f64::from(node % 5)).collect();
        let high: Vec<f64> = low.iter().map(|low| low + 6.0).collect();
        let bounded = Bounded { matrix, right, places: plate.places(&free), low, high };
        let mut by_rounds = bounded.low.clone();
        let progress = bounded.minimise(&mut by_rounds, 1e-11, 200);
        assert!(progress.residual <= 1e-11, "{progress:?}");
        let mut by_sweeps = bounded.low.clone();
        (0..20_000).for_each(|_| bounded.sweep(&mut by_sweeps));
        let at_bounds = (0..free.len())
            .filter(|&at| by_sweeps[at] == bounded.low[at] || by_sweeps[at] == bounded.high[at]);
        assert!((20..free.len() - 20).contains(&at_bounds.count()));
        for (found, reference) in by_rounds.iter().zip(&by_sweeps) {
            assert!((found - reference).abs() < 1e-7, "{found} for {reference}");
        }
    }
}
