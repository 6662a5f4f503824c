//! Why a field cannot be generated, and the checks that tell.

use std::cmp::Ordering;
use std::ops::RangeInclusive;

use landform_graph::Lattice;
use landform_sim::code::Code;
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
    /// A list that makes no shape.
    #[error("{generator}: {parameter}{}{problem}", if .parameter.is_empty() { "" } else { ": " })]
    Unusable {
        /// Name of the generator.
        generator: &'static str,
        /// Name of the parameter; empty for the whole.
        parameter: &'static str,
        /// What is wrong and what it takes.
        problem: String,
    },
    /// A tree with too many parts.
    #[error("{generator}: more than {most} {what}; split it into several initial conditions")]
    TooLarge {
        /// Name of the generator.
        generator: &'static str,
        /// The parts.
        what: &'static str,
        /// How many there may be.
        most: usize,
    },
    /// A problem of a part.
    #[error("{path}: {problem}")]
    Within {
        /// Path of the part, `of.ground` say.
        path: String,
        /// What is wrong with it.
        problem: Box<SynthError>,
    },
}

impl SynthError {
    /// The problem as one of the part at `path`.
    pub(crate) fn within(self, path: &str) -> Self {
        match self {
            Self::Within { path: inner, problem } => {
                Self::Within { path: format!("{path}.{inner}"), problem }
            }
            problem => Self::Within { path: path.to_owned(), problem: Box::new(problem) },
        }
    }

    /// Its number.
    pub fn code(&self) -> Code {
        match self {
            Self::OutOfRange { .. } => Code::OutOfRange,
            Self::Volume { .. }
            | Self::DoesNotClose { .. }
            | Self::CoarseShape { .. }
            | Self::Unusable { .. }
            | Self::TooLarge { .. } => Code::Unsuitable,
            Self::Within { problem, .. } => problem.code(),
        }
    }

    /// Path of the parameter that is refused; empty if it is none.
    pub(crate) fn parameter(&self) -> String {
        match self {
            Self::OutOfRange { parameter, .. } | Self::Unusable { parameter, .. } => {
                (*parameter).to_owned()
            }
            Self::Within { path, problem } => match problem.parameter() {
                inner if inner.is_empty() => path.clone(),
                inner => format!("{path}.{inner}"),
            },
            _ => String::new(),
        }
    }
}

/// Passes a list of points with increasing first numbers, `least` points or more.
pub(crate) fn check_steps(
    generator: &'static str,
    parameter: &'static str,
    points: &[[f64; 2]],
    least: usize,
) -> Result<(), SynthError> {
    let increases =
        |pair: &[[f64; 2]]| pair[0][0].partial_cmp(&pair[1][0]).is_some_and(Ordering::is_lt);
    let problem = match points.windows(2).find(|pair| !increases(pair)) {
        Some(pair) => {
            format!("{} follows {}; the first numbers must increase", pair[1][0], pair[0][0])
        }
        None if points.len() < least => {
            format!("{} points; there must be at least {least}", points.len())
        }
        None => return Ok(()),
    };
    Err(SynthError::Unusable { generator, parameter, problem })
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

    /// Refuses places at absurd distances.
    pub fn place(&self, parameter: &'static str, place: [f64; 2]) -> Result<(), SynthError> {
        place.into_iter().try_for_each(|value| self.elevation(parameter, value))
    }

    /// Refuses volumes.
    pub fn plane(&self, lattice: &Lattice) -> Result<(), SynthError> {
        match lattice.depth() {
            1 => Ok(()),
            layers => Err(SynthError::Volume { generator: self.0, layers }),
        }
    }
}
