//! Agents in a world of their own.

use bevy_ecs::prelude::*;
use landform_graph::{Boundary, Connectivity, Lattice};

use super::*;
use crate::clock::Clock;
use crate::nodes::{Node, Space, spawn_nodes};

struct Walkers;

impl AgentGroup for Walkers {
    type State = u32;
    type Globals = usize;
    const NAME: &'static str = "walkers";
}

fn world(nodes: usize) -> World {
    let lattice = Lattice::plane([nodes, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]);
    world_on(lattice.expect("lattice"))
}

fn world_on(lattice: Lattice) -> World {
    let mut world = World::new();
    world.register_required_components::<Node, AgentState<Walkers>>();
    let nodes = lattice.node_count();
    spawn_nodes(&mut world, lattice);
    world.insert_resource(Group::<Walkers>::new(nodes));
    world.insert_resource(Clock::default());
    world
}

/// Runs `act` as the only system of an iteration and makes what it staged real.
fn iterate<M>(world: &mut World, act: impl IntoSystem<(), (), M>) {
    world.run_system_once(act).expect("system runs");
    let tick = world.resource::<Clock>().tick as u32 + 1;
    apply_staged::<Walkers>(world, tick);
    world.resource_mut::<Clock>().tick += 1;
}

use bevy_ecs::system::RunSystemOnce;

fn members(world: &World) -> Vec<usize> {
    world.resource::<Group<Walkers>>().members().iter().collect()
}

#[test]
fn a_node_takes_one_agent_of_a_group() {
    let mut world = world(200);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        assert!(agents.register(130, 7));
        assert!(!agents.register(130, 8), "another birth is on its way");
        assert!(agents.is_empty(), "births are staged");
    });
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        assert_eq!(agents.get(130), Some(&7));
        assert!(!agents.register(130, 9), "the node is taken");
        assert!(agents.deregister(130));
        assert!(!agents.deregister(130), "it leaves already");
        assert!(!agents.deregister(3), "there is none");
        assert_eq!(agents.len(), 1, "deaths are staged");
    });
    assert!(members(&world).is_empty());
}

#[test]
fn newborn_agents_wait_and_visits_run_in_node_order() {
    let mut world = world(300);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        for node in [250, 3, 64, 63] {
            agents.register(node, 0);
        }
    });
    let mut seen = Vec::new();
    let mut state = world.query::<&mut AgentState<Walkers>>();
    assert_eq!(state.iter(&world).count(), 300);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        agents.view().visit(|agents, node| {
            agents.register(node + 1, 1);
        });
    });
    // Within the same iteration a later process sees the newborn but does not let it act.
    world.resource_mut::<Clock>().tick -= 1;
    world.insert_resource(Seen::default());
    world
        .run_system_once(|mut agents: Agents<Walkers>, mut seen: ResMut<Seen>| {
            agents.view().visit(|_, node| seen.0.push(node));
        })
        .expect("system runs");
    seen.extend(world.resource::<Seen>().0.iter().copied());
    assert_eq!(seen, [3, 63, 64, 250]);
    assert_eq!(members(&world), [3, 4, 63, 64, 65, 250, 251]);
}

#[derive(Resource, Default)]
struct Seen(Vec<usize>);

#[test]
fn a_move_carries_the_state_and_respects_claims() {
    let mut world = world(10);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        agents.register(2, 22);
        agents.register(4, 44);
    });
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        *agents.get_mut(2).expect("an agent") += 1;
        assert!(agents.move_to(2, 3));
        assert!(!agents.move_to(4, 3), "the target is claimed");
        assert!(!agents.move_to(2, 5), "it leaves already");
        *agents.globals_mut() = agents.len();
    });
    assert_eq!(members(&world), [3, 4]);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let agents = agents.view();
        assert_eq!((agents.get(3), agents.get(4), *agents.globals()), (Some(&23), Some(&44), 2));
    });
}

/// A row of agents that all step east: the one in front moves, the others find their targets
/// taken, since every agent sees the group as it was.
#[test]
fn a_chain_moves_from_its_head() {
    let mut world = world(10);
    let step = |mut agents: Agents<Walkers>| {
        agents.view().visit(|agents, node| {
            agents.move_to(node, node + 1);
        });
    };
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        (2..5).for_each(|node| assert!(agents.register(node, node as u32)));
    });
    let mut rows = Vec::new();
    for _ in 0..4 {
        iterate(&mut world, step);
        rows.push(members(&world));
    }
    assert_eq!(rows, [[2, 3, 5], [2, 4, 6], [3, 5, 7], [4, 6, 8]]);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let agents = agents.view();
        assert_eq!([4, 6, 8].map(|node| agents.get(node).copied()), [Some(2), Some(3), Some(4)]);
    });
}

/// Of many claims on one node the first in node order is granted, and the rest stay unharmed.
#[test]
fn of_many_claims_the_first_is_granted() {
    let mut world = world(9);
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        assert_eq!([8, 0, 6, 2].map(|node| agents.register(node, node as u32)), [true; 4]);
    });
    iterate(&mut world, |mut agents: Agents<Walkers>| {
        let mut granted = Vec::new();
        let mut agents = agents.view();
        agents.visit(|agents, node| granted.push((node, agents.move_to(node, 4))));
        assert_eq!(granted, [(0, true), (2, false), (6, false), (8, false)]);
        assert!(!agents.register(4, 99), "a birth comes too late as well");
    });
    assert_eq!(members(&world), [2, 4, 6, 8]);
    assert_eq!(presence::<Walkers>(&world), [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
}

/// Births at every node of a volume at once, then deaths of all but one.
#[test]
fn a_volume_fills_and_empties_in_an_iteration() {
    let lattice = Lattice::volume([5, 6, 7], 1.0, Connectivity::Voxel26, [Boundary::Periodic; 3]);
    let mut world = world_on(lattice.expect("lattice"));
    iterate(&mut world, |space: Res<Space>, mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        assert!((0..space.node_count()).rev().all(|node| agents.register(node, node as u32)));
    });
    assert!(members(&world).into_iter().eq(0..210));
    iterate(&mut world, |space: Res<Space>, mut agents: Agents<Walkers>| {
        let mut agents = agents.view();
        agents.visit(|agents, node| {
            let around: usize =
                space.neighbours(node).filter_map(|edge| agents.get(edge.node)).count();
            assert_eq!(around, 26);
            assert_eq!(agents.get(node), Some(&(node as u32)));
            if node != 100 {
                assert!(agents.deregister(node));
            }
            *agents.globals_mut() += 1;
        });
        assert_eq!((agents.len(), *agents.globals()), (210, 210), "deaths are staged");
    });
    assert_eq!(members(&world), [100]);
}
