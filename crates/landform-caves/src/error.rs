//! What can be wrong with rock and with what flows through it.

use landform_graph::marching::MarchError;
use landform_graph::max_flow::FlowError;
use thiserror::Error;

/// Why a cave cannot grow.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CaveError {
    /// A field does not have one value a voxel.
    #[error("field {name} has {found} values; the lattice has {expected} voxels")]
    Length {
        /// Name of the field.
        name: &'static str,
        /// Number of values given.
        found: usize,
        /// Number of voxels of the lattice.
        expected: usize,
    },
    /// A value lies out of its range.
    #[error("field {name} is {value} at voxel {node}; it must lie from {least} to {most}")]
    Value {
        /// Name of the field.
        name: &'static str,
        /// Value found.
        value: f64,
        /// The first voxel that has such a value.
        node: usize,
        /// Least value allowed.
        least: f64,
        /// Largest value allowed.
        most: f64,
    },
    /// A parameter lies out of its range.
    #[error("{parameter} is {value}; it must lie from {least} to {most}")]
    OutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        least: f64,
        /// Largest value allowed.
        most: f64,
    },
    /// An opening lies outside the rock.
    #[error("the middle {center:?} lies outside the domain; give shares from 0 to 1")]
    Outside {
        /// Shares of the width, of the height and of the depth.
        center: [f64; 3],
    },
    /// There is nothing that water could come from.
    #[error("there is no source; water must come in somewhere")]
    NoSource,
    /// Two openings share a voxel.
    #[error("voxel {node} belongs to two openings; move one of them, or make it smaller")]
    Shared {
        /// The voxel.
        node: usize,
    },
    /// A front cannot march.
    #[error(transparent)]
    March(#[from] MarchError),
    /// A flow cannot be found.
    #[error(transparent)]
    Flow(#[from] FlowError),
}

/// Checks that a field has one value a voxel.
pub(crate) fn check_length(
    name: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), CaveError> {
    if found == expected { Ok(()) } else { Err(CaveError::Length { name, found, expected }) }
}

/// Checks that a field has one value a voxel, all within `[least, most]`.
pub(crate) fn check_values(
    name: &'static str,
    values: &[f64],
    expected: usize,
    [least, most]: [f64; 2],
) -> Result<(), CaveError> {
    check_length(name, values.len(), expected)?;
    match values.iter().position(|value| !(least..=most).contains(value)) {
        Some(node) => Err(CaveError::Value { name, value: values[node], node, least, most }),
        None => Ok(()),
    }
}

/// Checks that a parameter lies within its range.
pub(crate) fn check_range(
    parameter: &'static str,
    value: f64,
    [least, most]: [f64; 2],
) -> Result<(), CaveError> {
    match (least..=most).contains(&value) {
        true => Ok(()),
        false => Err(CaveError::OutOfRange { parameter, value, least, most }),
    }
}
