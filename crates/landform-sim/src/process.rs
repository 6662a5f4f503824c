//! What a process is: a struct of parameters that a scenario names and that is a Bevy plugin.

use std::any::TypeId;

use bevy_app::{App, Plugin};
use bevy_ecs::resource::Resource;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_ecs::world::World;
use landform_graph::Lattice;

use crate::agent::{
    AgentGroup, AgentState, Group, GroupListing, apply_staged, restore_group, save_group,
};
use crate::checkpoint::{Damage, Keep, Loader, Saver};
use crate::field::{EdgeField, EdgeFieldEntry, FieldEntry, NodeField, OnEdges};
use crate::ledger::Budget;
use crate::nodes::Node;
use crate::parameters::{Parameters, Problem};

/// Systems that run once when the stage of their process begins.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Begin;

/// Systems that run at every iteration of the stage of their process.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Iterate;

/// A process: parameters that deserialise from RON and a plugin that adds systems to
/// [`Begin`] and [`Iterate`].
///
/// The processes of a stage take turns in the order of the scenario; the systems of one process
/// run in the order that the plugin states (two that touch the same data without a stated
/// order are refused). `build` must not spawn or despawn nodes.
pub trait Process: Parameters + Plugin {
    /// Name in scenarios.
    const NAME: &'static str;

    /// Says which fields and groups the process uses and what it conserves.
    fn declare(&self, uses: &mut Declaration);

    /// Refuses parameters that do not go together or do not suit the lattice. Single ranges
    /// belong into the parameter's schema.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter, what was expected and what to do.
    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        Ok(())
    }

    /// Iterations after which the process has nothing left to do, if it has an end.
    fn iterations(&self) -> Option<u64> {
        None
    }
}

/// How a process uses a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Its values are needed and stay as they are; something must provide them.
    Reads,
    /// Its values stay as they are and are zero where nothing provides them.
    ReadsOrZero,
    /// Its values change.
    Writes,
}

/// What a process uses and conserves: see [`Process::declare`].
#[derive(Default)]
pub struct Declaration {
    pub(crate) fields: Vec<(FieldEntry, Access)>,
    pub(crate) edges: Vec<EdgeFieldEntry>,
    pub(crate) groups: Vec<GroupEntry>,
    pub(crate) budgets: Vec<Budget>,
    pub(crate) resources: Vec<ResourceEntry>,
    pub(crate) scratch: usize,
}

impl Declaration {
    /// The process reads field `F`; an initial condition or another process must provide it.
    pub fn reads<F: NodeField>(&mut self) -> &mut Self {
        self.fields.push((FieldEntry::stored::<F>(), Access::Reads));
        self
    }

    /// The process reads field `F`, which is zero where nothing provides it.
    pub fn reads_or_zero<F: NodeField>(&mut self) -> &mut Self {
        self.fields.push((FieldEntry::stored::<F>(), Access::ReadsOrZero));
        self
    }

    /// The process changes field `F`, which is zero where no initial condition provides it.
    pub fn writes<F: NodeField>(&mut self) -> &mut Self {
        self.fields.push((FieldEntry::stored::<F>(), Access::Writes));
        self
    }

    /// Offers a field that is computed from others whenever it is asked for.
    pub fn derives(
        &mut self,
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        values: fn(&World) -> Vec<f64>,
    ) -> &mut Self {
        let entry = FieldEntry::derived(name, unit, meaning, values);
        self.fields.push((entry, Access::Reads));
        self
    }

    /// The process uses field `F` on directed edges, which is zero at first.
    pub fn edges<F: EdgeField>(&mut self) -> &mut Self {
        self.edges.push(EdgeFieldEntry::of::<F>());
        self.resources.push(ResourceEntry {
            id: TypeId::of::<OnEdges<F>>(),
            name: F::NAME,
            codec: Some((OnEdges::<F>::save, OnEdges::<F>::restore)),
        });
        self
    }

    /// The process uses agents of group `G`.
    pub fn group<G: AgentGroup>(&mut self) -> &mut Self {
        self.groups.push(GroupEntry::of::<G>());
        self
    }

    /// The process keeps resource `R` between iterations, beside fields and groups. Checkpoints
    /// save it, and a run that is resumed puts it in the place of what [`Begin`] made.
    ///
    /// Every resource that a plugin or its systems put into the world is named here or by
    /// [`Declaration::rebuilds`]; the run is refused otherwise, since a resumed one would
    /// forget it. A `Local` of a system is forgotten in any case: keep nothing in it.
    pub fn keeps<R: Resource + Keep>(&mut self) -> &mut Self {
        self.resources.push(ResourceEntry::kept::<R>());
        self
    }

