//! Landforms on bent ground.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::surface::{Samples, Surface};
use super::{Bounds, NAME, Node};
use crate::error::Checks;
use crate::fractal::{Frame, Scratch, WarpField};
use crate::{SynthError, Warp};

/// A node on ground that noise bends: elevation and weight are looked up where the noise moves
/// the place to. L and A are multiplied with 1 + the slope of the shifts, which is
/// `sqrt(2) sum(2.926 amplitude / wavelength)` over the octaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Warped {
    /// The node.
    pub of: Box<Node>,
    /// The noise.
    pub by: Warp,
}

/// A node on bent ground, made ready.
#[derive(Debug)]
pub(super) struct WarpSurface {
    of: Box<dyn Surface>,
    field: WarpField,
}

impl WarpSurface {
    pub fn new(
        by: Warp,
        of: Box<dyn Surface>,
        frame: &Frame,
        seed: u64,
    ) -> Result<Self, SynthError> {
        let names = ["by.amplitude_m", "by.wavelength_m", "by.octaves"];
        by.check(&Checks(NAME), names, frame)?;
        Ok(Self { of, field: WarpField::new(by, frame, seed) })
    }
}

impl Surface for WarpSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut bent = points.to_vec();
        self.field.bend(&mut bent, &mut Scratch::new(points.len()));
        self.of.sample(&bent)
    }

    fn support(&self) -> Region {
        self.of.support().grown(self.field.farthest())
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        self.of.range(&region.grown(self.field.farthest()))
    }

    fn bounds(&self, region: &Region) -> Bounds {
        let of = self.of.bounds(&region.grown(self.field.farthest()));
        of.steepened(1.0 + self.field.steepest())
    }
}
