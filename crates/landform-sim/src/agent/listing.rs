//! Agent groups by name, for metrics and tables.

use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{AgentGroup, AgentState, Group};

/// A number that every agent of a group knows, by name: see [`AgentGroup::QUANTITIES`].
#[derive(Clone, Copy, Debug)]
pub struct Quantity<S> {
    /// Name in scenarios and tables, without the unit.
    pub name: &'static str,
    /// Unit of the values; `1` when there is none.
    pub unit: &'static str,
    /// The number in an agent's state.
    pub of: fn(&S) -> f64,
}

impl<S> Quantity<S> {
    /// The quantity `name` in `unit` (`1` when it has none), read from the state by `of`.
    pub const fn new(name: &'static str, unit: &'static str, of: fn(&S) -> f64) -> Self {
        Self { name, unit, of }
    }
}

/// How many agents a group has and had.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Agents that there are.
    pub members: u64,
    /// Agents that were born since the run began; moves are no births.
    pub births: u64,
    /// Agents that died since the run began; moves are no deaths.
    pub deaths: u64,
}

/// An agent of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// The node it stands at.
    pub node: usize,
    /// Iterations that were done when it came to this node, by birth or by its latest move.
    pub since: u32,
}

/// What is known of an agent group without its type.
#[derive(Clone, Copy, Debug)]
pub struct GroupListing {
    /// Name in scenarios, tables and reports.
    pub name: &'static str,
    quantities: fn() -> Vec<(&'static str, &'static str)>,
    tally: fn(&World) -> Tally,
    members: fn(&World) -> Vec<Member>,
    values: fn(&World, usize) -> Vec<f64>,
}

impl GroupListing {
    /// The listing of group `G`.
    pub fn of<G: AgentGroup>() -> Self {
        Self {
            name: G::NAME,
            quantities: || G::QUANTITIES.iter().map(|each| (each.name, each.unit)).collect(),
            tally: |world| world.get_resource::<Group<G>>().map(Group::tally).unwrap_or_default(),
            members: members::<G>,
            values: values::<G>,
        }
    }

    /// Name and unit of each quantity, in the order of the group.
    pub fn quantities(&self) -> Vec<(&'static str, &'static str)> {
        (self.quantities)()
    }

    /// Number and unit of the quantity called `name`.
    ///
    /// # Errors
    /// [`UnknownQuantity`] lists the names there are.
    pub fn quantity(&self, name: &str) -> Result<(usize, &'static str), UnknownQuantity> {
        let known = self.quantities();
        let number = known.iter().position(|(each, _)| *each == name);
        number.map(|number| (number, known[number].1)).ok_or_else(|| UnknownQuantity {
            group: self.name,
            name: name.to_owned(),
            known: known.iter().map(|(each, _)| *each).collect(),
        })
    }
}

/// A group, and perhaps a quantity of it, that a metric or an output needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupUse {
    /// Name of the group.
    pub group: String,
    /// Name of the quantity.
    pub quantity: Option<String>,
}

/// The agents of one group at one moment, in node order.
#[derive(Clone, Copy)]
pub struct GroupSnapshot<'a> {
    listing: &'a GroupListing,
    world: &'a World,
}

impl<'a> GroupSnapshot<'a> {
    pub(crate) fn new(listing: &'a GroupListing, world: &'a World) -> Self {
        Self { listing, world }
    }

    /// What is known of the group.
    pub fn listing(&self) -> &'a GroupListing {
        self.listing
    }

    /// How many agents there are and were.
    pub fn tally(&self) -> Tally {
        (self.listing.tally)(self.world)
    }

    /// The agents, in node order.
    pub fn members(&self) -> Vec<Member> {
        (self.listing.members)(self.world)
    }

    /// A quantity of every agent, in the order of [`GroupSnapshot::members`].
    ///
    /// # Errors
    /// [`UnknownQuantity`] lists the names there are.
    pub fn values(&self, quantity: &str) -> Result<Vec<f64>, UnknownQuantity> {
        let (number, _) = self.listing.quantity(quantity)?;
        Ok((self.listing.values)(self.world, number))
    }
}

/// A name that is no agent group of the run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no group of agents is called `{name}`; {}", listed("the groups are", known))]
pub struct UnknownGroup {
    /// The name asked for.
    pub name: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

/// A name that is no quantity of a group.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("agents of `{group}` know no `{name}`; {}", listed("they know", known))]
pub struct UnknownQuantity {
    /// The group.
    pub group: &'static str,
    /// The name asked for.
    pub name: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

fn listed(what: &str, known: &[&str]) -> String {
    match known {
        [] => format!("{what}: none"),
        _ => format!("{what}: {}", known.join(", ")),
    }
}

/// Every agent group of a run, in the order of declaration.
#[derive(Resource, Clone, Debug, Default)]
pub struct GroupTable(pub(crate) Vec<GroupListing>);

impl GroupTable {
    /// The group called `name`.
    ///
    /// # Errors
    /// [`UnknownGroup`] lists the names there are.
    pub fn get(&self, name: &str) -> Result<&GroupListing, UnknownGroup> {
        self.0.iter().find(|listing| listing.name == name).ok_or_else(|| UnknownGroup {
            name: name.to_owned(),
            known: self.0.iter().map(|listing| listing.name).collect(),
        })
    }

    /// The groups in the order of their declaration.
    pub fn iter(&self) -> impl Iterator<Item = &GroupListing> {
        self.0.iter()
    }
}

fn members<G: AgentGroup>(world: &World) -> Vec<Member> {
    let Some(group) = world.get_resource::<Group<G>>() else { return Vec::new() };
    let member = |node| Member { node, since: group.born[node] };
    group.members.iter().map(member).collect()
}

fn values<G: AgentGroup>(world: &World, quantity: usize) -> Vec<f64> {
    let Some(group) = world.get_resource::<Group<G>>() else { return Vec::new() };
    let Some(quantity) = G::QUANTITIES.get(quantity) else { return Vec::new() };
    let Some(mut states) = world.try_query::<&AgentState<G>>() else { return Vec::new() };
    let column = states.contiguous_iter(world).ok().and_then(|mut all| all.next()).unwrap_or(&[]);
    group.members.iter().map(|node| (quantity.of)(&column[node].0)).collect()
}
