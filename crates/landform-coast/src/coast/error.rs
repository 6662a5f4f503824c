//! What can be wrong with the settings of a coast.

use landform_graph::Connectivity;
use thiserror::Error;

/// Why a coast refuses its settings or its fields.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CoastError {
    /// A number lies outside the range that the model is defined for.
    #[error("{name} is {value}; it must be {expected}")]
    Range {
        /// Name of the setting, with its unit.
        name: &'static str,
        /// Value given.
        value: f64,
        /// Range allowed, in words.
        expected: String,
    },
    /// The lattice is a volume.
    #[error("coasts need a 2-D lattice, not {0:?}; use FourEight, Four or Eight")]
    Volume(Connectivity),
    /// The lattice has more nodes than shores can number.
    #[error("the lattice has {0} nodes; coasts need at most {most}", most = u32::MAX / 4)]
    TooLarge(usize),
    /// Part of the coast has rules of its own, but nobody says which part.
    #[error("region {0} names no part of the map; give at least one side, or three corners")]
    EmptyRegion(usize),
    /// There are more regions than can be told apart.
    #[error("{0} regions are given; give at most 254")]
    TooManyRegions(usize),
    /// There is no land to erode, or no sea to erode it.
    #[error(
        "no land meets the sea: {land} of {nodes} nodes are land; the field `land` must be 0 at \
         sea and 1 on land, with some of both"
    )]
    NoCoast {
        /// Number of land nodes.
        land: usize,
        /// Number of nodes.
        nodes: usize,
    },
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
}

/// `value` if `valid`, else the error that says what was expected.
pub(super) fn check(
    valid: bool,
    name: &'static str,
    value: f64,
    expected: &str,
) -> Result<(), CoastError> {
    if valid {
        Ok(())
    } else {
        Err(CoastError::Range { name, value, expected: expected.to_owned() })
    }
}

/// Checks that a field has one value a node.
pub(super) fn check_length(
    name: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), CoastError> {
    if found == expected { Ok(()) } else { Err(CoastError::Length { name, found, expected }) }
}
