//! The same value everywhere.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Checks;
use crate::{Generator, SynthError};

/// The same value at every node.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Uniform {
    /// The value, in the unit of the field.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub value: f64,
}

impl Generator for Uniform {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        Checks("Uniform").elevation("value", self.value)?;
        Ok(vec![self.value; lattice.node_count()])
    }
}
