//! What a group of agents holds: state on nodes, members, globals, staged births and deaths.

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::component::Component;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{NodeSet, Quantity, Tally};
use crate::checkpoint::Keep;

/// A group of agents, at most one at a node. Implement it for an empty marker type.
pub trait AgentGroup: Send + Sync + 'static {
    /// What each agent knows. Derive serde's `Serialize` and `Deserialize` for checkpoints.
    type State: Serialize + DeserializeOwned + Copy + Default + Send + Sync + 'static;
    /// What the whole group knows (search radius, largest value met, ...).
    type Globals: Keep + Default + Send + Sync + 'static;
    /// Name of the group in scenarios, tables and reports.
    const NAME: &'static str;
    /// Numbers of an agent's state that metrics and tables may name; none when missing.
    const QUANTITIES: &'static [Quantity<Self::State>] = &[];
}

/// The component that holds the state of a group's agent at a node; meaningless where the
/// group has no agent. It is on every node, so that node order survives births and deaths.
#[derive(Component)]
pub struct AgentState<G: AgentGroup>(pub(super) G::State);

impl<G: AgentGroup> Default for AgentState<G> {
    fn default() -> Self {
        Self(G::State::default())
    }
}

/// Members, globals and staged changes of a group.
#[derive(Resource)]
pub struct Group<G: AgentGroup> {
    /// What the whole group knows.
    pub globals: G::Globals,
    pub(super) members: NodeSet,
    pub(super) claimed: NodeSet,
    pub(super) leaving: NodeSet,
    pub(super) born: Vec<u32>,
    pub(super) births: Vec<(u32, G::State)>,
    pub(super) deaths: Vec<u32>,
    /// Births that are the second half of a move.
    pub(super) moves: usize,
    pub(super) tally: Tally,
}

impl<G: AgentGroup> Group<G> {
    /// A group without members over `nodes` nodes.
    pub(crate) fn new(nodes: usize) -> Self {
        Self {
            globals: G::Globals::default(),
            members: NodeSet::new(nodes),
            claimed: NodeSet::new(nodes),
            leaving: NodeSet::new(nodes),
            born: vec![0; nodes],
            births: Vec::new(),
            deaths: Vec::new(),
            moves: 0,
            tally: Tally::default(),
        }
    }

    /// The members that there are, without what is staged.
    pub fn members(&self) -> &NodeSet {
        &self.members
    }

    /// How many agents there are and were.
    pub fn tally(&self) -> Tally {
        Tally { members: self.members.len() as u64, ..self.tally }
    }

    /// Counts what is about to become real.
    fn count_staged(&mut self) {
        let moves = std::mem::take(&mut self.moves);
        self.tally.births += (self.births.len() - moves) as u64;
        self.tally.deaths += (self.deaths.len() - moves) as u64;
    }

    /// Bytes that a group takes a node besides the component.
    pub(crate) const BYTES: usize = 5;
}

/// 1 at the nodes where an agent of `G` stands and 0 elsewhere, as the values of a derived
/// field: see [`crate::process::Declaration::derives`].
pub fn presence<G: AgentGroup>(world: &World) -> Vec<f64> {
    let Some(group) = world.get_resource::<Group<G>>() else { return Vec::new() };
    let mut presence = vec![0.0; group.born.len()];
    group.members.iter().for_each(|node| presence[node] = 1.0);
    presence
}

/// Makes staged deaths and then births of `G` real, stamped with `tick`. No two births are at
/// one node, so their order does not matter.
pub(crate) fn apply_staged<G: AgentGroup>(world: &mut World, tick: u32) {
    let mut states = world.query::<&mut AgentState<G>>();
    world.resource_scope::<Group<G>, ()>(|world, mut group| {
        let group = &mut *group;
        group.count_staged();
        for node in group.deaths.drain(..) {
            group.members.remove(node as usize);
            group.leaving.remove(node as usize);
        }
        if group.births.is_empty() {
            return;
        }
        let Some(column) = states.contiguous_iter_mut(world).ok().and_then(|mut all| all.next())
        else {
            return;
        };
        let column = ContiguousMut::bypass_change_detection_split(column).0;
        for (node, state) in group.births.drain(..) {
            let node = node as usize;
            column[node].0 = state;
            group.born[node] = tick;
            group.members.insert(node);
            group.claimed.remove(node);
        }
    });
}
