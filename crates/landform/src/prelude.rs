//! What a process needs, in one `use landform::prelude::*`.

pub use bevy_app::{App, Plugin};
pub use bevy_ecs::change_detection::{Res, ResMut};
pub use bevy_ecs::schedule::IntoScheduleConfigs;
pub use landform_graph::{Boundary, Connectivity, Lattice};
pub use landform_sim::agent::{AgentGroup, Agents};
pub use landform_sim::clock::Clock;
pub use landform_sim::fault::Fault;
pub use landform_sim::field::{Bed, Field, FieldMut, NodeField, Sand};
pub use landform_sim::initial::{InitialCondition, InitialContext};
pub use landform_sim::ledger::{Budget, Ledger};
pub use landform_sim::metric::Metric;
pub use landform_sim::nodes::Space;
pub use landform_sim::parameters::Problem;
pub use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
pub use landform_sim::random::RandomStream;
pub use landform_sim::registry::Registry;
pub use landform_sim::snapshot::Snapshot;
pub use landform_sim::sums::sum;
