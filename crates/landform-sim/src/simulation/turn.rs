//! A process at work in a stage.

use bevy_ecs::schedule::Schedule;

use crate::field::{EdgeFieldEntry, FieldEntry};
use crate::ledger::Budget;
use crate::process::GroupEntry;

/// One process of a stage.
pub(super) struct Turn {
    pub(super) name: &'static str,
    pub(super) written: Vec<FieldEntry>,
    pub(super) edges: Vec<EdgeFieldEntry>,
    pub(super) budgets: Vec<Budget>,
    pub(super) groups: Vec<GroupEntry>,
    pub(super) iterate: Schedule,
}
