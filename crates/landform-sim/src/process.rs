//! What a process is: a struct of parameters that a scenario names and that is a Bevy plugin.

use bevy_app::{App, Plugin};
use bevy_ecs::resource::Resource;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_ecs::world::World;
use landform_graph::Lattice;

use crate::agent::{AgentGroup, AgentState, Group, apply_staged};
use crate::field::{FieldEntry, NodeField};
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
    pub(crate) groups: Vec<GroupEntry>,
    pub(crate) budgets: Vec<Budget>,
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

    /// The process uses agents of group `G`.
    pub fn group<G: AgentGroup>(&mut self) -> &mut Self {
        self.groups.push(GroupEntry::of::<G>());
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

/// An agent group without its type.
#[derive(Clone, Copy)]
pub(crate) struct GroupEntry {
    pub(crate) name: &'static str,
    pub(crate) bytes: usize,
    pub(crate) declare: fn(&mut World),
    pub(crate) make: fn(&mut World, usize),
    pub(crate) apply: fn(&mut World, u32),
}

impl GroupEntry {
    fn of<G: AgentGroup>() -> Self {
        Self {
            name: G::NAME,
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
