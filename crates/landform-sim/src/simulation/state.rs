//! The state of a run: fields, agents, ledger and what processes keep, in and out of checkpoints.

use std::any::TypeId;
use std::collections::{BTreeMap, BTreeSet};

use bevy_ecs::world::World;

use super::RunError;
use crate::checkpoint::{Checkpoint, Damage};
use crate::clock::Clock;
use crate::code::Code;
use crate::field::{FieldEntry, FieldTable};
use crate::ledger::Ledger;
use crate::parameters::Problem;
use crate::process::{Declaration, GroupEntry, ResourceEntry, Restore, Save};

/// What the state of a run consists of.
pub(super) struct State {
    fields: Vec<FieldEntry>,
    groups: Vec<GroupEntry>,
    kept: BTreeMap<&'static str, (Save, Restore)>,
    declared: BTreeSet<TypeId>,
}

impl State {
    /// The state of a run whose processes declare these things; `world` holds the resources of
    /// the framework and no others.
    ///
    /// # Errors
    /// When two kept resources bear one name.
    pub(super) fn new(
        world: &World,
        groups: Vec<GroupEntry>,
        uses: &[Declaration],
    ) -> Result<Self, Problem> {
        let resources = || uses.iter().flat_map(|uses| &uses.resources);
        let mut owners = BTreeMap::new();
        let mut kept = BTreeMap::new();
        for ResourceEntry { id, name, codec } in resources() {
            let Some(codec) = codec else { continue };
            if owners.insert(*name, *id).is_some_and(|other| other != *id) {
                let message = format!("two resources that processes keep are called `{name}`");
                return Err(Problem::new("stages", message, "a name for each type of resource")
                    .code(Code::Contradiction)
                    .help("rename one of the types in its plugin"));
            }
            kept.insert(*name, *codec);
        }
        let declared = resource_types(world).chain(resources().map(|entry| entry.id)).collect();
        let fields = world.resource::<FieldTable>().iter().copied().collect();
        Ok(Self { fields, groups, kept, declared })
    }

    /// Refuses resources that no process declares: a resumed run would forget them.
    pub(super) fn check(&self, world: &World, process: &str) -> Result<(), RunError> {
        let declared = |id: Option<TypeId>| id.is_none_or(|id| self.declared.contains(&id));
        if world.iter_resources().all(|(_, info, _)| declared(info.type_id())) {
            return Ok(());
        }
        Err(RunError::Plugin {
            process: process.to_owned(),
            message: "it puts a resource into the world that `declare` does not name: say \
                      `uses.keeps` of one that must outlast an interruption, `uses.rebuilds` of \
                      one that `Begin` makes anew from parameters and fields"
                .to_owned(),
        })
    }

    /// Saves everything but the clock.
    pub(super) fn save<'a>(&self, world: &'a World, checkpoint: &mut Checkpoint<'a>) {
        for field in &self.fields {
            field.save(world, &mut checkpoint.saver("fields"));
        }
        for group in &self.groups {
            (group.save)(world, &mut checkpoint.saver("groups").below(group.listing.name));
        }
        for (name, (save, _)) in &self.kept {
            save(world, &mut checkpoint.saver("state").below(name));
        }
        checkpoint.saver("run").keep("ledger", world.resource::<Ledger>());
    }

    /// Puts what was saved in the place of what is there, and sets the clock.
    pub(super) fn restore(
        &self,
        world: &mut World,
        checkpoint: &Checkpoint<'_>,
        clock: Clock,
    ) -> Result<(), Damage> {
        world.insert_resource(clock);
        for field in &self.fields {
            field.restore(world, &checkpoint.loader("fields"))?;
        }
        for group in &self.groups {
            (group.restore)(world, &checkpoint.loader("groups").below(group.listing.name))?;
        }
        for (name, (_, restore)) in &self.kept {
            restore(world, &checkpoint.loader("state").below(name))?;
        }
        world.insert_resource(checkpoint.loader("run").keep::<Ledger>("ledger")?);
        Ok(())
    }

    /// A hash of all stored fields, to tell runs apart that start differently: FNV-1a by words
    /// of eight bytes.
    pub(super) fn hash_of_fields(&self, world: &World) -> String {
        let mut fields = Checkpoint::default();
        self.fields.iter().for_each(|field| field.save(world, &mut fields.saver("fields")));
        let step = |hash: u64, word: u64| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        let all = fields.arrays.values().fold(0xcbf2_9ce4_8422_2325, |hash, array| {
            let (words, rest) = array.bytes().as_chunks();
            let hash = words.iter().fold(hash, |hash, word| step(hash, u64::from_le_bytes(*word)));
            rest.iter().fold(hash, |hash, &byte| step(hash, u64::from(byte)))
        });
        format!("{all:016x}")
    }
}

fn resource_types(world: &World) -> impl Iterator<Item = TypeId> {
    world.iter_resources().filter_map(|(_, info, _)| info.type_id())
}
