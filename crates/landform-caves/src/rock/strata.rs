//! Strata one above the other.

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{across, from_foot, values_of};
use crate::CaveError;
use crate::error::check_range;

/// Strata of different porosity, one above the other, level or inclined (thesis, figure 5.2 c).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Strata {
    /// From the lowest up; the last goes on to the top.
    pub strata: Vec<Stratum>,
    /// How steeply they go down.
    #[schemars(range(min = 0.0, max = 90.0), extend("x-unit" = "deg"))]
    pub dip_deg: f64,
    /// Direction in which they go down, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub dip_direction_deg: f64,
}

/// A stratum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stratum {
    /// Thickness across the stratum.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub thickness_m: f64,
    /// Its porosity.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub porosity: f64,
}

impl Default for Strata {
    fn default() -> Self {
        let strata = vec![Stratum { thickness_m: 10.0, porosity: 0.15 }];
        Self { strata, dip_deg: 0.0, dip_direction_deg: 0.0 }
    }
}

impl Strata {
    /// The porosity, in node order; 0 without strata.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn fill(&self, lattice: &Lattice) -> Result<Vec<f64>, CaveError> {
        check_range("dip_deg", self.dip_deg, [0.0, 90.0])?;
        check_range("dip_direction_deg", self.dip_direction_deg, [-360.0, 360.0])?;
        let mut top = 0.0;
        let mut tops = Vec::new();
        for stratum in &self.strata {
            check_range("thickness_m", stratum.thickness_m, [1e-6, 1e9])?;
            check_range("porosity", stratum.porosity, [0.0, 1.0])?;
            top += stratum.thickness_m;
            tops.push((top, stratum.porosity));
        }
        let across = across(self.dip_deg, self.dip_direction_deg);
        let porosity = |node: usize| {
            let height = across.dot(from_foot(lattice, node));
            let stratum = tops.iter().find(|(top, _)| height < *top).or(tops.last());
            stratum.map_or(0.0, |stratum| stratum.1)
        };
        Ok((0..lattice.node_count()).into_par_iter().map(porosity).collect())
    }
}

impl InitialCondition for Strata {
    const NAME: &'static str = "Strata";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        values_of(context, |lattice, _| self.fill(lattice))
    }
}
