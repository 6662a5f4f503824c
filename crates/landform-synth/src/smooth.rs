//! Noise that is smooth over a chosen length.

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Distribution, Generator, SynthError};

/// Random hills and hollows of one size, without detail below it.
///
/// Independent random values sit on a coarse grid and are joined by uniform cubic B-splines, so
/// the field has continuous second derivatives and hardly any power at wavelengths below one
/// grid cell. Its standard deviation is the same everywhere to 4 % an axis. In volumes the
/// field varies in all three directions.
///
/// # Limits
/// A periodic axis holds a whole number of grid cells, at least four, so the correlation length
/// is rounded there to fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SmoothNoise {
    /// Mean value.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Standard deviation.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub standard_deviation_m: f64,
    /// Size of a cell of the coarse grid: about half the distance from a hill to a hollow. At
    /// least the spacing of the lattice.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub correlation_length_m: f64,
    /// How the values on the coarse grid are spread. The sum of many is close to a bell curve
    /// either way; uniform ones bound the field.
    pub distribution: Distribution,
}

impl Default for SmoothNoise {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            standard_deviation_m: 1.0,
            correlation_length_m: 100.0,
            distribution: Distribution::Gaussian,
        }
    }
}

impl Generator for SmoothNoise {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        let checks = Checks("SmoothNoise");
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("standard_deviation_m", self.standard_deviation_m, 0.0)?;
        checks.length("correlation_length_m", self.correlation_length_m, lattice.spacing())?;
        let splines = [0, 1, 2].map(|axis| Spline::new(lattice, axis, self.correlation_length_m));
        let controls = splines.iter().map(|spline| spline.controls).product::<usize>();
        let stream = RandomStream::new(seed, "smooth noise");
        let controls: Vec<f64> = (0..controls)
            .into_par_iter()
            .map(|index| self.distribution.draw(&stream, index))
            .collect();
        let spread: f64 = splines.iter().map(Spline::standard_deviation).product();
        let scale = self.standard_deviation_m / (spread * self.distribution.standard_deviation());
        Ok((0..lattice.node_count())
            .into_par_iter()
            .map(|node| {
                let noise = interpolate(&splines, &controls, lattice.coordinates(node));
                self.mean_m + scale * noise
            })
            .collect())
    }
}

/// Value of the spline surface at a node.
fn interpolate([x, y, z]: &[Spline; 3], controls: &[f64], node: [usize; 3]) -> f64 {
    let [along_x, along_y, along_z] = [&x.taps[node[0]], &y.taps[node[1]], &z.taps[node[2]]];
    let mut sum = 0.0;
    for (layer, layer_weight) in along_z.iter() {
        for (row, row_weight) in along_y.iter() {
            let start = x.controls * (row + y.controls * layer);
            let line: f64 = along_x.iter().map(|(i, weight)| weight * controls[start + i]).sum();
            sum += layer_weight * row_weight * line;
        }
    }
    sum
}

/// The control values that a node depends on along one axis, with their weights.
#[derive(Clone, Debug)]
struct Taps {
    controls: [usize; 4],
    weights: [f64; 4],
    used: usize,
}

impl Taps {
    fn iter(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.controls.iter().copied().zip(self.weights).take(self.used)
    }
}

/// A uniform cubic B-spline along one axis.
#[derive(Debug)]
struct Spline {
    controls: usize,
    taps: Vec<Taps>,
}

impl Spline {
    fn new(lattice: &Lattice, axis: usize, length: f64) -> Self {
        let nodes = lattice.size()[axis];
        if nodes == 1 {
            let alone = Taps { controls: [0; 4], weights: [1.0, 0.0, 0.0, 0.0], used: 1 };
            return Self { controls: 1, taps: vec![alone] };
        }
        let cells_a_node = lattice.spacing() / length;
        if lattice.is_periodic(axis) {
            let cells = (nodes as f64 * cells_a_node).round().max(4.0) as usize;
            let scale = cells as f64 / nodes as f64;
            let wrap = |control: usize| control % cells;
            Self { controls: cells, taps: taps(nodes, scale, wrap) }
        } else {
            let cells = ((nodes - 1) as f64 * cells_a_node).floor() as usize + 1;
            Self { controls: cells + 3, taps: taps(nodes, cells_a_node, |control| control) }
        }
    }

    /// Standard deviation along the axis for control values of standard deviation 1: the mean
    /// sum of squared weights is 151/315.
    fn standard_deviation(&self) -> f64 {
        if self.controls == 1 { 1.0 } else { (151.0 / 315.0_f64).sqrt() }
    }
}

fn taps(nodes: usize, cells_a_node: f64, number: impl Fn(usize) -> usize) -> Vec<Taps> {
    (0..nodes)
        .map(|node| {
            let place = node as f64 * cells_a_node;
            let cell = place.floor() as usize;
            let controls = [0, 1, 2, 3].map(|tap| number(cell + tap));
            Taps { controls, weights: cubic_weights(place.fract()), used: 4 }
        })
        .collect()
}

/// Weights of the four control values around a place between the second and the third.
fn cubic_weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    let outer = |u: f64| u * u * u / 6.0;
    let inner = |u: f64| (4.0 + u * u * (3.0 * u - 6.0)) / 6.0;
    [outer(s), inner(t), inner(s), outer(t)]
}
