//! What a process needs, in one `use`: `landform::prelude::*` of the facade is the same.

pub use bevy_app::{App, Plugin};
pub use bevy_ecs::change_detection::{Res, ResMut};
pub use bevy_ecs::schedule::IntoScheduleConfigs;
pub use landform_graph::{Boundary, Connectivity, Edge, Lattice};

pub use crate::agent::{AgentGroup, Agents, Quantity, presence};
pub use crate::clock::Clock;
pub use crate::fault::Fault;
pub use crate::field::{Bed, EdgeField, Field, FieldMut, NodeField, OnEdges, Sand, Water};
pub use crate::initial::{InitialCondition, InitialContext};
pub use crate::ledger::{Budget, Ledger};
pub use crate::metric::Metric;
pub use crate::nodes::Space;
pub use crate::notes::Notes;
pub use crate::parameters::Problem;
pub use crate::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
pub use crate::random::RandomStream;
pub use crate::registry::Registry;
pub use crate::snapshot::Snapshot;
pub use crate::sums::sum;
