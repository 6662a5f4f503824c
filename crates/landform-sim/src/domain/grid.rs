//! Grids: domains of one layer.

use std::path::Path;

use landform_graph::{Connectivity, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Border, Domain, DomainSource};
use crate::parameters::Problem;

/// Which neighbours a node of a grid has, as scenarios write it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Neighbourhood {
    /// The 4-8 mesh of the thesis (section 2.5): eight neighbours and four in turn.
    #[default]
    FourEight,
    /// The four along the axes.
    Four,
    /// The four along the axes and the four along the diagonals.
    Eight,
}

impl From<Neighbourhood> for Connectivity {
    fn from(neighbourhood: Neighbourhood) -> Self {
        match neighbourhood {
            Neighbourhood::FourEight => Connectivity::FourEight,
            Neighbourhood::Four => Connectivity::Four,
            Neighbourhood::Eight => Connectivity::Eight,
        }
    }
}

/// A grid of nodes of a given size.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Grid {
    /// Number of columns (west to east) and rows (north to south).
    pub size: (usize, usize),
    /// Distance between neighbouring nodes along an axis.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub spacing_m: f64,
    /// Which nodes are joined.
    #[schemars(extend("x-source" = "thesis 2.5"))]
    pub connectivity: Neighbourhood,
    /// Boundary of the west-east axis and of the north-south axis.
    pub boundary: (Border, Border),
}

impl Default for Grid {
    fn default() -> Self {
        Self {
            size: (256, 256),
            spacing_m: 10.0,
            connectivity: Neighbourhood::FourEight,
            boundary: (Border::Open, Border::Open),
        }
    }
}

impl DomainSource for Grid {
    const NAME: &'static str = "Grid";

    fn nodes(&self) -> Option<u128> {
        Some(self.size.0 as u128 * self.size.1 as u128)
    }

    fn make(&self, _folder: &Path) -> Result<Domain, Problem> {
        let (width, height) = self.size;
        let boundary = [self.boundary.0.into(), self.boundary.1.into()];
        let connectivity = self.connectivity.into();
        let lattice = Lattice::plane([width, height], self.spacing_m, connectivity, boundary);
        let lattice = lattice.map_err(|error| {
            Problem::new("size", error.to_string(), "a size that suits the boundary")
        })?;
        Ok(Domain::from(lattice))
    }
}
