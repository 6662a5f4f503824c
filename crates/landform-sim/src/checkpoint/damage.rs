//! Why a checkpoint cannot be resumed from.

use thiserror::Error;

use crate::code::Code;

/// Why a checkpoint cannot be resumed from.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Damage {
    /// Something is not in it.
    #[error("the checkpoint has no `{name}`")]
    Missing {
        /// Name of the array or value.
        name: String,
    },
    /// An array holds numbers of another type.
    #[error("`{name}` in the checkpoint holds numbers of type {found} instead of {expected}")]
    Kind {
        /// Name of the array.
        name: String,
        /// Type of its numbers.
        found: &'static str,
        /// Type that was expected.
        expected: &'static str,
    },
    /// An array is too short or too long.
    #[error("`{name}` in the checkpoint holds {found} numbers instead of {expected}")]
    Length {
        /// Name of the array.
        name: String,
        /// Numbers in it.
        found: usize,
        /// Numbers expected.
        expected: usize,
    },
    /// A value cannot be read or makes no sense.
    #[error("`{name}` in the checkpoint cannot be used: {message}")]
    Value {
        /// Name of the value.
        name: String,
        /// Why.
        message: String,
    },
    /// The checkpoint is of another run.
    #[error("the checkpoint is of another run: its {what} is {found}, this run's is {expected}")]
    Foreign {
        /// What differs.
        what: &'static str,
        /// As it is in the checkpoint.
        found: String,
        /// As it is in this run.
        expected: String,
    },
}

impl Damage {
    /// Its number.
    pub fn code(&self) -> Code {
        match self {
            Self::Missing { .. } | Self::Kind { .. } | Self::Length { .. } | Self::Value { .. } => {
                Code::DamagedCheckpoint
            }
            Self::Foreign { .. } => Code::OtherScenario,
        }
    }
}
