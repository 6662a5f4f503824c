//! Noise as a landform.

use super::Bounds;
use super::region::Region;
use super::surface::{Samples, Surface};
use crate::fractal::{NoiseSurface, Scratch};

impl Surface for NoiseSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut elevation = vec![0.0; points.len()];
        self.heights(&mut points.to_vec(), &mut Scratch::new(points.len()), &mut elevation);
        Samples::full(elevation)
    }

    fn range(&self, _region: &Region) -> [f64; 2] {
        self.bound().range
    }

    fn bounds(&self, _region: &Region) -> Bounds {
        let bound = self.bound();
        Bounds::full(bound.range, bound.slope)
    }
}
