//! Node entities: one for every node of the lattice, spawned once and in node order.

use bevy_ecs::component::Component;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use landform_graph::Lattice;

/// Marks the entity of a node. Row in the table = index of the node in the lattice.
#[derive(Component, Clone, Copy, Default)]
pub struct Node;

/// The lattice that the agents of the run live on.
#[derive(Resource, Clone, Debug)]
pub struct Space(pub Lattice);

impl std::ops::Deref for Space {
    type Target = Lattice;

    fn deref(&self) -> &Lattice {
        &self.0
    }
}

/// Bytes that the entity itself takes a node (location, allocator, table and archetype rows),
/// as measured with bevy_ecs 0.20: up to 72 after a doubling of the entity list.
pub const ENTITY_BYTES: usize = 72;

/// Spawns one entity a node. Every field must have been declared before.
pub(crate) fn spawn_nodes(world: &mut World, lattice: Lattice) {
    let count = lattice.node_count();
    world.insert_resource(Space(lattice));
    world.spawn_batch(std::iter::repeat_n(Node, count));
}
