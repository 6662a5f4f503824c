//! Other weights.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bounds::times;
use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME, Node};
use crate::error::Checks;
use crate::mask::MaskSurface;
use crate::{Mask, SynthError};

/// A node with its weight multiplied; the elevation stays. L stays; A is multiplied with the
/// factor's greatest value, and grows by the weight times the factor's slope where that is a mask.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weigh {
    /// The node.
    pub of: Box<Node>,
    /// What its weight is multiplied with.
    #[serde(default = "one")]
    #[schemars(range(min = 0.0, max = 1e6))]
    pub weight: f64,
    /// A mask that it is multiplied with besides, with values from 0 to 1.
    #[serde(default)]
    pub mask: Option<Mask>,
}

fn one() -> f64 {
    1.0
}

/// A node with another weight, made ready.
#[derive(Debug)]
pub(super) struct WeighSurface {
    of: Box<dyn Surface>,
    weight: f64,
    mask: Option<MaskSurface>,
}

impl WeighSurface {
    pub fn new(
        weight: f64,
        mask: Option<MaskSurface>,
        of: Box<dyn Surface>,
    ) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.range("weight", weight, 0.0..=1e6)?;
        if let Some([least, most]) = mask.as_ref().map(MaskSurface::range) {
            checks.range("mask.outside", least, 0.0..=1.0)?;
            checks.range("mask.inside", most, 0.0..=1.0)?;
        }
        Ok(Self { of, weight, mask })
    }
}

impl Surface for WeighSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut samples = self.of.sample(points);
        samples.weight.iter_mut().for_each(|weight| *weight *= self.weight);
        if let Some(mask) = &self.mask {
            let weights = samples.weight.iter_mut().zip(points);
            weights.for_each(|(weight, &point)| *weight *= mask.at(point));
        }
        samples
    }

    fn support(&self) -> Region {
        self.of.support()
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        self.of.range(region)
    }

    fn bounds(&self, region: &Region) -> Bounds {
        let of = self.of.bounds(region);
        let ([least, most], mask_slope) = match &self.mask {
            Some(mask) => (mask.range(), mask.slope()),
            None => ([1.0; 2], 0.0),
        };
        let factor = [least * self.weight, most * self.weight];
        let weight = [of.weight[0] * factor[0], of.weight[1] * factor[1]];
        let faded = times(of.slope, weight[1].min(1.0));
        let changes = times(mask_slope * self.weight, of.weight[1]);
        Bounds {
            weight,
            faded_slope: faded.min(times(of.faded_slope, factor[1].max(1.0))),
            weight_slope: times(of.weight_slope, factor[1]) + changes,
            ..of
        }
    }
}
