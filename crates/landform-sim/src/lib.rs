//! The framework of Landform: agents on the nodes of a lattice, in an entity component system.
//!
//! It carries the simulation framework of Pytel's thesis ("Erosion, Self-Organization, and
//! Procedural Modeling", Waterloo 2015, chapter 3) onto `bevy_ecs`:
//!
//! | thesis, 3.2.3 | here |
//! |---|---|
//! | graph of the problem setting | [`landform_graph::Lattice`], a resource [`nodes::Space`] |
//! | agents at every node | a [`field::NodeField`], handed to systems as a slice |
//! | agents at some nodes, group membership, registration, lifetime, parity | [`agent::Agents`] |
//! | group globals | [`agent::AgentGroup::Globals`] |
//! | an erosion process | a [`process::Process`]: parameters that are a Bevy plugin |
//! | a simulation of several algorithms in sequence | stages of a [`scenario::Scenario`] |
//!
//! [`simulation::Simulation`] runs a scenario; [`registry::Registry`] knows what a scenario may
//! name. The framework reads and writes no files but scenarios: outputs are sinks that are
//! registered from outside.

pub mod agent;
pub mod checkpoint;
pub mod clock;
pub mod code;
pub mod domain;
pub mod fault;
pub mod field;
pub mod initial;
pub mod ledger;
pub mod metric;
pub mod nodes;
pub mod notes;
pub mod output;
pub mod outside;
pub mod parameters;
pub mod prelude;
pub mod process;
pub mod random;
pub mod registry;
pub mod scenario;
pub mod simulation;
pub mod snapshot;
pub mod stop;
pub mod sums;
pub mod text;
