//! Sets of fractures.

use glam::DVec3;
use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use landform_sim::random::RandomStream;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{across, from_foot, half_thickness, values_of};
use crate::CaveError;
use crate::error::check_range;

/// Sets of parallel fractures: one value in them, 0 elsewhere. Laid into rock with `combine: Max`.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Fractures {
    /// The sets; where several meet, the largest porosity counts.
    pub sets: Vec<FractureSet>,
}

/// Parallel fractures at regular or irregular distances.
///
/// Fractures without an extent cross the whole domain. With one, each plane holds discs of that radius
/// at random places, and rock remains between them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FractureSet {
    /// Porosity in the fractures.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub porosity: f64,
    /// Direction of a level line on the fractures, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub strike_deg: f64,
    /// How steep they are, 90 for joints; they go down to the right of the strike.
    #[schemars(range(min = 0.0, max = 90.0), extend("x-unit" = "deg"))]
    pub dip_deg: f64,
    /// Distance from one to the next.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub spacing_m: f64,
    /// Distance of the first from the foot of the domain's middle.
    #[schemars(range(min = -1e9, max = 1e9), extend("x-unit" = "m"))]
    pub offset_m: f64,
    /// Width of a fracture; at least one voxel is taken.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub aperture_m: f64,
    /// Largest random shift of a fracture, as a share of half the spacing.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub irregularity: f64,
    /// Radius of a fracture; all across the domain when missing.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub extent_m: Option<f64>,
}

impl Default for FractureSet {
    fn default() -> Self {
        Self {
            porosity: 0.3,
            strike_deg: 90.0,
            dip_deg: 90.0,
            spacing_m: 20.0,
            offset_m: 0.0,
            aperture_m: 1.0,
            irregularity: 0.0,
            extent_m: None,
        }
    }
}

/// A set on a lattice.
struct Planes {
    across: DVec3,
    /// Unit vectors along the fractures.
    along: [DVec3; 2],
    half: f64,
    random: RandomStream,
}

impl FractureSet {
    fn check(&self) -> Result<(), CaveError> {
        check_range("porosity", self.porosity, [0.0, 1.0])?;
        check_range("strike_deg", self.strike_deg, [-360.0, 360.0])?;
        check_range("dip_deg", self.dip_deg, [0.0, 90.0])?;
        check_range("spacing_m", self.spacing_m, [1e-6, 1e12])?;
        check_range("offset_m", self.offset_m, [-1e9, 1e9])?;
        check_range("aperture_m", self.aperture_m, [0.0, 1e9])?;
        check_range("irregularity", self.irregularity, [0.0, 1.0])?;
        check_range("extent_m", self.extent_m.unwrap_or(1.0), [1e-6, 1e9])
    }

    fn planes(&self, lattice: &Lattice, random: RandomStream) -> Planes {
        let strike = self.strike_deg.to_radians();
        let across = across(self.dip_deg, self.strike_deg - 90.0);
        let level = DVec3::new(strike.cos(), strike.sin(), 0.0);
        let half = half_thickness(lattice, across, self.aperture_m);
        Planes { across, along: [level, across.cross(level)], half, random }
    }

    /// Whether a position lies in a fracture of the set.
    fn holds(&self, planes: &Planes, at: DVec3) -> bool {
        let off = planes.across.dot(at) - self.offset_m;
        let nearest = (off / self.spacing_m).round();
        // A shifted fracture may be the one of the next interval.
        (-1..=1).any(|beside| {
            let number = nearest + f64::from(beside);
            let shift =
                0.5 * self.irregularity * self.spacing_m * draw(planes, number, [0.0; 2], 0);
            let off = off - number * self.spacing_m - shift;
            -planes.half < off && off <= planes.half && self.covers(planes, number, at)
        })
    }

    /// Whether a disc of a fracture reaches a position on it. Each square of the plane, as wide as a
    /// disc, holds the middle of one.
    fn covers(&self, planes: &Planes, number: f64, at: DVec3) -> bool {
        let Some(radius) = self.extent_m else { return true };
        let side = 2.0 * radius;
        let place = planes.along.map(|along| along.dot(at) / side);
        let square = place.map(f64::floor);
        (0..9).any(|beside| {
            let square =
                [square[0] + f64::from(beside % 3 - 1), square[1] + f64::from(beside / 3 - 1)];
            let middle = [1, 2].map(|axis| 0.5 + 0.5 * draw(planes, number, square, axis));
            let off = [0, 1].map(|axis| place[axis] - square[axis] - middle[axis]);
            off[0].hypot(off[1]) <= 0.5
        })
    }
}

/// A random number from -1 to 1 for a square of a fracture.
fn draw(planes: &Planes, number: f64, square: [f64; 2], index: u32) -> f64 {
    let key = (number as i64 as u64) << 32 | (square[0] as i64 as u32) as u64;
    2.0 * planes.random.unit(key, (square[1] as i64 as u32) as usize, index) - 1.0
}

impl Fractures {
    /// The porosity of the fractures, 0 beside them, in node order.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn fill(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, CaveError> {
        self.sets.iter().try_for_each(FractureSet::check)?;
        let sets = self.sets.iter().enumerate().map(|(number, set)| {
            let random = RandomStream::new(seed, &format!("fracture set {number}"));
            (set, set.planes(lattice, random))
        });
        let sets: Vec<_> = sets.collect();
        let value = |node: usize| {
            let at = from_foot(lattice, node);
            let inside = sets.iter().filter(|(set, planes)| set.holds(planes, at));
            inside.map(|(set, _)| set.porosity).fold(0.0, f64::max)
        };
        Ok((0..lattice.node_count()).into_par_iter().map(value).collect())
    }
}

impl InitialCondition for Fractures {
    const NAME: &'static str = "Fractures";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        values_of(context, |lattice, seed| self.fill(lattice, seed))
    }
}
