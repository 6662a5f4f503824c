//! Masks as landforms.

use super::Bounds;
use super::region::Region;
use super::surface::{Samples, Surface};
use crate::mask::MaskSurface;

impl Surface for MaskSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        Samples::full(points.iter().map(|&point| self.at(point)).collect())
    }

    fn range(&self, _region: &Region) -> [f64; 2] {
        MaskSurface::range(self)
    }

    fn bounds(&self, _region: &Region) -> Bounds {
        Bounds::full(MaskSurface::range(self), self.slope())
    }
}
