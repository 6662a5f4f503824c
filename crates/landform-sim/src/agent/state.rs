//! Groups of agents in checkpoints: members, their states and stamps, globals, what is staged.

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::world::World;

use super::{AgentGroup, AgentState, Group, NodeSet};
use crate::checkpoint::{Damage, Loader, Saver};

/// Saves a group: for each member, in node order, its node, the stamp of its birth and its state.
pub(crate) fn save_group<'a, G: AgentGroup>(world: &'a World, to: &mut Saver<'_, 'a>) {
    let Some(group) = world.get_resource::<Group<G>>() else { return };
    let states = stored_states::<G>(world);
    let members: Vec<u32> = group.members.iter().map(|node| node as u32).collect();
    to.owned("born", members.iter().map(|&node| group.born[node as usize]).collect());
    let of_members: Vec<G::State> = members.iter().map(|&node| states[node as usize].0).collect();
    to.value("states", &of_members);
    to.owned("members", members);
    to.keep("globals", &group.globals);
    to.value("tally", &(group.tally, group.moves));
    to.value("births", &group.births);
    to.value("deaths", &group.deaths);
}

/// Puts a saved group in the place of the present one.
pub(crate) fn restore_group<G: AgentGroup>(
    world: &mut World,
    from: &Loader<'_>,
) -> Result<(), Damage> {
    let nodes = stored_states::<G>(world).len();
    let mut group = Group::<G>::new(nodes);
    let members = from.array::<u32>("members")?;
    let born = from.array_of::<u32>("born", members.len())?;
    let states: Vec<G::State> = from.value("states")?;
    group.globals = from.keep("globals")?;
    (group.tally, group.moves) = from.value("tally")?;
    group.births = from.value("births")?;
    group.deaths = from.value("deaths")?;
    let births = group.births.iter().map(|(node, _)| node);
    let known = members.iter().chain(births).chain(&group.deaths);
    if known.max().is_some_and(|&node| node as usize >= nodes) || states.len() != members.len() {
        return Err(from.refuse("members", "they do not fit the nodes or their states"));
    }
    let set = |nodes: &mut NodeSet, node: u32| {
        nodes.insert(node as usize);
    };
    members.iter().for_each(|&node| set(&mut group.members, node));
    group.births.iter().for_each(|&(node, _)| set(&mut group.claimed, node));
    group.deaths.iter().for_each(|&node| set(&mut group.leaving, node));
    members.iter().zip(born).for_each(|(&node, &tick)| group.born[node as usize] = tick);
    let mut columns = world.query::<&mut AgentState<G>>();
    let column = columns.contiguous_iter_mut(world).ok().and_then(|mut all| all.next());
    if let Some(column) = column {
        let column = ContiguousMut::bypass_change_detection_split(column).0;
        members.iter().zip(states).for_each(|(&node, state)| column[node as usize].0 = state);
    }
    world.insert_resource(group);
    Ok(())
}

/// The states of all nodes, of which only those of members mean something.
fn stored_states<G: AgentGroup>(world: &World) -> &[AgentState<G>] {
    let Some(mut states) = world.try_query::<&AgentState<G>>() else { return &[] };
    let slices = states.contiguous_iter(world).ok();
    slices.and_then(|mut slices| slices.next()).unwrap_or(&[])
}
