//! Metrics of water and of its channels.

mod captures;
mod channels;
mod flow_density;
mod standing_water;

pub use captures::TributaryCaptures;
pub use channels::Channels;
pub use flow_density::FlowDensity;
pub use standing_water::{Lakes, StandingWater};

use landform_graph::Lattice;
use landform_sim::parameters::Problem;

/// Named values without those that could not be measured.
fn named<const N: usize>(values: [(&str, Option<f64>); N]) -> Vec<(String, f64)> {
    values.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))).collect()
}

fn check_plane(lattice: &Lattice) -> Result<(), Problem> {
    match lattice.connectivity().is_volume() {
        true => {
            let message = format!("the lattice joins {:?}", lattice.connectivity());
            Err(Problem::new("", message, "a 2-D lattice"))
        }
        false => Ok(()),
    }
}
