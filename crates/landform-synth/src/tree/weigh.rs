//! Other weights.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bounds::times;
use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME, Node};
use crate::SynthError;
use crate::error::Checks;

/// A node with its weight multiplied; the elevation stays. A and the weights are multiplied,
/// L stays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weigh {
    /// The node.
    pub of: Box<Node>,
    /// What its weight is multiplied with.
    #[serde(default = "one")]
    #[schemars(range(min = 0.0, max = 1e6))]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

/// A node with another weight, made ready.
#[derive(Debug)]
pub(super) struct WeighSurface {
    of: Box<dyn Surface>,
    weight: f64,
}

impl WeighSurface {
    pub fn new(weigh: &Weigh, of: Box<dyn Surface>) -> Result<Self, SynthError> {
        Checks(NAME).range("weight", weigh.weight, 0.0..=1e6)?;
        Ok(Self { of, weight: weigh.weight })
    }
}

impl Surface for WeighSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut samples = self.of.sample(points);
        samples.weight.iter_mut().for_each(|weight| *weight *= self.weight);
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
        let weight = of.weight.map(|weight| weight * self.weight);
        let faded = times(of.slope, weight[1].min(1.0));
        Bounds {
            weight,
            faded_slope: faded.min(times(of.faded_slope, self.weight.max(1.0))),
            weight_slope: times(of.weight_slope, self.weight),
            ..of
        }
    }
}
