//! Metrics of dunes and sandpiles.

mod avalanches;
mod crests;
mod grain_shares;
mod migration;
mod repose;
mod ridge_drift;
mod shadow_error;

pub use avalanches::Avalanches;
pub use crests::Crests;
pub use grain_shares::GrainShares;
pub use migration::Migration;
pub use repose::{BareGround, NearRepose};
pub use ridge_drift::RidgeDrift;
pub use shadow_error::ProtectionError;

use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;

use crate::dunes::DuneError;

/// The surface of the run.
fn surface(snapshot: &Snapshot<'_>) -> Result<Vec<f64>, Problem> {
    field(snapshot, "surface")
}

fn field(snapshot: &Snapshot<'_>, name: &str) -> Result<Vec<f64>, Problem> {
    snapshot.field(name).map_err(|error| Problem::new("", error.to_string(), "a process with sand"))
}

/// A metric that the kernels refuse to measure.
fn refusal(error: DuneError) -> Problem {
    Problem::new("", error.to_string(), "")
}

/// Named values without those that could not be measured.
fn measured<const N: usize>(values: [(&str, Option<f64>); N]) -> Vec<(String, f64)> {
    values.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))).collect()
}
