//! Landforms moved, turned and scaled.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME, Node};
use crate::SynthError;
use crate::error::Checks;

/// A node moved to another place: its origin comes to lie at `at_m`, around which it is turned
/// and scaled. Heights stay. L and A are divided by the scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The node.
    pub of: Box<Node>,
    /// Where its origin comes to lie: east and north of the origin.
    #[serde(default)]
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub at_m: [f64; 2],
    /// Angle by which it is turned, counter-clockwise.
    #[serde(default)]
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub turn_deg: f64,
    /// Horizontal lengths over what they were.
    #[serde(default = "one")]
    #[schemars(range(min = 1e-3, max = 1e3))]
    pub scale: f64,
}

fn one() -> f64 {
    1.0
}

/// A node at its place, made ready.
#[derive(Debug)]
pub(super) struct PlaceSurface {
    of: Box<dyn Surface>,
    at: [f64; 2],
    scale: f64,
    /// Sine and cosine of the angle, over the scale.
    turn: [f64; 2],
}

impl PlaceSurface {
    pub fn new(place: &Place, of: Box<dyn Surface>) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.place("at_m", place.at_m)?;
        checks.range("turn_deg", place.turn_deg, -360.0..=360.0)?;
        checks.range("scale", place.scale, 1e-3..=1e3)?;
        let (sine, cosine) = place.turn_deg.to_radians().sin_cos();
        let turn = [sine, cosine].map(|part| part / place.scale);
        Ok(Self { of, at: place.at_m, scale: place.scale, turn })
    }
}

impl PlaceSurface {
    /// Where a region was before.
    fn back(&self, region: &Region) -> Region {
        let [sine, cosine] = self.turn;
        region.moved(self.at.map(|x| -x)).turned([[cosine, sine], [-sine, cosine]])
    }
}

impl Surface for PlaceSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let [sine, cosine] = self.turn;
        let back = |&[x, y]: &[f64; 2]| {
            let [east, north] = [x - self.at[0], y - self.at[1]];
            [cosine * east + sine * north, cosine * north - sine * east]
        };
        self.of.sample(&points.iter().map(back).collect::<Vec<_>>())
    }

    fn support(&self) -> Region {
        let [sine, cosine] = self.turn.map(|part| part * self.scale * self.scale);
        self.of.support().turned([[cosine, -sine], [sine, cosine]]).moved(self.at)
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        self.of.range(&self.back(region))
    }

    fn bounds(&self, region: &Region) -> Bounds {
        self.of.bounds(&self.back(region)).steepened(1.0 / self.scale)
    }
}
