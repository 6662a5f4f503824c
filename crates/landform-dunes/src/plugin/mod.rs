//! Dunes and sandpiles as processes and metrics that scenarios may name.

mod counts;
mod dunes;
pub mod metrics;
mod row_piles;
mod sandpiles;
mod smoothing;

pub use counts::{DuneActivity, DuneCounts};
pub use dunes::{Dunes, ShelterKind};
pub use row_piles::{RicePile, SlidingSlabs, Topplings};
pub use sandpiles::{AvalancheRecord, Grains, Sandpile};
pub use smoothing::Smoothing;

use landform_sim::registry::Registry;

use crate::sandpile::{CorrosionLike, SandLike};

/// Registers the processes and metrics of this crate.
pub fn register(registry: &mut Registry) {
    registry
        .process::<Dunes>()
        .process::<Smoothing>()
        .process::<SandLike>()
        .process::<CorrosionLike>()
        .process::<Sandpile>()
        .process::<RicePile>()
        .process::<SlidingSlabs>();
    registry
        .metric::<metrics::NearRepose>()
        .metric::<metrics::BareGround>()
        .metric::<metrics::Crests>()
        .metric::<metrics::Migration>()
        .metric::<metrics::ProtectionError>()
        .metric::<metrics::Avalanches>()
        .metric::<metrics::GrainShares>()
        .metric::<metrics::RidgeDrift>()
        .metric::<DuneActivity>();
}
