//! Initial conditions: how fields are filled before the first iteration.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::domain::Domain;
use crate::parameters::{Parameters, Problem};

/// What an initial condition may use.
pub struct InitialContext<'a> {
    /// The domain of the run.
    pub domain: &'a Domain,
    /// Seed for this very entry of the scenario, different for every entry and every run seed.
    pub seed: u64,
    /// The scenario's folder, for relative paths.
    pub folder: &'a Path,
}

/// A way to fill a field, chosen by name in a scenario.
pub trait InitialCondition: Parameters {
    /// Name in scenarios.
    const NAME: &'static str;

    /// The values, one a node, in node order.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter.
    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem>;
}

/// How the values of an initial condition meet those that are there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Combine {
    /// Replaces them.
    #[default]
    Set,
    /// Is added to them.
    Add,
    /// Multiplies them.
    Multiply,
    /// The larger of both.
    Max,
    /// The smaller of both.
    Min,
}

impl Combine {
    /// The combined value.
    pub fn apply(self, present: f64, new: f64) -> f64 {
        match self {
            Self::Set => new,
            Self::Add => present + new,
            Self::Multiply => present * new,
            Self::Max => present.max(new),
            Self::Min => present.min(new),
        }
    }
}
