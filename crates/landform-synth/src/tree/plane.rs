//! Landforms that are everywhere: planes and bells.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME};
use crate::SynthError;
use crate::error::Checks;

/// A plane of weight 1 everywhere. L is the tangent of the tilt.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plane {
    /// Height at `at_m`.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// A place on the plane: east and north of the south-western node.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub at_m: [f64; 2],
    /// Angle of the plane to the horizontal.
    #[schemars(range(min = 0.0, max = 89.0), extend("x-unit" = "deg"))]
    pub tilt_deg: f64,
    /// Direction in which the plane rises, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub uphill_deg: f64,
}

impl Default for Plane {
    fn default() -> Self {
        Self { height_m: 0.0, at_m: [0.0; 2], tilt_deg: 0.0, uphill_deg: 90.0 }
    }
}

/// A plane made ready.
#[derive(Debug)]
pub(super) struct PlaneSurface {
    height: f64,
    at: [f64; 2],
    /// Rise a metre to the east and to the north.
    rise: [f64; 2],
}

impl PlaneSurface {
    pub fn new(plane: &Plane) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.elevation("height_m", plane.height_m)?;
        checks.place("at_m", plane.at_m)?;
        checks.range("tilt_deg", plane.tilt_deg, 0.0..=89.0)?;
        checks.range("uphill_deg", plane.uphill_deg, -360.0..=360.0)?;
        let steepness = plane.tilt_deg.to_radians().tan();
        let (north, east) = plane.uphill_deg.to_radians().sin_cos();
        // A right angle in degrees is not quite one in radians.
        let rise =
            [east, north].map(|share| if share.abs() < 1e-12 { 0.0 } else { steepness * share });
        Ok(Self { height: plane.height_m, at: plane.at_m, rise })
    }

    /// Level ground.
    pub fn level(height: f64) -> Self {
        Self { height, at: [0.0; 2], rise: [0.0; 2] }
    }
}

impl Surface for PlaneSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let [east, north] = self.rise;
        let height =
            |&[x, y]: &[f64; 2]| self.height + (east * (x - self.at[0]) + north * (y - self.at[1]));
        Samples::full(points.iter().map(height).collect())
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        let risen = region.moved(self.at.map(|x| -x)).turned([self.rise, [0.0; 2]]);
        [self.height + risen.low[0], self.height + risen.high[0]]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        Bounds::full(self.range(region), self.rise[0].hypot(self.rise[1]))
    }
}

/// A hill with the profile of a bell curve, of weight 1 everywhere, so that it can be added to
/// others: `h = height exp(-(d / radius)^2 / 2)`. L is `|height| exp(-1/2) / radius`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Bell {
    /// Place of the top: east and north of the south-western node.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub center_m: [f64; 2],
    /// Height of the top above 0, which it approaches far away; negative for a hollow.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub height_m: f64,
    /// Distance from the top to where 61 % of the height is left (one standard deviation).
    #[schemars(range(min = 1e-9, max = 1e12), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for Bell {
    fn default() -> Self {
        Self { center_m: [0.0; 2], height_m: 50.0, radius_m: 100.0 }
    }
}

impl Bell {
    pub(super) fn check(&self) -> Result<(), SynthError> {
        let checks = Checks(NAME);
        checks.place("center_m", self.center_m)?;
        checks.elevation("height_m", self.height_m)?;
        checks.length("radius_m", self.radius_m, 1e-9)
    }
}

impl Surface for Bell {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let height = |&[x, y]: &[f64; 2]| {
            let [east, north] = [x - self.center_m[0], y - self.center_m[1]];
            let squared = (east * east + north * north) / (self.radius_m * self.radius_m);
            self.height_m * (-0.5 * squared).exp()
        };
        Samples::full(points.iter().map(height).collect())
    }

    fn range(&self, _region: &Region) -> [f64; 2] {
        [self.height_m.min(0.0), self.height_m.max(0.0)]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        Bounds::full(self.range(region), self.height_m.abs() * (-0.5_f64).exp() / self.radius_m)
    }
}
