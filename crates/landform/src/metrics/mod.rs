//! Metrics that need more than the framework: measures of the form of a terrain, of
//! lines and of branches.

mod branch_shape;
mod cave_shape;
mod creases;
mod depressions;
mod drainage;
mod hypsometry;
mod line_shape;
mod shore;
mod side_dimension;
mod spectral;
mod topology;
mod valley_spacing;
mod valleys;
mod volume_slope;

pub use branch_shape::BranchShape;
pub use cave_shape::CaveShape;
pub use creases::Creases;
pub use depressions::Depressions;
pub use drainage::{Drainage, Pits};
pub use hypsometry::{FirstCurve, Hypsometry};
pub use line_shape::{KnownLine, LineShape};
pub use shore::{ShoreDimension, ShoreLevel};
pub use side_dimension::SideDimension;
pub use spectral::SpectralFalloff;
pub use topology::VoxelTopology;
pub use valley_spacing::ValleySpacing;
pub use valleys::ValleyHeads;
pub use volume_slope::VolumeSlope;

pub(crate) use hypsometry::hypsometry_columns;

use landform_analysis::grid::Grid;
use landform_graph::Lattice;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;

/// Values of a field that a metric names.
fn heights(snapshot: &Snapshot<'_>, field: &str) -> Result<Vec<f64>, Problem> {
    snapshot.field(field).map_err(|error| refusal(&error))
}

/// The same for metrics that know of missing values: NaN at nodes outside the map.
fn map_heights(snapshot: &Snapshot<'_>, field: &str) -> Result<Vec<f64>, Problem> {
    let mut heights = heights(snapshot, field)?;
    snapshot.domain().outside.blank(&mut heights);
    Ok(heights)
}

/// The grid that the nodes of a run are the cells of. Its borders are outlets, also those of
/// periodic axes.
fn grid(snapshot: &Snapshot<'_>) -> Result<Grid, Problem> {
    let lattice = snapshot.lattice();
    let cell = [lattice.spacing(); 2];
    Grid::new([lattice.width(), lattice.height()], cell).map_err(|error| refusal(&error))
}

/// Refuses volumes, which have no surface.
fn check_plane(lattice: &Lattice) -> Result<(), Problem> {
    match lattice.depth() {
        1 => Ok(()),
        layers => {
            let message = format!("the domain has {layers} layers; a terrain has one");
            Err(Problem::new("", message, "a domain with two sizes"))
        }
    }
}

/// What is wrong with the field of a metric.
fn refusal(error: &dyn std::error::Error) -> Problem {
    Problem::new("field", error.to_string(), "")
}

/// Columns of a metric, of which those without a value are left out.
fn columns<const COUNT: usize>(values: [(&str, Option<f64>); COUNT]) -> Vec<(String, f64)> {
    let named = |(name, value): (&str, Option<f64>)| Some((name.to_owned(), value?));
    values.into_iter().filter_map(named).collect()
}
