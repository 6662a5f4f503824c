//! The scaling laws of the drainage of a field.

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{
    AreaRange, FlowDirections, area_exceedance, fill_depressions, hack_exponent, slope_area,
};
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, grid, map_heights, refusal};

/// What water does that comes to a pit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Pits {
    /// It fills the depression and flows on over the lowest point of its rim.
    #[default]
    Filled,
    /// It stays, and the river ends (as in figures 2.10 and 4.25 of the thesis).
    Kept,
}

/// Scaling laws of the drainage of a field, by D8: Hack's exponent (river basins 0.5 to 0.6),
/// the exponent of the exceedance of contributing area (0.43), the concavity of slope against
/// area (0.45), each fitted from 16 nodes to 5 % of the largest basin and left out where that is
/// too little; and the area of the largest basin. Water leaves at the borders of the domain, also
/// at those of periodic axes.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Drainage {
    /// Name of the field.
    pub field: String,
    /// What water does that comes to a pit.
    pub pits: Pits,
}

impl Default for Drainage {
    fn default() -> Self {
        Self { field: "surface".to_owned(), pits: Pits::Filled }
    }
}

impl Metric for Drainage {
    type Memory = ();
    const NAME: &'static str = "Drainage";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = map_heights(snapshot, &self.field)?;
        self.laws(&grid(snapshot)?, heights).map_err(|error| refusal(&error))
    }
}

impl Drainage {
    fn laws(&self, grid: &Grid, heights: Vec<f64>) -> Result<Vec<(String, f64)>, GridError> {
        let (heights, directions) = match self.pits {
            Pits::Filled => {
                let filled = fill_depressions(grid, &heights)?;
                let directions = FlowDirections::over_filled(grid, &filled)?;
                (filled, directions)
            }
            Pits::Kept => {
                let directions = FlowDirections::steepest(grid, &heights)?;
                (heights, directions)
            }
        };
        let cells = directions.contributing_cells();
        let range = AreaRange::usual(&cells);
        let largest = f64::from(cells.iter().copied().max().unwrap_or(0)) * grid.cell_area();
        let concavity = slope_area(&directions, &heights, &cells, range);
        Ok(columns([
            ("drainage_hack", hack_exponent(&directions, &cells, range).map(|law| law.exponent)),
            (
                "drainage_exceedance",
                area_exceedance(&directions, &cells, range).map(|law| law.exponent),
            ),
            ("drainage_concavity", concavity.as_ref().map(|law| law.concavity.exponent)),
            ("drainage_steepness", concavity.map(|law| law.steepness)),
            ("drainage_largest_basin_m2", Some(largest)),
        ]))
    }
}
