//! Least of a quadratic energy between bounds, by conjugate gradients.

use rayon::prelude::*;

/// Values of a dot product that are added up one after the other, so that sums have the same bits
/// on any number of threads.
const CHUNK: usize = 4096;

/// A quadratic energy `x A x / 2` on the nodes of a lattice.
pub(super) trait Energy: Sync {
    /// Writes `A x`.
    fn gradient(&self, x: &[f64], gradient: &mut [f64]);
    /// A number that no eigenvalue of `A` exceeds.
    fn largest_eigenvalue(&self) -> f64;
}

/// Bounds of each value; equal ones hold a value fast.
pub(super) struct Bounds {
    pub low: Vec<f64>,
    pub high: Vec<f64>,
}

/// Lowers the energy of `x` between bounds until the projected gradient has fallen below
/// `tolerance` times what it was, or for `most` steps. Returns the number of steps.
///
/// Method: conjugate gradients on the values between their bounds, with a projected step where
/// one meets its bound, and a step along the chopped gradient where bounds hold values back that
/// want to leave them (modified proportioning with reduced gradient projections, Dostal and
/// Schoeberl 2005). `x` must lie between the bounds and does at every step.
pub(super) fn minimise(
    energy: &impl Energy,
    bounds: &Bounds,
    x: &mut [f64],
    tolerance: f64,
    most: usize,
) -> usize {
    let mut state = State::new(energy, bounds, x);
    let enough = tolerance * state.projected_gradient().sqrt();
    for step in 0..most {
        if state.projected_gradient().sqrt() <= enough {
            return step;
        }
        state.step();
    }
    most
}

struct State<'a, E> {
    energy: &'a E,
    bounds: &'a Bounds,
    x: &'a mut [f64],
    gradient: Vec<f64>,
    direction: Vec<f64>,
    /// `A` times the direction.
    image: Vec<f64>,
    /// Length of steps along the gradient.
    stride: f64,
}

impl<'a, E: Energy> State<'a, E> {
    fn new(energy: &'a E, bounds: &'a Bounds, x: &'a mut [f64]) -> Self {
        let mut gradient = vec![0.0; x.len()];
        energy.gradient(x, &mut gradient);
        let stride = 1.9 / energy.largest_eigenvalue();
        let [direction, image] = [(); 2].map(|()| vec![0.0; x.len()]);
        let mut state = Self { energy, bounds, x, gradient, direction, image, stride };
        state.restart();
        state
    }

    /// Part of the gradient along which a value is free to move: all of it between the bounds.
    #[inline]
    fn free(&self, node: usize) -> f64 {
        let inside = self.x[node] > self.bounds.low[node] && self.x[node] < self.bounds.high[node];
        if inside { self.gradient[node] } else { 0.0 }
    }

    /// Part of the gradient that takes a value off its bound.
    #[inline]
    fn chopped(&self, node: usize) -> f64 {
        let [low, high] = [self.bounds.low[node], self.bounds.high[node]];
        let (x, gradient) = (self.x[node], self.gradient[node]);
        match (x <= low, x >= high) {
            (true, true) | (false, false) => 0.0,
            (true, false) => gradient.min(0.0),
            (false, true) => gradient.max(0.0),
        }
    }

    /// The free gradient, no longer than the next bound allows.
    #[inline]
    fn reduced(&self, node: usize) -> f64 {
        let x = self.x[node];
        let [down, up] = [x - self.bounds.low[node], self.bounds.high[node] - x];
        self.free(node).clamp(-up / self.stride, down / self.stride)
    }

    fn sum(&self, term: impl Fn(usize) -> f64 + Sync) -> f64 {
        ordered_sum(self.x.len(), term)
    }

    fn projected_gradient(&self) -> f64 {
        self.sum(|node| (self.free(node) + self.chopped(node)).powi(2))
    }

    /// Searches along the free gradient from here.
    fn restart(&mut self) {
        let mut direction = std::mem::take(&mut self.direction);
        direction.par_iter_mut().enumerate().for_each(|(node, d)| *d = self.free(node));
        self.direction = direction;
    }

    fn step(&mut self) {
        let chopped = self.sum(|node| self.chopped(node).powi(2));
        let proportional = self.sum(|node| self.reduced(node) * self.free(node));
        if chopped <= proportional {
            self.conjugate_step();
        } else {
            self.release_step();
        }
    }

