//! Why a field cannot be generated, and the checks that tell.

use std::ops::RangeInclusive;

use landform_graph::Lattice;
use thiserror::Error;

/// Largest length in metres that a parameter may have: far beyond any landform, and small
/// enough that no field overflows.
const LARGEST_LENGTH_M: f64 = 1e12;

/// Why an initial condition is refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SynthError {
    /// A parameter is not a number in its range.
    #[error("{generator}: {parameter} is {value}; it must be from {least} to {most}")]
    OutOfRange {
        /// Name of the generator.
        generator: &'static str,
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// Smallest value that is accepted.
        least: f64,
        /// Largest value that is accepted.
        most: f64,
    },
    /// The generator makes surfaces and the lattice is a volume.
    #[error("{generator}: the lattice has {layers} layers; this field needs a 2-D lattice")]
    Volume {
        /// Name of the generator.
        generator: &'static str,
        /// Number of layers of the lattice.
        layers: usize,
    },
    /// The field would have a step where a periodic axis closes.
    #[error(
        "{generator}: the field would have a step where the periodic {axis} axis closes; \
         {remedy}"
    )]
    DoesNotClose {
        /// Name of the generator.
        generator: &'static str,
        /// Name of the axis: `x` or `y`.
        axis: char,
        /// What to change.
        remedy: &'static str,
    },
    /// The heights of a coarse grid are not as many as the lattice needs.
    #[error("{generator}: coarse_m must have {rows} rows of {columns} heights, or none at all")]
    CoarseShape {
        /// Name of the generator.
        generator: &'static str,
        /// Number of rows that the lattice needs.
        rows: usize,
        /// Number of heights that every row needs.
        columns: usize,
    },
}

/// The checks of one generator's parameters.
pub(crate) struct Checks(pub &'static str);

impl Checks {
    /// Refuses values outside `range`, and those that are not numbers.
    pub fn range(
        &self,
        parameter: &'static str,
        value: f64,
        range: RangeInclusive<f64>,
    ) -> Result<(), SynthError> {
        match range.contains(&value) {
            true => Ok(()),
            false => Err(SynthError::OutOfRange {
                generator: self.0,
                parameter,
                value,
                least: *range.start(),
                most: *range.end(),
            }),
        }
    }

    /// Refuses heights of absurd size.
    pub fn elevation(&self, parameter: &'static str, value: f64) -> Result<(), SynthError> {
        self.range(parameter, value, -LARGEST_LENGTH_M..=LARGEST_LENGTH_M)
    }

    /// Refuses lengths that are below `least` or absurd.
    pub fn length(
        &self,
        parameter: &'static str,
        value: f64,
        least: f64,
    ) -> Result<(), SynthError> {
        self.range(parameter, value, least..=LARGEST_LENGTH_M)
    }

    /// Refuses volumes.
    pub fn plane(&self, lattice: &Lattice) -> Result<(), SynthError> {
        match lattice.depth() {
            1 => Ok(()),
            layers => Err(SynthError::Volume { generator: self.0, layers }),
        }
    }
}
