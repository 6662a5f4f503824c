//! Moving agents that settle: diffusion-limited aggregation on a lattice (Witten and Sander 1981).

use landform_sim::prelude::*;
use landform_sim::random::unit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The particles that still drift: at most one at a node.
pub struct Drifters;

impl AgentGroup for Drifters {
    type State = ();
    /// Particles that have settled.
    type Globals = u64;
    const NAME: &'static str = "drifters";
}

/// Which particle has settled where.
pub struct Arrival;

impl NodeField for Arrival {
    type Value = u32;
    const NAME: &'static str = "arrival";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of the particle that has settled at the node, 1 for what it \
                                   all begins with, 0 where there is none";
    const LEAST: f64 = 0.0;
}

/// What the aggregate grows from, if `arrival` is 0 everywhere.
#[derive(Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum AggregationSeed {
    /// The node in the middle.
    #[default]
    Middle,
    /// The southern row of a map, the lowest layer of a volume.
    Floor,
}

/// Diffusion-limited aggregation with agents, as a lesson: particles drift over edges at random and
/// settle beside settled ones.
///
/// Particles enter at nodes drawn at random on the open borders; with `Floor` only on the one
/// opposite. Many drift at a time, so the aggregate is denser than if they came one by one:
/// the fewer, the nearer to the model of Witten and Sander. Conserves the particles. Works on any
/// lattice with an open border.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Aggregation {
    /// Number of particles that drift at a time.
    #[schemars(range(min = 1, max = 1000000))]
    pub drifters: usize,
    /// Number of particles that settle in all.
    #[schemars(range(min = 1, max = 4000000000_u32))]
    pub particles: u32,
    /// Probability that a particle beside a settled one settles in an iteration.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "Xu 2008, section 2.3"))]
    pub sticking: f64,
    /// What it grows from.
    pub seed: AggregationSeed,
}

impl Default for Aggregation {
    fn default() -> Self {
        Self { drifters: 300, particles: 100_000, sticking: 1.0, seed: AggregationSeed::Middle }
    }
}

impl Process for Aggregation {
    const NAME: &'static str = "Aggregation";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Arrival>().group::<Drifters>();
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if entrances(lattice, self.seed).is_empty() {
            let problem = "particles enter at an open border, and there is none";
            return Err(Problem::new("", problem, "a domain with an open border"));
        }
        Ok(())
    }
}

impl Plugin for Aggregation {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, lay_seed)
            .add_systems(Iterate, (drift, enter).chain());
    }
}

/// The borders where particles come in: axis and coordinate.
fn entrances(lattice: &Lattice, seed: AggregationSeed) -> Vec<(usize, usize)> {
    let size = lattice.size();
    let dimensions = if lattice.depth() > 1 { 3 } else { 2 };
    match seed {
        // Row 0 is the northern one.
        AggregationSeed::Floor if dimensions == 2 => vec![(1, 0)],
        AggregationSeed::Floor => vec![(2, size[2] - 1)],
        AggregationSeed::Middle => (0..dimensions)
            .filter(|&axis| !lattice.is_periodic(axis))
            .flat_map(|axis| [(axis, 0), (axis, size[axis] - 1)])
            .collect(),
    }
}

/// Where the aggregate begins, unless something has settled already.
fn lay_seed(
    settings: Res<Settings<Aggregation>>,
    space: Res<Space>,
    mut arrival: FieldMut<Arrival>,
) {
    let arrival = arrival.values_mut();
    if arrival.iter().any(|&number| number > 0) {
        return;
    }
    let [width, height, depth] = space.size();
    match settings.seed {
        AggregationSeed::Middle => arrival[space.node([width / 2, height / 2, depth / 2])] = 1,
        AggregationSeed::Floor if depth == 1 => arrival[width * (height - 1)..].fill(1),
        AggregationSeed::Floor => arrival[..width * height].fill(1),
    }
}

/// Every particle settles beside a settled one, or takes a step.
fn drift(
    settings: Res<Settings<Aggregation>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut arrival: FieldMut<Arrival>,
    mut drifters: Agents<Drifters>,
) {
    let random = RandomStream::new(clock.seed, "drift");
    let arrival = arrival.values_mut();
    drifters.view().visit(|drifters, node| {
        let [chance, way, ..] = random.block(clock.tick, node, 0);
        let beside = space.neighbours(node).any(|edge| arrival[edge.node] > 0);
        let settles = arrival[node] == 0 && beside && unit(chance) < settings.sticking;
        if settles && *drifters.globals() < u64::from(settings.particles) {
            *drifters.globals_mut() += 1;
            arrival[node] = (*drifters.globals() + 1) as u32;
        }
        // What has settled, or stands where something did before it, drifts no more.
        if arrival[node] > 0 {
            drifters.deregister(node);
            return;
        }
        let edges = space.neighbours(node).count();
        let step = space.neighbours(node).nth((unit(way) * edges as f64) as usize);
        if let Some(edge) = step.filter(|edge| arrival[edge.node] == 0) {
            drifters.move_to(node, edge.node);
        }
    });
}

/// New particles come in, as many as are missing and find a free node.
fn enter(
    settings: Res<Settings<Aggregation>>,
    clock: Res<Clock>,
    space: Res<Space>,
    arrival: Field<Arrival>,
    mut drifters: Agents<Drifters>,
) {
    let mut drifters = drifters.view();
    let left = u64::from(settings.particles).saturating_sub(*drifters.globals());
    let wanted = settings.drifters.min(usize::try_from(left).unwrap_or(usize::MAX));
    let missing = wanted.saturating_sub(drifters.len());
    let borders = entrances(&space, settings.seed);
    let random = RandomStream::new(clock.seed, "entrances");
    for number in 0..missing {
        let [choice, x, y, z] = random.block(clock.tick, number, 0).map(unit);
        let size = space.size();
        let mut at = [0, 1, 2].map(|axis| ([x, y, z][axis] * size[axis] as f64) as usize);
        let (axis, coordinate) = borders[(choice * borders.len() as f64) as usize];
        at[axis] = coordinate;
        let node = space.node(at);
        if arrival.values()[node] == 0 {
            drifters.register(node, ());
        }
    }
}
