//! Dunes that the wind builds: slabs that hop downwind (thesis, section 4.1).
//!
//! Werner's model (1995) moves sand in slabs. The wind lifts a slab from a node it reaches,
//! and the slab hops downwind until it stays: surely where the ground is sheltered, with some
//! probability elsewhere, more easily on sand than on bare ground. Sand steeper than repose
//! slides. Dunes organise themselves from this, and drift downwind the slower the higher they are.
//!
//! - [`Engine`]: one tick of all this over a hard bed, on any number of threads;
//! - [`Shelter`]: where the wind does not reach; [`Shadow`] is the geometric principle,
//!   [`Protection`] the thesis' own;
//! - [`Rose`], [`Wind`]: where the wind blows; [`WindLine`]: the nodes it blows along;
//! - [`Refinement`]: phases of ever lower slabs; [`smooth`]: the diffusion at the end;
//! - [`crossing_spacing_m`], [`drift_m`], [`crest_orientation`], [`near_repose_percent`] and others:
//!   what to measure on a dune field; [`shadow_error`]: protection against geometric shadow;
//! - [`mod@reference`]: the same model, literally and serially, for reading and for tests.

mod avalanche;
mod band;
mod cone;
mod cone_sums;
mod crest_lines;
mod crest_spacing;
mod engine;
mod error;
mod feed;
mod metrics;
mod plane;
mod profiles;
mod protection;
mod protection_reference;
pub mod reference;
mod refinement;
mod settings;
mod shadow;
mod shadow_error;
mod shelter;
mod smoothing;
mod stencil;
mod transport;
mod wind;

pub use avalanche::AvalancheCounts;
pub use crest_lines::{CrestOrientation, crest_ends_per_m, crest_orientation};
pub use crest_spacing::{correlation_spacing_m, crossing_spacing_m, drift_m};
pub use engine::{Engine, TickCounts};
pub use error::DuneError;
pub use metrics::{bare_percent, near_repose_percent, sand_volume_m3, steepest_slopes};
pub use protection::{Protection, ProtectionSettings};
pub use protection_reference::protection_by_definition;
pub use refinement::Refinement;
pub use settings::{AvalancheSettings, DuneSettings, TransportSettings};
pub use shadow::{Shadow, ShadowSettings, cast_shadow};
pub use shadow_error::{
    FlankSettings, ShadowError, VisibilitySettings, flanks, geometric_shadow, shadow_error,
};
pub use shelter::{Exposure, Shelter, Unsheltered};
pub use smoothing::{SmoothingSettings, smooth};
pub use transport::{SUB_STEPS, TransportCounts};
pub use wind::{Axis, Directions, Rose, Wind, WindLine};
