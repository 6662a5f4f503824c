//! Solids that others are made of: spheres, tubes, boxes, ground.

use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NAME;
use super::roughness::Roughness;
use super::solid::{Place3, Solid, difference, dot, length};
use crate::error::Checks;
use crate::{SynthError, Terrain};

/// A ball, or a rough one that has no holes and no floating parts, since every ray from its centre
/// meets the surface once: `f = d - (r + s t(q))`, with d the distance from the centre, t the
/// noise, q the nearest point of the smooth ball and s the lesser of 1 and `d / r`. L is 1, plus
/// `L_t + max |t| / r` if it is rough.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Ball {
    /// Centre: east, north and up from the lowest south-western voxel.
    #[schemars(inner(range(min = -1e9, max = 1e9)), extend("x-unit" = "m"))]
    pub center_m: [f64; 3],
    /// Radius.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub radius_m: f64,
    /// What its surface rises and sinks by.
    pub rough: Option<Roughness>,
}

impl Default for Ball {
    fn default() -> Self {
        Self { center_m: [0.0; 3], radius_m: 10.0, rough: None }
    }
}

impl Ball {
    pub(super) fn check(&self) -> Result<(), SynthError> {
        check_place("center_m", self.center_m)?;
        Checks(NAME).range("radius_m", self.radius_m, 1e-6..=1e9)?;
        self.rough.map_or(Ok(()), |rough| rough.check(NAME)).map_err(|error| error.within("rough"))
    }
}

/// A ball made ready.
#[derive(Debug)]
pub(super) struct BallSolid {
    pub ball: Ball,
    pub stream: RandomStream,
}

impl Solid for BallSolid {
    fn value(&self, place: Place3) -> f64 {
        let Ball { center_m, radius_m, rough } = self.ball;
        let from = difference(place, center_m);
        let distance = length(from);
        let Some(rough) = rough.filter(|_| distance > 0.0) else { return distance - radius_m };
        let near = [0, 1, 2].map(|axis| center_m[axis] + from[axis] * (radius_m / distance));
        let share = (distance / radius_m).min(1.0);
        distance - (radius_m + share * rough.at(&self.stream, near))
    }

    fn slope(&self) -> f64 {
        let rough = self.ball.rough;
        1.0 + rough.map_or(0.0, |rough| rough.slope() + rough.largest() / self.ball.radius_m)
    }
}

/// A tube of changing radius along a line of straight pieces, such as a passage: `f = d(p, c) -
/// r(c)` with c the nearest point of a piece, the least of all pieces. L is `sqrt(1 + m^2)`, with m
/// the largest change of the radius a metre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tube {
    /// The points of its axis: east, north, up, and the radius there; two or more.
    #[schemars(extend("x-unit" = "m"))]
    pub points_m: Vec<[f64; 4]>,
}

impl Default for Tube {
    fn default() -> Self {
        Self { points_m: vec![[0.0, 0.0, 0.0, 5.0], [50.0, 0.0, 0.0, 5.0]] }
    }
}

/// A piece of a tube.
#[derive(Debug)]
struct TubePiece {
    from: Place3,
    along: Place3,
    /// One over the square of its length; 0 for a mere point.
    inverse: f64,
    radius: f64,
    widening: f64,
}

/// A tube made ready.
#[derive(Debug)]
pub(super) struct TubeSolid {
    pieces: Vec<TubePiece>,
    slope: f64,
}

impl TubeSolid {
    pub fn new(tube: &Tube) -> Result<Self, SynthError> {
        if tube.points_m.len() < 2 {
            let problem = format!("{} points; a tube takes at least two", tube.points_m.len());
            return Err(SynthError::Unusable { generator: NAME, parameter: "points_m", problem });
        }
        for &[x, y, z, radius] in &tube.points_m {
            check_place("points_m", [x, y, z])?;
            Checks(NAME).range("points_m", radius, 0.0..=1e9)?;
        }
        let mut steepest = 0.0_f64;
        let pieces = tube.points_m.windows(2).map(|ends| {
            let [from, to] = [ends[0], ends[1]].map(|[x, y, z, _]| [x, y, z]);
            let along = difference(to, from);
            let squared = dot(along, along);
            // Where two points are one, the wider of both radii holds.
            let (radius, widening) = match squared > 0.0 {
                true => (ends[0][3], ends[1][3] - ends[0][3]),
                false => (ends[0][3].max(ends[1][3]), 0.0),
            };
            if squared > 0.0 {
                steepest = steepest.max(widening.abs() / squared.sqrt());
            }
            let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
            TubePiece { from, along, inverse, radius, widening }
        });
        let pieces = pieces.collect();
        Ok(Self { pieces, slope: 1.0_f64.hypot(steepest) })
    }
}

impl Solid for TubeSolid {
    fn value(&self, place: Place3) -> f64 {
        let values = self.pieces.iter().map(|piece| {
            let from = difference(place, piece.from);
            let share = (dot(from, piece.along) * piece.inverse).clamp(0.0, 1.0);
            let aside = [0, 1, 2].map(|axis| from[axis] - share * piece.along[axis]);
            length(aside) - (piece.radius + share * piece.widening)
        });
        values.fold(f64::INFINITY, f64::min)
    }

    fn slope(&self) -> f64 {
        self.slope
    }
}

/// A box along the axes: `f` is the distance to it, or less the distance to its nearest side
/// inside. L is 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Block {
    /// Centre: east, north and up from the lowest south-western voxel.
    #[schemars(inner(range(min = -1e9, max = 1e9)), extend("x-unit" = "m"))]
    pub center_m: [f64; 3],
    /// Lengths of its sides.
    #[schemars(inner(range(min = 0.0, max = 1e9)), extend("x-unit" = "m"))]
    pub sides_m: [f64; 3],
}

impl Default for Block {
    fn default() -> Self {
        Self { center_m: [0.0; 3], sides_m: [20.0; 3] }
    }
}

impl Block {
    pub(super) fn check(&self) -> Result<(), SynthError> {
        check_place("center_m", self.center_m)?;
        let mut sides = self.sides_m.into_iter();
        sides.try_for_each(|side| Checks(NAME).range("sides_m", side, 0.0..=1e9))
    }
}

impl Solid for Block {
    fn value(&self, place: Place3) -> f64 {
        let beyond = [0, 1, 2]
            .map(|axis| (place[axis] - self.center_m[axis]).abs() - 0.5 * self.sides_m[axis]);
        let outside = length(beyond.map(|distance| distance.max(0.0)));
        outside + beyond[0].max(beyond[1]).max(beyond[2]).min(0.0)
    }

    fn slope(&self) -> f64 {
        1.0
    }
}

/// The ground below a terrain, `f = z - h(x, y)`. L is `sqrt(1 + L_h^2)`.
#[derive(Debug)]
pub(super) struct GroundSolid(pub Terrain);

impl Solid for GroundSolid {
    fn value(&self, [x, y, z]: Place3) -> f64 {
        z - self.0.elevation([x, y])
    }

    fn slope(&self) -> f64 {
        1.0_f64.hypot(self.0.bounds().slope)
    }
}

pub(super) fn check_place(parameter: &'static str, place: [f64; 3]) -> Result<(), SynthError> {
    place.into_iter().try_for_each(|x| Checks(NAME).range(parameter, x, -1e9..=1e9))
}
