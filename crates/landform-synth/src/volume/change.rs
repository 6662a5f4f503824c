//! Solids changed: moved, copied, bent, roughened.

use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::roughness::Roughness;
use super::shapes::check_place;
use super::solid::{Place3, Solid};
use super::{NAME, VolumeNode};
use crate::SynthError;
use crate::error::Checks;

/// A solid at several places: instances of one block. `f = min_i s_i f_0(p_i)`, where `p_i` is the
/// place moved, turned and scaled back. L stays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Instances {
    /// The solid, as it lies about its own 0, 0, 0.
    pub of: Box<VolumeNode>,
    /// Where copies of it lie; at least one.
    pub at: Vec<Instance>,
}

/// The place of a copy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Instance {
    /// Where the solid's 0, 0, 0 comes to lie: east, north, up.
    #[schemars(inner(range(min = -1e9, max = 1e9)), extend("x-unit" = "m"))]
    pub at_m: [f64; 3],
    /// Turn about the upright axis, counter-clockwise seen from above.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub turn_deg: f64,
    /// Factor of its size.
    #[schemars(range(min = 1e-3, max = 1e3))]
    pub scale: f64,
}

impl Default for Instance {
    fn default() -> Self {
        Self { at_m: [0.0; 3], turn_deg: 0.0, scale: 1.0 }
    }
}

/// Copies made ready.
#[derive(Debug)]
pub(super) struct InstancesSolid {
    of: Box<dyn Solid>,
    /// Place, cosine and sine of the turn, and scale.
    at: Vec<(Place3, [f64; 2], f64)>,
}

impl InstancesSolid {
    pub fn new(of: Box<dyn Solid>, at: &[Instance]) -> Result<Self, SynthError> {
        if at.is_empty() {
            let problem = "no place; name one or more".to_owned();
            return Err(SynthError::Unusable { generator: NAME, parameter: "at", problem });
        }
        for instance in at {
            check_place("at_m", instance.at_m)?;
            Checks(NAME).range("turn_deg", instance.turn_deg, -360.0..=360.0)?;
            Checks(NAME).range("scale", instance.scale, 1e-3..=1e3)?;
        }
        let ready = at.iter().map(|instance| {
            let (sine, cosine) = instance.turn_deg.to_radians().sin_cos();
            (instance.at_m, [cosine, sine], instance.scale)
        });
        Ok(Self { of, at: ready.collect() })
    }
}

impl Solid for InstancesSolid {
    fn value(&self, place: Place3) -> f64 {
        let values = self.at.iter().map(|&(at, [cosine, sine], scale)| {
            let [x, y, z] = [0, 1, 2].map(|axis| (place[axis] - at[axis]) / scale);
            scale * self.of.value([cosine * x + sine * y, cosine * y - sine * x, z])
        });
        values.fold(f64::INFINITY, f64::min)
    }

    fn slope(&self) -> f64 {
        self.of.slope()
    }
}

/// A solid on bent space, `f(p + n(p))` with a noise n along each axis; L times `1 + sqrt 3 L_n`.
/// Or one with a rough surface, `f(p) + n(p)`, which may have holes and floating parts; L plus
/// `L_n`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Noised {
    /// The solid.
    pub of: Box<VolumeNode>,
    /// The noise.
    #[serde(default)]
    pub by: Roughness,
}

/// A solid on bent space, made ready.
#[derive(Debug)]
pub(super) struct WarpedSolid {
    pub of: Box<dyn Solid>,
    pub by: Roughness,
    /// Random numbers of the three axes.
    pub streams: [RandomStream; 3],
}

impl Solid for WarpedSolid {
    fn value(&self, place: Place3) -> f64 {
        let bent = [0, 1, 2].map(|axis| place[axis] + self.by.at(&self.streams[axis], place));
        self.of.value(bent)
    }

    fn slope(&self) -> f64 {
        self.of.slope() * (1.0 + 3.0_f64.sqrt() * self.by.slope())
    }
}

/// A solid with a rough surface, made ready.
#[derive(Debug)]
pub(super) struct RoughSolid {
    pub of: Box<dyn Solid>,
    pub by: Roughness,
    pub stream: RandomStream,
}

impl Solid for RoughSolid {
    fn value(&self, place: Place3) -> f64 {
        self.of.value(place) + self.by.at(&self.stream, place)
    }

    fn slope(&self) -> f64 {
        self.of.slope() + self.by.slope()
    }
}
