//! Moving agents: walkers wear trails, and trails lead walkers (after the active walkers of
//! Helbing, Keltsch and Molnar 1997, "Modelling the evolution of human trail systems").

use landform_sim::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The walkers: at most one at a node.
pub struct Walkers;

impl AgentGroup for Walkers {
    /// Node that the walker wants to reach.
    type State = u32;
    /// Walks that came to their goal.
    type Globals = u64;
    const NAME: &'static str = "walkers";
}

/// How far the ground is worn by feet.
pub struct Wear;

impl NodeField for Wear {
    type Value = f64;
    const NAME: &'static str = "wear";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "wear of the ground by feet, 0 grown over to 1 bare";
    const LEAST: f64 = 0.0;
}

/// Walkers that wear trails, as a lesson: agents that move and leave marks.
///
/// A walker steps to the free neighbour that leads it best: straight to its goal, over worn and
/// level ground. Each step wears the ground, which grows over again. Near its goal a walker
/// gets another one at random. Conserves the walkers. Distances are straight, so walkers do not
/// use periodic borders to come nearer.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Trails {
    /// Number of walkers.
    #[schemars(range(min = 1, max = 1000000))]
    pub walkers: usize,
    /// Number of places, drawn at random, between which they walk.
    #[schemars(range(min = 2, max = 1000))]
    pub places: usize,
    /// Detour, as a share of a step, that bare ground is worth.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub attraction: f64,
    /// Detour, as a share of a step, that a slope of 1 is worth.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub effort: f64,
    /// Share of the wear that is still missing which a step adds.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub wear_by_step: f64,
    /// Share of the wear that grows over in an iteration.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub recovery: f64,
}

impl Default for Trails {
    fn default() -> Self {
        Self {
            walkers: 300,
            places: 8,
            attraction: 0.6,
            effort: 2.0,
            wear_by_step: 0.1,
            recovery: 0.003,
        }
    }
}

impl Process for Trails {
    const NAME: &'static str = "Trails";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Bed>().writes::<Wear>().group::<Walkers>();
    }
}

impl Plugin for Trails {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, set_out)
            .add_systems(Iterate, (grow_over, walk).chain());
    }
}

impl Trails {
    /// The node that a walker at `node` wants to reach next.
    fn goal(&self, clock: &Clock, space: &Space, node: usize) -> u32 {
        let choice = RandomStream::new(clock.seed, "goals").unit(clock.tick, node, 0);
        let place = (choice * self.places as f64) as usize;
        let at = RandomStream::new(clock.seed, "places").unit(0, place, 0);
        (at * space.node_count() as f64) as u32
    }
}

/// Walkers start at random nodes, as many as are missing.
fn set_out(
    settings: Res<Settings<Trails>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut walkers: Agents<Walkers>,
) {
    let random = RandomStream::new(clock.seed, "starts");
    let mut walkers = walkers.view();
    let nodes = space.node_count();
    let mut missing = settings.walkers.min(nodes / 2).saturating_sub(walkers.len());
    for attempt in 0.. {
        if missing == 0 {
            break;
        }
        let node = (random.unit(clock.tick, attempt, 0) * nodes as f64) as usize;
        missing -= usize::from(walkers.register(node, settings.goal(&clock, &space, node)));
    }
}

/// Trails grow over.
fn grow_over(settings: Res<Settings<Trails>>, mut wear: FieldMut<Wear>) {
    wear.values_mut().iter_mut().for_each(|wear| *wear *= 1.0 - settings.recovery);
}

/// Every walker takes a step towards its goal and wears the ground.
fn walk(
    settings: Res<Settings<Trails>>,
    clock: Res<Clock>,
    space: Res<Space>,
    bed: Field<Bed>,
    mut wear: FieldMut<Wear>,
    mut walkers: Agents<Walkers>,
) {
    let (bed, wear) = (bed.values(), wear.values_mut());
    walkers.view().visit(|walkers, node| {
        let Some(goal) = walkers.get_mut(node) else { return };
        let at = space.position(*goal as usize);
        let far = |node: usize| space.position(node).distance(at);
        if far(node) < 3.0 * space.spacing() {
            *goal = settings.goal(&clock, &space, node);
            *walkers.globals_mut() += 1;
            return;
        }
        let lead = |edge: &Edge| {
            let progress = (far(node) - far(edge.node)) / edge.distance;
            let slope = (bed[edge.node] - bed[node]).abs() / edge.distance;
            progress + settings.attraction * wear[edge.node] - settings.effort * slope
        };
        let free = space.neighbours(node).filter(|edge| !walkers.contains(edge.node));
        let best = free.max_by(|a, b| lead(a).total_cmp(&lead(b)));
        if best.is_some_and(|best| walkers.move_to(node, best.node)) {
            wear[node] += settings.wear_by_step * (1.0 - wear[node]);
        }
    });
}
