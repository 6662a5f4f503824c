//! Scenario files: what a run is made of, read from RON and checked before anything runs.

mod file;
mod read;
pub(crate) mod validate;

pub use file::{InitialEntry, Scenario, StageEntry};
pub use read::ScenarioSource;

#[cfg(test)]
mod tests;
