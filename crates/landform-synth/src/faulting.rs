//! Surfaces broken by many random faults.

use std::f64::consts::TAU;

use landform_graph::Lattice;
use landform_sim::random::RandomStream;
use rand::RngExt;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::place::offset_from;
use crate::{Generator, SynthError};

/// The course of a fault on the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum FaultTrace {
    /// A straight line through the lattice, in any direction; needs open borders.
    #[default]
    Line,
    /// A circle with half to one and a half times `radius_m`, around any node.
    Circle,
}

/// The height of a fault at a distance from its trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum FaultProfile {
    /// One side is up by 1, the other down by 1, with a smooth slope of `width_m` to either side.
    #[default]
    Step,
    /// A groove: `1 - 2 (1 - (d / width_m)^2)^2` within `width_m`, and 1 beyond.
    Groove,
}

/// The sum of many random faults (Mandelbrot 1982). Straight steps approach a Brownian surface,
/// H = 0.5, since two places are as often parted as they are far from each other.
///
/// Heights are `mean_m` plus the sum of all faults times `amplitude_m / sqrt(faults)`.
///
/// # Limits
/// 2-D only. Lines do not close on periodic axes. Cost: nodes times faults.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Faulting {
    /// Height of the surface without faults.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub mean_m: f64,
    /// Standard deviation that straight steps give at a node.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub amplitude_m: f64,
    /// Number of faults.
    #[schemars(range(min = 1, max = 10000))]
    pub faults: u32,
    /// Course of the faults.
    pub trace: FaultTrace,
    /// Mean radius of circles.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub radius_m: f64,
    /// Height beside a fault.
    pub profile: FaultProfile,
    /// Distance from the trace at which a fault has its full height.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub width_m: f64,
}

impl Default for Faulting {
    fn default() -> Self {
        Self {
            mean_m: 0.0,
            amplitude_m: 100.0,
            faults: 500,
            trace: FaultTrace::Line,
            radius_m: 500.0,
            profile: FaultProfile::Step,
            width_m: 0.0,
        }
    }
}

impl Generator for Faulting {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        self.check(lattice)?;
        let stream = RandomStream::new(seed, "faulting");
        let faults: Vec<Fault> =
            (0..self.faults as usize).map(|number| self.fault(lattice, &stream, number)).collect();
        let scale = self.amplitude_m / f64::from(self.faults).sqrt();
        let height = |node| {
            let sum: f64 = faults.iter().map(|fault| self.height(lattice, fault, node)).sum();
            self.mean_m + scale * sum
        };
        Ok((0..lattice.node_count()).into_par_iter().map(height).collect())
    }
}

/// A fault on a lattice.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// Direction to the upper side, and distance of the line from the middle of the lattice.
    Line { upper: [f64; 2], distance: f64 },
    /// Centre as shares of the lattice, radius, and 1 if the outside is the upper side, else -1.
    Circle { center: [f64; 2], radius: f64, outside: f64 },
}

impl Faulting {
    fn check(&self, lattice: &Lattice) -> Result<(), SynthError> {
        let checks = Checks("Faulting");
        checks.plane(lattice)?;
        checks.elevation("mean_m", self.mean_m)?;
        checks.length("amplitude_m", self.amplitude_m, 0.0)?;
        checks.range("faults", f64::from(self.faults), 1.0..=1e4)?;
        checks.length("radius_m", self.radius_m, 0.0)?;
        checks.length("width_m", self.width_m, 0.0)?;
        let periodic = ['x', 'y'].into_iter().enumerate().find(|(n, _)| lattice.is_periodic(*n));
        match (self.trace, periodic) {
            (FaultTrace::Line, Some((_, axis))) => {
                let remedy = "take circles, or make the axis open";
                Err(SynthError::DoesNotClose { generator: checks.0, axis, remedy })
            }
            _ => Ok(()),
        }
    }

    /// Draws a fault: all lines that meet the circle around the lattice are equally likely.
    fn fault(&self, lattice: &Lattice, stream: &RandomStream, number: usize) -> Fault {
        let mut random = stream.at(0, number);
        let [first, second, third] = [(); 3].map(|()| random.random::<f64>());
        match self.trace {
            FaultTrace::Line => {
                let (north, east) = (TAU * first).sin_cos();
                let reach = 0.5
                    * lattice.spacing()
                    * (lattice.width() as f64 - 1.0).hypot(lattice.height() as f64 - 1.0);
                Fault::Line { upper: [east, north], distance: reach * (2.0 * second - 1.0) }
            }
            FaultTrace::Circle => Fault::Circle {
                center: [first, second],
                radius: self.radius_m * (0.5 + third),
                outside: if random.random::<bool>() { 1.0 } else { -1.0 },
            },
        }
    }

    /// Height of a fault at a node, from -1 to 1.
    fn height(&self, lattice: &Lattice, fault: &Fault, node: usize) -> f64 {
        let distance = match *fault {
            Fault::Line { upper, distance } => {
                let [east, north] = offset_from(lattice, [0.5; 2], node);
                east * upper[0] + north * upper[1] - distance
            }
            Fault::Circle { center, radius, outside } => {
                let [east, north] = offset_from(lattice, center, node);
                outside * (east.hypot(north) - radius)
            }
        };
        let inside = distance.abs() < self.width_m;
        let share = distance / self.width_m;
        match (self.profile, inside) {
            (FaultProfile::Step, true) => share * (1.5 - 0.5 * share * share),
            (FaultProfile::Step, false) => distance.signum(),
            (FaultProfile::Groove, true) => 1.0 - 2.0 * (1.0 - share * share).powi(2),
            (FaultProfile::Groove, false) => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(side: usize) -> Lattice {
        Lattice::plane([side; 2], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap()
    }

    /// A line parts two places at distance t with probability t / (pi R), where R is the radius of
    /// the circle around the lattice (Crofton), and then they differ by 2.
    #[test]
    fn straight_steps_have_the_variogram_of_brownian_motion() {
        let lattice = lattice(33);
        let radius = 160.0 * 2.0_f64.sqrt();
        let faulting = Faulting { faults: 100, ..Default::default() };
        let fields: Vec<Vec<f64>> =
            (0..400).map(|seed| faulting.generate(&lattice, seed).unwrap()).collect();
        for lag in [1, 4, 16] {
            let mut squares = Vec::new();
            for field in &fields {
                let pairs = (0..33 * 33).filter(|node| node % 33 + lag < 33);
                squares.extend(pairs.map(|node| (field[node + lag] - field[node]).powi(2)));
            }
            let found = squares.iter().sum::<f64>() / squares.len() as f64;
            let distance = 10.0 * lag as f64;
            let expected = 1e4 * 4.0 * distance / (std::f64::consts::PI * radius);
            assert!((found / expected - 1.0).abs() < 0.08, "{lag}: {found}, {expected}");
        }
    }

    #[test]
    fn grooves_have_their_depth_and_width() {
        let lattice = lattice(101);
        let groove = Faulting {
            amplitude_m: 5.0,
            faults: 1,
            profile: FaultProfile::Groove,
            width_m: 100.0,
            ..Default::default()
        };
        let field = (0..20).map(|seed| groove.generate(&lattice, seed).unwrap());
        let field = field.max_by_key(|f| f.iter().filter(|h| **h < 0.0).count()).unwrap();
        let lowest = field.iter().copied().fold(5.0, f64::min);
        let highest = field.iter().copied().fold(-5.0, f64::max);
        assert!(lowest < -4.5 && highest == 5.0, "{lowest} to {highest}");
    }
}
