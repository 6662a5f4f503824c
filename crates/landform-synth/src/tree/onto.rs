//! One landform laid onto another.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bounds::times;
use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, Node};

/// A node and another one that changes it where that has weight. The weight is that of `ground`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Onto {
    /// What is changed.
    pub ground: Box<Node>,
    /// What changes it, as far as its weight goes; weights above 1 count as 1.
    pub by: Box<Node>,
}

/// How the two meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meeting {
    Replace,
    Add,
    Carve,
    Raise,
}

impl Meeting {
    /// The elevation where `by` has the weight `share`.
    fn meet(self, ground: f64, by: f64, share: f64) -> f64 {
        match self {
            Self::Replace => (1.0 - share) * ground + share * by,
            Self::Add => ground + share * by,
            Self::Carve => ground - share * (ground - by).max(0.0),
            Self::Raise => ground + share * (by - ground).max(0.0),
        }
    }

    /// Least and greatest elevation that can come out where `by` has weights up to `weight`.
    fn range(self, ground: [f64; 2], by: [f64; 2]) -> [f64; 2] {
        let [least, most] = [0, 1].map(|end| [ground[end], by[end]]);
        match self {
            Self::Replace => [least[0].min(least[1]), most[0].max(most[1])],
            Self::Add => [least[0] + least[1].min(0.0), most[0] + most[1].max(0.0)],
            Self::Carve => [least[0].min(least[1]), most[0]],
            Self::Raise => [least[0], most[0].max(most[1])],
        }
    }

    /// Largest change of the elevation that a full share makes.
    fn change(self, ground: [f64; 2], by: [f64; 2]) -> f64 {
        let [down, up] = [ground[1] - by[0], by[1] - ground[0]];
        match self {
            Self::Replace => down.max(up),
            Self::Add => by[0].abs().max(by[1].abs()),
            Self::Carve => down.max(0.0),
            Self::Raise => up.max(0.0),
        }
    }
}

/// Both made ready.
#[derive(Debug)]
pub(super) struct OntoSurface {
    pub meeting: Meeting,
    pub ground: Box<dyn Surface>,
    pub by: Box<dyn Surface>,
}

impl Surface for OntoSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut ground = self.ground.sample(points);
        let by = self.by.sample(points);
        let change = by.elevation.iter().zip(&by.weight);
        for (height, (&other, &weight)) in ground.elevation.iter_mut().zip(change) {
            *height = self.meeting.meet(*height, other, weight.min(1.0));
        }
        ground
    }

    fn support(&self) -> Region {
        self.ground.support()
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        let ground = self.ground.range(region);
        let shared = self.by.support().intersection(region);
        if shared.is_empty() {
            return ground;
        }
        // The ground is asked once: twice on every level would take forever in deep trees.
        let met = self.meeting.range(ground, self.by.range(&shared));
        [ground[0].min(met[0]), ground[1].max(met[1])]
    }

    fn bounds(&self, region: &Region) -> Bounds {
        let ground = self.ground.bounds(region);
        let shared = self.by.support().intersection(region);
        if shared.is_empty() {
            return ground;
        }
        self.met(&ground, self.ground.range(&shared), &self.by.bounds(&shared))
    }
}

impl OntoSurface {
    /// Bounds of two that meet: the slope of `(1 - b) h + b k` is at most that of the steeper one,
    /// or of `h` plus the faded one of `k`; and the share `b` changes over the difference in
    /// height. `below` is the range of the ground where `by` has weight.
    fn met(&self, ground: &Bounds, below: [f64; 2], by: &Bounds) -> Bounds {
        let together = ground.slope + by.faded_slope;
        let slopes = match self.meeting {
            Meeting::Add => together,
            _ => ground.slope.max(by.slope).min(together),
        };
        let change = times(self.meeting.change(below, by.elevation_m), by.weight_slope);
        let slope = slopes + change;
        let faded = ground.faded_slope + by.faded_slope + change;
        let met = self.meeting.range(below, by.elevation_m);
        let [low, high] = match by.weight[0] {
            least if least >= 1.0 && self.meeting == Meeting::Replace => by.elevation_m,
            _ => [ground.elevation_m[0].min(met[0]), ground.elevation_m[1].max(met[1])],
        };
        Bounds {
            elevation_m: [low, high],
            weight: ground.weight,
            slope,
            faded_slope: times(slope, ground.weight[1].min(1.0)).min(faded),
            weight_slope: ground.weight_slope,
        }
    }
}
