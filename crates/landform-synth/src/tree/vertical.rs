//! Heights changed by a function of the height: vertical deformation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bounds::times;
use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME, Node};
use crate::SynthError;
use crate::error::{Checks, check_steps};

/// A node with its heights changed, `h' = v(h)`. L is multiplied with the steepest slope of v
/// between the least and the greatest height of the node.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Deform {
    /// The node.
    pub of: Box<Node>,
    /// The function of the height.
    pub by: VerticalMap,
}

/// A function of the height.
///
/// Glaciation and canyonism change the hypsometry of a terrain profoundly and its spectrum
/// hardly, since they scale heights here and there and flatten little (thesis, section 4.4.5,
/// figure 4.23).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum VerticalMap {
    /// Straight lines through `(height, new height)`, of which the first numbers increase. Heights
    /// below the first and above the last change as these do.
    Through(Vec<[f64; 2]>),
    /// Steps with level treads.
    Terraces(Terraces),
    /// Erosion of low ground: of the share `t` of the way from `low_m` to `high_m`,
    /// `t^exponent` is left. Valleys widen and peaks stand out; `low_m` is the deepest floor.
    Glaciation(SelectiveScaling),
    /// Its mirror image: `1 - (1 - t)^exponent`. High ground rises towards `high_m`, a plateau,
    /// and valleys become canyons: the hypsometric curve turns convex.
    Canyonism(SelectiveScaling),
}

/// Terraces: heights within a step gather on its tread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Terraces {
    /// Height of a step.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub step_m: f64,
    /// Height of a tread.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub tread_m: f64,
    /// Share of the ground below a step's height that is a riser: 1 changes nothing, small
    /// shares make cliffs. The riser is the reciprocal times steeper than the ground was.
    #[schemars(range(min = 0.01, max = 1.0))]
    pub riser: f64,
}

impl Default for Terraces {
    fn default() -> Self {
        Self { step_m: 50.0, tread_m: 0.0, riser: 0.3 }
    }
}

/// Heights scaled more or less, depending on how high they are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SelectiveScaling {
    /// Height of the lowest ground, about; it stays.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub low_m: f64,
    /// Height of the highest ground, about, above `low_m`; it stays.
    #[schemars(range(min = -1e12, max = 1e12), extend("x-unit" = "m"))]
    pub high_m: f64,
    /// How strong: 1 changes nothing.
    #[schemars(range(min = 1.0, max = 10.0))]
    pub exponent: f64,
}

impl Default for SelectiveScaling {
    fn default() -> Self {
        Self { low_m: -100.0, high_m: 100.0, exponent: 2.0 }
    }
}

impl SelectiveScaling {
    fn check(&self) -> Result<(), SynthError> {
        let checks = Checks(NAME);
        checks.elevation("low_m", self.low_m)?;
        checks.range("high_m", self.high_m, self.low_m + 1e-6..=1e12)?;
        checks.range("exponent", self.exponent, 1.0..=10.0)
    }

    /// Share of the way up.
    fn share(&self, height: f64) -> f64 {
        (height - self.low_m) / (self.high_m - self.low_m)
    }

    /// `t^exponent`, level below and straight above.
    fn lowered(&self, share: f64) -> f64 {
        match share {
            below if below < 0.0 => 0.0,
            above if above > 1.0 => 1.0 + self.exponent * (above - 1.0),
            share => share.powf(self.exponent),
        }
    }

    /// Steepest slope of `t^exponent` up to a share.
    fn steepest(&self, share: f64) -> f64 {
        self.exponent * share.clamp(0.0, 1.0).powf(self.exponent - 1.0)
    }
}

impl VerticalMap {
    pub(super) fn check(&self) -> Result<(), SynthError> {
        match self {
            Self::Through(points) => {
                check_steps(NAME, "by", points, 2)?;
                let checks = Checks(NAME);
                points.iter().try_for_each(|point| checks.place("by", *point))
            }
            Self::Terraces(Terraces { step_m, tread_m, riser }) => {
                let checks = Checks(NAME);
                checks.length("step_m", *step_m, 1e-6)?;
                checks.elevation("tread_m", *tread_m)?;
                checks.range("riser", *riser, 0.01..=1.0)
            }
            Self::Glaciation(scaling) | Self::Canyonism(scaling) => scaling.check(),
        }
    }

