//! Agent groups: agents at some of the nodes, at most one of a group at each (thesis, 3.2.3).
//!
//! A group is a marker type. Its members live on the nodes: their state is a component of the
//! node's entity, so lookups by node cost an array access, and membership is a bit set, so
//! visits run in node order whatever happened before. Births, deaths and moves are staged and
//! take effect when the process that asked for them has finished its turn.

mod group;
mod listing;
mod members;
mod state;
mod view;

pub use group::{AgentGroup, AgentState, Group, presence};
pub use listing::{
    GroupListing, GroupSnapshot, GroupTable, GroupUse, Member, Quantity, Tally, UnknownGroup,
    UnknownQuantity,
};
pub use members::{NodeSet, NodesOfSet};
pub use view::{AgentView, Agents};

pub(crate) use group::apply_staged;
pub(crate) use state::{restore_group, save_group};

#[cfg(test)]
mod tests;