    /// The process has resource `R` to work with, which follows from parameters, lattice, seed
    /// and fields: a run that is resumed runs [`Begin`] on the fields of the checkpoint to make
    /// it anew. Nothing else may be remembered in it.
    pub fn rebuilds<R: Resource>(&mut self) -> &mut Self {
        self.resources.push(ResourceEntry::rebuilt::<R>());
        self
    }

    /// The process keeps a budget, which is checked after each of its turns.
    pub fn conserves(&mut self, budget: Budget) -> &mut Self {
        self.budgets.push(budget);
        self
    }

    /// The process takes up to `bytes` a node for buffers of its own, so that a run that cannot
    /// fit into memory is refused before it starts.
    pub fn scratch(&mut self, bytes: usize) -> &mut Self {
        self.scratch += bytes;
        self
    }

    /// The fields that the process names, with how it uses them.
    pub fn fields(&self) -> impl Iterator<Item = (&FieldEntry, Access)> {
        self.fields.iter().map(|(entry, access)| (entry, *access))
    }
}

/// Saves a part of the world into a checkpoint.
pub(crate) type Save = for<'a> fn(&'a World, &mut Saver<'_, 'a>);

/// Puts a part of a checkpoint into the world.
pub(crate) type Restore = fn(&mut World, &Loader<'_>) -> Result<(), Damage>;

/// A resource of a process without its type.
#[derive(Clone, Copy)]
pub(crate) struct ResourceEntry {
    /// Type of the resource.
    pub(crate) id: TypeId,
    /// Name in checkpoints.
    pub(crate) name: &'static str,
    /// How it is saved and restored; `None` for what follows from everything else.
    pub(crate) codec: Option<(Save, Restore)>,
}

impl ResourceEntry {
    fn kept<R: Resource + Keep>() -> Self {
        let save: Save = |world, to| {
            if let Some(resource) = world.get_resource::<R>() {
                resource.save(to);
            }
        };
        let restore: Restore = |world, from| {
            if !from.is_empty() {
                world.insert_resource(R::restore(from)?);
            }
            Ok(())
        };
        Self { codec: Some((save, restore)), ..Self::rebuilt::<R>() }
    }

    fn rebuilt<R: Resource>() -> Self {
        let path = std::any::type_name::<R>();
        let name = path.rsplit("::").next().unwrap_or(path);
        Self { id: TypeId::of::<R>(), name, codec: None }
    }
}

/// An agent group without its type.
#[derive(Clone, Copy)]
pub(crate) struct GroupEntry {
    pub(crate) id: TypeId,
    pub(crate) listing: GroupListing,
    pub(crate) save: Save,
    pub(crate) restore: Restore,
    pub(crate) bytes: usize,
    pub(crate) declare: fn(&mut World),
    pub(crate) make: fn(&mut World, usize),
    pub(crate) apply: fn(&mut World, u32),
}

impl GroupEntry {
    fn of<G: AgentGroup>() -> Self {
        Self {
            id: TypeId::of::<G>(),
            listing: GroupListing::of::<G>(),
            save: save_group::<G>,
            restore: restore_group::<G>,
            bytes: size_of::<G::State>() + 8 + Group::<G>::BYTES,
            declare: |world| world.register_required_components::<Node, AgentState<G>>(),
            make: |world, nodes| world.insert_resource(Group::<G>::new(nodes)),
            apply: apply_staged::<G>,
        }
    }
}

/// Parameters of a process as a resource, so that its systems can ask for them.
#[derive(Resource, Clone, Debug)]
pub struct Settings<P: Parameters>(pub P);

impl<P: Parameters> std::ops::Deref for Settings<P> {
    type Target = P;

    fn deref(&self) -> &P {
        &self.0
    }
}

/// What a process does when it is added to an app, in one word each.
pub trait ProcessApp {
    /// Makes the parameters available to systems as `Res<Settings<P>>`.
    fn insert_settings<P: Parameters>(&mut self, settings: &P) -> &mut Self;
}

impl ProcessApp for App {
    fn insert_settings<P: Parameters>(&mut self, settings: &P) -> &mut Self {
        self.insert_resource(Settings(settings.clone()))
    }
}
