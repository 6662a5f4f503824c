//! Volumes: domains of voxels.

use std::path::Path;

use landform_graph::{Connectivity, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Border, Domain, DomainSource};
use crate::parameters::Problem;

/// Which neighbours a voxel has, as scenarios write it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum VoxelNeighbourhood {
    /// The six that share a face.
    Six,
    /// Those and the twelve that share an edge.
    Eighteen,
    /// Those and the eight that share a corner.
    #[default]
    TwentySix,
}

impl From<VoxelNeighbourhood> for Connectivity {
    fn from(neighbourhood: VoxelNeighbourhood) -> Self {
        match neighbourhood {
            VoxelNeighbourhood::Six => Connectivity::Voxel6,
            VoxelNeighbourhood::Eighteen => Connectivity::Voxel18,
            VoxelNeighbourhood::TwentySix => Connectivity::Voxel26,
        }
    }
}

/// A volume of voxels of a given size.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Volume {
    /// Number of columns (west to east), rows (north to south) and layers (upwards).
    pub size: (usize, usize, usize),
    /// Distance between the middles of voxels that share a face.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub spacing_m: f64,
    /// Which voxels are joined.
    #[schemars(extend("x-source" = "thesis 2.5"))]
    pub connectivity: VoxelNeighbourhood,
    /// Boundary of the west-east axis, of the north-south axis and of the vertical one.
    pub boundary: (Border, Border, Border),
}

impl Default for Volume {
    fn default() -> Self {
        Self {
            size: (60, 60, 20),
            spacing_m: 1.0,
            connectivity: VoxelNeighbourhood::TwentySix,
            boundary: (Border::Open, Border::Open, Border::Open),
        }
    }
}

impl DomainSource for Volume {
    const NAME: &'static str = "Volume";

    fn nodes(&self) -> Option<u128> {
        let (columns, rows, layers) = self.size;
        let [columns, rows, layers] = [columns, rows, layers].map(|nodes| nodes as u128);
        Some(columns.saturating_mul(rows).saturating_mul(layers))
    }

    fn make(&self, _folder: &Path) -> Result<Domain, Problem> {
        let boundary = [self.boundary.0, self.boundary.1, self.boundary.2].map(Into::into);
        let connectivity = self.connectivity.into();
        Lattice::volume(self.size.into(), self.spacing_m, connectivity, boundary)
            .map(Domain::from)
            .map_err(|error| {
                Problem::new("size", error.to_string(), "a size that suits the boundary")
            })
    }
}
