//! Where a run takes place: the lattice, and the raster it came from if there is one.

mod grid;
mod volume;

pub use grid::{Grid, Neighbourhood};
pub use volume::{Volume, VoxelNeighbourhood};

use std::path::Path;
use std::sync::Arc;

use landform_graph::{Boundary, Lattice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::outside::Outside;
use crate::parameters::{Parameters, Problem};

/// The lattice of a run and what is known about its place on Earth.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The lattice.
    pub lattice: Lattice,
    /// Values of the raster that the domain was made from, in node order, if it was.
    pub raster: Option<Arc<[f64]>>,
    /// Georeference of that raster as its reader wrote it; only outputs look inside.
    pub georeference: Option<Arc<dyn std::any::Any + Send + Sync>>,
    /// The number that stands for missing data in the file of that raster, if it names one.
    pub no_data: Option<f64>,
    /// The nodes that do not belong to the map.
    pub outside: Outside,
    /// What a person should know about how the domain was made (cells filled, units assumed).
    pub remarks: Vec<String>,
}

impl From<Lattice> for Domain {
    fn from(lattice: Lattice) -> Self {
        Self {
            lattice,
            raster: None,
            georeference: None,
            no_data: None,
            outside: Outside::default(),
            remarks: Vec::new(),
        }
    }
}

/// A way to make a domain, chosen by name in a scenario.
pub trait DomainSource: Parameters {
    /// Name in scenarios.
    const NAME: &'static str;

    /// Number of nodes, cheaply and before any memory is taken; `None` if only `make` can tell.
    fn nodes(&self) -> Option<u128>;

    /// Makes the domain. Relative paths are relative to `folder`, the scenario's own.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter.
    fn make(&self, folder: &Path) -> Result<Domain, Problem>;
}

/// Boundary of an axis, as scenarios write it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Border {
    /// The axis ends: sand, water and searches may leave there.
    #[default]
    Open,
    /// The axis closes on itself.
    Periodic,
}

impl From<Border> for Boundary {
    fn from(border: Border) -> Self {
        match border {
            Border::Open => Boundary::Open,
            Border::Periodic => Boundary::Periodic,
        }
    }
}
