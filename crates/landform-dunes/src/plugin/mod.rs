//! Dunes and sandpiles as processes, metrics and initial states that scenarios may name.

mod counts;
mod dunes;
mod smoothing;

pub use counts::{DuneActivity, DuneCounts};
pub use dunes::{Dunes, ShelterKind};
pub use smoothing::Smoothing;

use landform_sim::registry::Registry;

/// Registers the processes and metrics of this crate.
pub fn register(registry: &mut Registry) {
    registry.process::<Dunes>().process::<Smoothing>();
    registry.metric::<DuneActivity>();
}
