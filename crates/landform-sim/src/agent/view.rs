//! The system parameter through which a process works with its agents.

use bevy_ecs::change_detection::{ContiguousMut, Res, ResMut};
use bevy_ecs::system::{Query, SystemParam};

use super::{AgentGroup, AgentState, Group};
use crate::clock::Clock;

/// Access to the agents of group `G` in a system: see [`Agents::view`].
#[derive(SystemParam)]
pub struct Agents<'w, 's, G: AgentGroup> {
    states: Query<'w, 's, &'static mut AgentState<G>>,
    group: ResMut<'w, Group<G>>,
    clock: Res<'w, Clock>,
}

impl<G: AgentGroup> Agents<'_, '_, G> {
    /// The agents for lookups, visits and staged changes.
    pub fn view(&mut self) -> AgentView<'_, G> {
        let states = self.states.contiguous_iter_mut().ok().and_then(|mut slices| slices.next());
        AgentView {
            states: states
                .map_or(&mut [], |column| ContiguousMut::bypass_change_detection_split(column).0),
            group: &mut self.group,
            tick: self.clock.tick as u32,
        }
    }
}

/// The agents of a group, open for lookups, visits and staged changes.
pub struct AgentView<'a, G: AgentGroup> {
    states: &'a mut [AgentState<G>],
    group: &'a mut Group<G>,
    tick: u32,
}

impl<G: AgentGroup> AgentView<'_, G> {
    /// Number of agents.
    pub fn len(&self) -> usize {
        self.group.members.len()
    }

    /// Whether the group has no agent.
    pub fn is_empty(&self) -> bool {
        self.group.members.is_empty()
    }

    /// Whether an agent of the group stands at `node`.
    #[inline]
    pub fn contains(&self, node: usize) -> bool {
        self.group.members.contains(node)
    }

    /// State of the agent at `node`.
    #[inline]
    pub fn get(&self, node: usize) -> Option<&G::State> {
        self.contains(node).then(|| &self.states[node].0)
    }

    /// State of the agent at `node`, for direct communication.
    #[inline]
    pub fn get_mut(&mut self, node: usize) -> Option<&mut G::State> {
        self.contains(node).then(|| &mut self.states[node].0)
    }

    /// Nodes with an agent, in node order.
    pub fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.group.members.iter()
    }

    /// What the whole group knows.
    pub fn globals(&self) -> &G::Globals {
        &self.group.globals
    }

    /// What the whole group knows, for writing.
    pub fn globals_mut(&mut self) -> &mut G::Globals {
        &mut self.group.globals
    }

    /// Stages a new agent at `node`. `false`, and nothing happens, when an agent of the group
    /// stands there or another one is on its way (thesis, 3.2.3, registration).
    pub fn register(&mut self, node: usize, state: G::State) -> bool {
        if self.group.members.contains(node) || !self.group.claimed.insert(node) {
            return false;
        }
        self.group.births.push((node as u32, state));
        true
    }

    /// Stages the removal of the agent at `node`. `false` when there is none or it leaves already.
    pub fn deregister(&mut self, node: usize) -> bool {
        if !self.group.members.contains(node) || !self.group.leaving.insert(node) {
            return false;
        }
        self.group.deaths.push(node as u32);
        true
    }

    /// Stages a move with the agent's present state. `false` when it cannot leave or the target
    /// is taken. The agent may act again in the next iteration.
    pub fn move_to(&mut self, from: usize, to: usize) -> bool {
        let Some(&state) = self.get(from) else { return false };
        if self.group.leaving.contains(from) || !self.register(to, state) {
            return false;
        }
        self.group.moves += 1;
        self.deregister(from)
    }

    /// Calls `act` for every agent that was there before this iteration, in node order.
    /// Newborn agents wait for the next iteration (thesis, 3.2.3, parity).
    pub fn visit(&mut self, mut act: impl FnMut(&mut Self, usize)) {
        for index in 0..self.group.members.word_count() {
            for node in self.group.members.word(index) {
                if self.group.born[node] <= self.tick {
                    act(self, node);
                }
            }
        }
    }
}
