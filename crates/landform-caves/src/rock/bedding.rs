//! Bedding planes.

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{across, from_foot, half_thickness, values_of};
use crate::CaveError;
use crate::error::check_range;

/// Parallel planes between strata, along which water enters easily: one value in them, 0 elsewhere.
/// Laid into rock with `combine: Max`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BeddingPlanes {
    /// Porosity in the planes.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub porosity: f64,
    /// Heights of the planes above the foot of the domain's middle.
    #[schemars(extend("x-unit" = "m"))]
    pub heights_m: Vec<f64>,
    /// Thickness of a plane; at least one voxel is taken.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub thickness_m: f64,
    /// How steeply the planes go down.
    #[schemars(range(min = 0.0, max = 90.0), extend("x-unit" = "deg"))]
    pub dip_deg: f64,
    /// Direction in which they go down, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub dip_direction_deg: f64,
}

impl Default for BeddingPlanes {
    fn default() -> Self {
        Self {
            porosity: 0.3,
            heights_m: vec![5.0],
            thickness_m: 1.0,
            dip_deg: 0.0,
            dip_direction_deg: 0.0,
        }
    }
}

impl BeddingPlanes {
    /// The porosity of the planes, 0 beside them, in node order.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn fill(&self, lattice: &Lattice) -> Result<Vec<f64>, CaveError> {
        check_range("porosity", self.porosity, [0.0, 1.0])?;
        check_range("thickness_m", self.thickness_m, [0.0, 1e9])?;
        check_range("dip_deg", self.dip_deg, [0.0, 90.0])?;
        check_range("dip_direction_deg", self.dip_direction_deg, [-360.0, 360.0])?;
        for &height in &self.heights_m {
            check_range("heights_m", height, [-1e9, 1e9])?;
        }
        let across = across(self.dip_deg, self.dip_direction_deg);
        let half = half_thickness(lattice, across, self.thickness_m);
        let value = |node: usize| {
            let at = from_foot(lattice, node);
            let inside = self.heights_m.iter().any(|&height| {
                let off = across.dot(at) - across.z * height;
                -half < off && off <= half
            });
            if inside { self.porosity } else { 0.0 }
        };
        Ok((0..lattice.node_count()).into_par_iter().map(value).collect())
    }
}

impl InitialCondition for BeddingPlanes {
    const NAME: &'static str = "BeddingPlanes";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        values_of(context, |lattice, _| self.fill(lattice))
    }
}
