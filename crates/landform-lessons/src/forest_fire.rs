//! Agents at some nodes: a forest fire, with trees and fires as two groups.
//!
//! Fire that runs through a forest of a given density stops or crosses it, with a sharp change at
//! the percolation threshold: 0.407 of the nodes with eight neighbours each, 0.593 with four
//! (Stauffer and Aharony 1994). With slow growth and rare lightning it is a model of
//! self-organized criticality (Drossel and Schwabl 1992).

use bevy_ecs::world::World;
use landform_sim::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The trees.
pub struct Trees;

impl AgentGroup for Trees {
    type State = ();
    type Globals = ();
    const NAME: &'static str = "trees";
}

/// The fires, each at the node of the tree that burns.
pub struct Fires;

impl AgentGroup for Fires {
    type State = ();
    type Globals = ();
    const NAME: &'static str = "fires";
}

/// Fires that a node has seen.
pub struct Burnt;

impl NodeField for Burnt {
    type Value = u32;
    const NAME: &'static str = "burnt";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "times that a tree has burnt at the node";
}

/// A forest fire, as a lesson: trees and fires are agents.
///
/// A fire sets the trees beside it on fire and burns down its own within an iteration. Trees
/// grow again and lightning strikes, if that is wanted (Drossel and Schwabl 1992). Works on
/// any lattice.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ForestFire {
    /// Share of the nodes with a tree at the beginning, drawn at random.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub tree_share: f64,
    /// Whether all trees of the west edge burn at the beginning.
    pub west_edge_burns: bool,
    /// Probability that a tree grows on a bare node in an iteration.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Drossel and Schwabl 1992, p"))]
    pub growth: f64,
    /// Probability that a tree is struck by lightning in an iteration.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Drossel and Schwabl 1992, f"))]
    pub lightning: f64,
}

impl Default for ForestFire {
    fn default() -> Self {
        Self { tree_share: 0.6, west_edge_burns: true, growth: 0.0, lightning: 0.0 }
    }
}

impl Process for ForestFire {
    const NAME: &'static str = "ForestFire";

    fn declare(&self, uses: &mut Declaration) {
        let forest = |world: &World| {
            let mut forest = presence::<Trees>(world);
            forest.iter_mut().zip(presence::<Fires>(world)).for_each(|(tree, fire)| *tree += fire);
            forest
        };
        let meaning = "0 bare ground, 1 a tree, 2 a tree on fire";
        uses.group::<Trees>().group::<Fires>().writes::<Burnt>();
        uses.derives("forest", "1", meaning, forest);
    }
}

impl Plugin for ForestFire {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, plant)
            .add_systems(Iterate, (burn, grow_and_strike).chain());
    }
}

/// The first trees and fires.
fn plant(
    settings: Res<Settings<ForestFire>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut trees: Agents<Trees>,
    mut fires: Agents<Fires>,
) {
    let random = RandomStream::new(clock.seed, "forest");
    let (mut trees, mut fires) = (trees.view(), fires.view());
    for node in 0..space.node_count() {
        if random.unit(0, node, 0) < settings.tree_share {
            trees.register(node, ());
            if settings.west_edge_burns && space.coordinates(node)[0] == 0 {
                fires.register(node, ());
            }
        }
    }
}

/// Every fire spreads to the trees beside it and goes out with its own. A new fire waits for the
/// next iteration, so fire runs one edge an iteration.
fn burn(
    space: Res<Space>,
    mut trees: Agents<Trees>,
    mut fires: Agents<Fires>,
    mut burnt: FieldMut<Burnt>,
) {
    let (mut trees, burnt) = (trees.view(), burnt.values_mut());
    fires.view().visit(|fires, node| {
        for edge in space.neighbours(node) {
            if trees.contains(edge.node) {
                fires.register(edge.node, ());
            }
        }
        trees.deregister(node);
        fires.deregister(node);
        burnt[node] += 1;
    });
}

/// Trees grow on bare ground, and lightning strikes trees.
fn grow_and_strike(
    settings: Res<Settings<ForestFire>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut trees: Agents<Trees>,
    mut fires: Agents<Fires>,
) {
    if settings.growth + settings.lightning == 0.0 {
        return;
    }
    let random = RandomStream::new(clock.seed, "growth and lightning");
    let (mut trees, mut fires) = (trees.view(), fires.view());
    for node in 0..space.node_count() {
        let chance = random.unit(clock.tick, node, 0);
        match trees.contains(node) {
            true if chance < settings.lightning => _ = fires.register(node, ()),
            false if chance < settings.growth => _ = trees.register(node, ()),
            _ => {}
        }
    }
}