    /// A step of conjugate gradients; cut short and followed by a projected one at a bound.
    fn conjugate_step(&mut self) {
        self.energy.gradient(&self.direction, &mut self.image);
        let bend = self.sum(|node| self.direction[node] * self.image[node]);
        let slope = self.sum(|node| self.gradient[node] * self.direction[node]);
        let feasible = self.feasible();
        // A direction without bend is one along which nothing changes.
        let best = if bend > 0.0 { slope / bend } else { feasible };
        if best <= feasible {
            self.advance(best);
            let turned = self.sum(|node| self.free(node) * self.image[node]);
            let keep = if bend > 0.0 { turned / bend } else { 0.0 };
            let mut direction = std::mem::take(&mut self.direction);
            let turn = |(node, d): (usize, &mut f64)| *d = self.free(node) - keep * *d;
            direction.par_iter_mut().enumerate().for_each(turn);
            self.direction = direction;
        } else {
            self.advance(feasible);
            self.project();
        }
    }

    /// A step that takes values off their bounds.
    fn release_step(&mut self) {
        let mut direction = std::mem::take(&mut self.direction);
        direction.par_iter_mut().enumerate().for_each(|(node, d)| *d = self.chopped(node));
        self.direction = direction;
        self.energy.gradient(&self.direction, &mut self.image);
        let bend = self.sum(|node| self.direction[node] * self.image[node]);
        let slope = self.sum(|node| self.gradient[node] * self.direction[node]);
        let feasible = self.feasible();
        self.advance(if bend > 0.0 { (slope / bend).min(feasible) } else { feasible });
        self.restart();
    }

    /// How far the direction can be followed before a value meets its bound.
    fn feasible(&self) -> f64 {
        let room = |node: usize| {
            let direction = self.direction[node];
            let x = self.x[node];
            match direction.total_cmp(&0.0) {
                std::cmp::Ordering::Greater => (x - self.bounds.low[node]) / direction,
                std::cmp::Ordering::Less if direction < 0.0 => {
                    (x - self.bounds.high[node]) / direction
                }
                _ => f64::INFINITY,
            }
        };
        (0..self.x.len()).into_par_iter().map(room).reduce(|| f64::INFINITY, f64::min)
    }

    /// Follows the direction downhill, and keeps between the bounds what rounding took out.
    fn advance(&mut self, length: f64) {
        let (low, high) = (&self.bounds.low, &self.bounds.high);
        let direction = &self.direction;
        self.x.par_iter_mut().enumerate().for_each(|(node, x)| {
            *x = (*x - length * direction[node]).clamp(low[node], high[node]);
        });
        let image = &self.image;
        let move_on = |(node, gradient): (usize, &mut f64)| *gradient -= length * image[node];
        self.gradient.par_iter_mut().enumerate().for_each(move_on);
    }

    /// A step along the free gradient, cut at the bounds, and a fresh start.
    fn project(&mut self) {
        self.restart();
        let (low, high, stride) = (&self.bounds.low, &self.bounds.high, self.stride);
        let direction = &self.direction;
        self.x.par_iter_mut().enumerate().for_each(|(node, x)| {
            *x = (*x - stride * direction[node]).clamp(low[node], high[node]);
        });
        self.energy.gradient(self.x, &mut self.gradient);
        self.restart();
    }
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
    use super::*;

    /// A string under bounds: `A` is the second difference with fixed ends.
    struct Chain;

    impl Energy for Chain {
        fn gradient(&self, x: &[f64], gradient: &mut [f64]) {
            for node in 0..x.len() {
                let [before, after] = [node.wrapping_sub(1), node + 1]
                    .map(|next| x.get(next).copied().unwrap_or(0.0));
                gradient[node] = 2.0 * x[node] - before - after;
            }
        }

        fn largest_eigenvalue(&self) -> f64 {
            4.0
        }
    }

    /// A string over an obstacle is straight from its ends to the obstacle.
    #[test]
    fn a_string_over_a_peg_is_straight() {
        let nodes = 101;
        let mut low = vec![-1.0_f64; nodes];
        low[30] = 6.0;
        let high = vec![10.0; nodes];
        let mut x: Vec<f64> = low.iter().map(|low| low.max(3.0)).collect();
        let steps = minimise(&Chain, &Bounds { low, high }, &mut x, 1e-10, 5000);
        assert!(steps < 5000, "{steps}");
        for (node, x) in x.iter().enumerate() {
            let exact = match node {
                0..=30 => 6.0 * (node + 1) as f64 / 31.0,
                _ => 6.0 * (nodes - node) as f64 / 71.0,
            };
            assert!((x - exact).abs() < 1e-6, "{x} for {exact} at {node}");
        }
    }

    #[test]
    fn values_that_are_held_fast_stay() {
        let fixed = vec![1.0, 2.0, 3.0];
        let bounds = Bounds { low: fixed.clone(), high: fixed.clone() };
        let mut x = fixed.clone();
        assert_eq!(minimise(&Chain, &bounds, &mut x, 1e-6, 10), 0);
        assert_eq!(x, fixed);
    }
}
