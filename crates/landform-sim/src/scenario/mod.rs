//! Scenario files: what a run is made of, read from RON and checked before anything runs.

mod file;
mod read;
mod schema;
pub(crate) mod validate;

pub use file::{InitialEntry, Scenario, StageEntry};
pub use read::ScenarioSource;
pub use schema::scenario_schema;

#[cfg(test)]
mod tests;
