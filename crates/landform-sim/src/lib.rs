//! The framework of Landform: nodes as entities, fields, agent groups, stages, scenarios.

pub mod random;
