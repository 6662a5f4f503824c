//! What all nodes of a tree have in common once they are made ready.

use std::fmt::Debug;

use super::Bounds;
use super::region::Region;

/// A node with its children: elevation and weight as functions of the place.
pub(super) trait Surface: Debug + Send + Sync {
    /// Elevation and weight at points in metres. Where the weight is 0 the elevation is some
    /// finite number without meaning.
    fn sample(&self, points: &[[f64; 2]]) -> Samples;

    /// A rectangle outside of which the weight is 0.
    fn support(&self) -> Region {
        Region::EVERYWHERE
    }

    /// Least and greatest elevation where there is weight in a region: as in
    /// [`Surface::bounds`], for less work.
    fn range(&self, region: &Region) -> [f64; 2];

    /// What is known of both in a region that is not empty.
    fn bounds(&self, region: &Region) -> Bounds;
}

/// Elevations in metres and weights, one each for every point.
#[derive(Debug)]
pub(super) struct Samples {
    pub elevation: Vec<f64>,
    pub weight: Vec<f64>,
}

impl Samples {
    /// Elevations of weight 1.
    pub fn full(elevation: Vec<f64>) -> Self {
        let weight = vec![1.0; elevation.len()];
        Self { elevation, weight }
    }

    /// Zeros for `count` points.
    pub fn none(count: usize) -> Self {
        Self { elevation: vec![0.0; count], weight: vec![0.0; count] }
    }
}

/// The share that fades from 1 at a centre or a curve to 0 at `radius`: `(1 - x^2 / r^2)^3`.
pub(super) fn falloff(distance_squared: f64, radius: f64) -> f64 {
    let left = 1.0 - distance_squared / (radius * radius);
    if left > 0.0 { left * left * left } else { 0.0 }
}

/// Steepest slope of [`falloff`], at `x = r / sqrt 5`.
pub(super) fn falloff_slope(radius: f64) -> f64 {
    6.0 / 5.0_f64.sqrt() * 0.64 / radius
}
