//! Parameters: what a scenario may say of a process, an initial condition, a metric, an output.
//!
//! A parameter is defined once, as a documented field of a struct: its doc comment is its
//! description, `#[schemars(range(..))]` its range, `#[schemars(extend("x-unit" = "m"))]` its
//! unit and `#[schemars(extend("x-source" = "..."))]` where it comes from. Descriptions, range
//! checks and defaults are all read off that definition.

mod check;
mod describe;
mod schema;

pub use describe::ParameterDescription;

pub(crate) use check::check;
pub(crate) use describe::describe;
pub(crate) use schema::schema_of;

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::code::Code;

/// A struct of parameters. Derive `Clone, Serialize, Deserialize, JsonSchema`, implement
/// `Default`, and put `#[serde(deny_unknown_fields, default)]` on it.
pub trait Parameters:
    DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

impl<T> Parameters for T where
    T: DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

/// Why a parameter is refused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problem {
    /// Its number; [`Code::Unsuitable`] unless said otherwise.
    pub code: Code,
    /// Path of the parameter below the struct it belongs to, `winds[0].weight`; empty for the whole.
    pub parameter: String,
    /// What is wrong, with the value.
    pub message: String,
    /// What would have been accepted.
    pub expected: String,
    /// What to do, empty when `expected` says it.
    pub help: String,
}

impl Problem {
    /// A problem with one parameter: a value that does not suit.
    pub fn new(
        parameter: impl Into<String>,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            code: Code::default(),
            parameter: parameter.into(),
            message: message.into(),
            expected: expected.into(),
            help: String::new(),
        }
    }

    /// The same problem under another number than that of unsuitable values.
    #[must_use]
    pub fn code(mut self, code: Code) -> Self {
        self.code = code;
        self
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.parameter.is_empty() {
            write!(f, "{}: ", self.parameter)?;
        }
        write!(f, "{}", self.message)?;
        if !self.expected.is_empty() {
            write!(f, "; expected {}", self.expected)?;
        }
        if !self.help.is_empty() {
            write!(f, "; {}", self.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}
