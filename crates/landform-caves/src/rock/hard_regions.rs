//! Spherical regions of hard rock.

use glam::DVec3;
use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use landform_sim::random::RandomStream;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values_of;
use crate::CaveError;
use crate::error::check_range;
use crate::place::in_section;

/// Balls of hard rock, in which porosity decreases towards the middle (thesis, figure 5.9): a factor,
/// 1 outside. Laid into rock with `combine: Multiply`.
///
/// The factor falls linearly from 1 at the surface of a ball to `core` at its middle; where balls
/// overlap, the least counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HardRegions {
    /// Balls at given places.
    pub regions: Vec<HardRegion>,
    /// Balls at random places beside them.
    #[schemars(range(min = 0, max = 10000))]
    pub random: u32,
    /// Least and largest radius of random balls.
    #[schemars(extend("x-unit" = "m"))]
    pub radius_m: (f64, f64),
    /// Factor in the middle of a ball.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub core: f64,
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HardRegion {
    /// Its middle: shares of the way from west to east, south to north and bottom to top.
    pub center: [f64; 3],
    /// Its radius.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for HardRegions {
    fn default() -> Self {
        Self { regions: Vec::new(), random: 10, radius_m: (4.0, 8.0), core: 0.1 }
    }
}

impl HardRegions {
    /// The factor, in node order.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn fill(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, CaveError> {
        let balls = self.balls(lattice, seed)?;
        let factor = |node: usize| {
            let at = in_section(lattice, lattice.position(node));
            let off = balls.iter().map(|(middle, radius)| middle.distance(at) / radius);
            let deepest = off.fold(1.0, f64::min);
            self.core + (1.0 - self.core) * deepest
        };
        Ok((0..lattice.node_count()).into_par_iter().map(factor).collect())
    }

    /// Middles and radii in metres.
    fn balls(&self, lattice: &Lattice, seed: u64) -> Result<Vec<(DVec3, f64)>, CaveError> {
        check_range("core", self.core, [0.0, 1.0])?;
        check_range("random", f64::from(self.random), [0.0, 1e4])?;
        let (least, most) = self.radius_m;
        check_range("radius_m", least, [1e-6, 1e9])?;
        check_range("radius_m", most, [least, 1e9])?;
        let last = lattice.size().map(|size| (size - 1) as f64 * lattice.spacing());
        let middle = |share: [f64; 3]| {
            in_section(lattice, DVec3::from_array(share) * DVec3::from_array(last))
        };
        let random = RandomStream::new(seed, "hard regions");
        let mut balls = Vec::new();
        for region in &self.regions {
            check_range("radius_m", region.radius_m, [1e-6, 1e9])?;
            if !region.center.iter().all(|share| (0.0..=1.0).contains(share)) {
                return Err(CaveError::Outside { center: region.center });
            }
            balls.push((middle(region.center), region.radius_m));
        }
        for number in 0..self.random as usize {
            let draw = |index| random.unit(0, number, index);
            let radius = least + (most - least) * draw(3);
            balls.push((middle([draw(0), draw(1), draw(2)]), radius));
        }
        Ok(balls)
    }
}

impl InitialCondition for HardRegions {
    const NAME: &'static str = "HardRegions";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        values_of(context, |lattice, seed| self.fill(lattice, seed))
    }
}
