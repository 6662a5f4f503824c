//! Ground that rises the same way in all directions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME};
use crate::SynthError;
use crate::error::Checks;

/// A funnel without end, or a cone if it falls, of weight 1 everywhere:
/// `h = height + d tan(tilt)`, with d the distance from the centre. L is the tangent of the tilt.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RadialRamp {
    /// The centre: east and north of the south-western node.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub center_m: [f64; 2],
    /// Height of the centre.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Angle of the ground to the horizontal; negative where it falls from the centre.
    #[schemars(range(min = -89.0, max = 89.0), extend("x-unit" = "deg"))]
    pub tilt_deg: f64,
}

impl Default for RadialRamp {
    fn default() -> Self {
        Self { center_m: [0.0; 2], height_m: 0.0, tilt_deg: 10.0 }
    }
}

impl RadialRamp {
    pub(super) fn check(&self) -> Result<(), SynthError> {
        let checks = Checks(NAME);
        checks.place("center_m", self.center_m)?;
        checks.elevation("height_m", self.height_m)?;
        checks.range("tilt_deg", self.tilt_deg, -89.0..=89.0)
    }

    fn rise(&self) -> f64 {
        self.tilt_deg.to_radians().tan()
    }
}

impl Surface for RadialRamp {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let rise = self.rise();
        let height = |&[x, y]: &[f64; 2]| {
            let [east, north] = [x - self.center_m[0], y - self.center_m[1]];
            self.height_m + rise * (east * east + north * north).sqrt()
        };
        Samples::full(points.iter().map(height).collect())
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        let rise = self.rise();
        if rise == 0.0 {
            return [self.height_m; 2];
        }
        let ends = |axis: usize| {
            let [low, high] = [region.low, region.high].map(|end| end[axis] - self.center_m[axis]);
            [low.max(-high).max(0.0), (-low).max(high)]
        };
        let [x, y] = [ends(0), ends(1)];
        let heights = [0, 1].map(|end| self.height_m + rise * x[end].hypot(y[end]));
        [heights[0].min(heights[1]), heights[0].max(heights[1])]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        Bounds::full(self.range(region), self.rise().abs())
    }
}
