//! What can be wrong with the settings of a dune model.

use landform_graph::Connectivity;
use thiserror::Error;

/// Why a dune model refuses its settings or its fields.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DuneError {
    /// A number lies outside the range that the model is defined for.
    #[error("{name} is {value}; it must be {expected}")]
    Range {
        /// Name of the setting, with its unit.
        name: &'static str,
        /// Value given.
        value: f64,
        /// Range allowed, in words.
        expected: &'static str,
    },
    /// One slab moved between neighbours would turn the slope round instead of flattening it.
    #[error(
        "slab_m is {slab_m} m, but repose_deg allows steps of {step_m} m between nodes only; \
         use a lower slab, a wider spacing or a steeper repose"
    )]
    SlabTooHigh {
        /// Height of a slab in metres.
        slab_m: f64,
        /// Highest stable step between nodes along an axis, in metres.
        step_m: f64,
    },
    /// The rose holds no wind.
    #[error("the rose has no winds; give at least one")]
    NoWind,
    /// The lattice is a volume.
    #[error("dunes need a 2-D lattice, not {0:?}; use Four, FourEight or Eight")]
    Volume(Connectivity),
    /// Sand is fed in, but no border lets it in.
    #[error("feed_slabs_per_tick is {0}, but no border is open; open an axis or feed nothing")]
    NoInlet(f64),
    /// A field does not have one value a node.
    #[error("field {name} has {found} values; the lattice has {expected} nodes")]
    Length {
        /// Name of the field.
        name: &'static str,
        /// Number of values given.
        found: usize,
        /// Number of nodes of the lattice.
        expected: usize,
    },
    /// Smoothing with this diffusivity would amplify noise instead of removing it.
    #[error(
        "diffusivity_m2 is {diffusivity_m2} m2 a step; with this spacing it must be between 0 \
         and {most_m2} (a quarter of the spacing squared)"
    )]
    Unstable {
        /// Diffusivity times the time step, in square metres.
        diffusivity_m2: f64,
        /// Largest stable value.
        most_m2: f64,
    },
}

/// `value` if `valid`, else the error that says what was expected.
pub(super) fn check(
    valid: bool,
    name: &'static str,
    value: f64,
    expected: &'static str,
) -> Result<(), DuneError> {
    if valid { Ok(()) } else { Err(DuneError::Range { name, value, expected }) }
}

/// Checks that a field has one value a node.
pub(super) fn check_length(
    name: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), DuneError> {
    if found == expected { Ok(()) } else { Err(DuneError::Length { name, found, expected }) }
}