    /// The new height.
    fn at(&self, height: f64) -> f64 {
        match self {
            Self::Through(points) => {
                let next = points.partition_point(|point| point[0] < height);
                match (next.checked_sub(1), points.get(next)) {
                    (Some(last), Some(&[to, high])) => {
                        let [from, low] = points[last];
                        low + (height - from) / (to - from) * (high - low)
                    }
                    (None, Some([to, high])) => height - to + high,
                    (Some(last), None) => height - points[last][0] + points[last][1],
                    (None, None) => height,
                }
            }
            Self::Terraces(Terraces { step_m, tread_m, riser }) => {
                let steps = (height - tread_m) / step_m;
                let climbed = ((steps - steps.floor() - (1.0 - riser)) / riser).max(0.0);
                tread_m + step_m * (steps.floor() + climbed)
            }
            Self::Glaciation(scaling) => {
                let SelectiveScaling { low_m, high_m, .. } = scaling;
                low_m + (high_m - low_m) * scaling.lowered(scaling.share(height))
            }
            Self::Canyonism(scaling) => {
                let SelectiveScaling { low_m, high_m, .. } = scaling;
                high_m - (high_m - low_m) * scaling.lowered(1.0 - scaling.share(height))
            }
        }
    }

    /// Least and greatest of the new heights of a range. All but `Through` never fall, and that
    /// turns at its points only.
    fn range(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        let mut range = [self.end(low), self.end(high)];
        if range[0] > range[1] {
            range.reverse();
        }
        if let Self::Through(points) = self {
            for &[_, new] in points.iter().filter(|point| (low..high).contains(&point[0])) {
                range = [range[0].min(new), range[1].max(new)];
            }
        }
        range
    }

    /// The new height of an end of a range, which may be infinite.
    fn end(&self, height: f64) -> f64 {
        match (self, height.is_finite()) {
            (_, true) => self.at(height),
            (Self::Glaciation(scaling), false) if height < 0.0 => scaling.low_m,
            (Self::Canyonism(scaling), false) if height > 0.0 => scaling.high_m,
            (_, false) => height,
        }
    }

    /// Steepest slope over a range of heights.
    fn steepest(&self, [low, high]: [f64; 2]) -> f64 {
        match self {
            Self::Through(points) => {
                let beyond = low < points[0][0] || high > points[points.len() - 1][0];
                let pieces = points.windows(2).filter(|pair| pair[0][0] < high && pair[1][0] > low);
                pieces
                    .map(|pair| ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs())
                    .fold(if beyond { 1.0 } else { 0.0 }, f64::max)
            }
            Self::Terraces(Terraces { riser, .. }) => 1.0 / riser,
            Self::Glaciation(scaling) => scaling.steepest(scaling.share(high)),
            Self::Canyonism(scaling) => scaling.steepest(1.0 - scaling.share(low)),
        }
    }
}

/// A node with its heights changed, made ready.
#[derive(Debug)]
pub(super) struct DeformSurface {
    pub of: Box<dyn Surface>,
    pub by: VerticalMap,
}

impl Surface for DeformSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut samples = self.of.sample(points);
        samples.elevation.iter_mut().for_each(|height| *height = self.by.at(*height));
        samples
    }

    fn support(&self) -> Region {
        self.of.support()
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        self.by.range(self.of.range(region))
    }

    fn bounds(&self, region: &Region) -> Bounds {
        let of = self.of.bounds(region);
        let steepest = self.by.steepest(of.elevation_m);
        Bounds {
            elevation_m: self.by.range(of.elevation_m),
            slope: times(of.slope, steepest),
            faded_slope: times(of.faded_slope, steepest),
            ..of
        }
    }
}
