//! Values on edges: water that finds its level through pipes (O'Brien and Hodgins 1995,
//! "Dynamic simulation of splashing fluids"; Mei, Decaudin and Hu 2007, "Fast hydraulic erosion
//! simulation and visualization on GPU").

use landform_sim::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Water that flows over an edge.
pub struct Flow;

impl EdgeField for Flow {
    type Value = f64;
    const NAME: &'static str = "flow";
    const UNIT: &'static str = "m3/s";
    const MEANING: &'static str =
        "water that leaves the node over the edge, less than 0 if it comes in";
}

/// Acceleration of gravity, m/s².
const GRAVITY: f64 = 9.81;

/// Water that finds its level, as a lesson: it flows through a pipe along every edge.
///
/// The water in a pipe of cross-section `A` and length `l` is accelerated by the difference of
/// the levels at its ends, `dQ/dt = A g (level - level') / l`, and slowed down by friction; a
/// node never gives more than it has. Explicit steps: flows first, then levels. Conserves
/// water; nothing crosses open borders.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Pipes {
    /// Time that an iteration stands for.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "s"))]
    pub step_s: f64,
    /// Cross-section of a pipe as a share of the area of a node.
    #[schemars(range(min = 1e-6, max = 1.0))]
    pub cross_section: f64,
    /// Share of the flow that friction leaves after a second.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub persistence: f64,
}

impl Default for Pipes {
    fn default() -> Self {
        Self { step_s: 0.2, cross_section: 0.1, persistence: 0.9 }
    }
}

impl Process for Pipes {
    const NAME: &'static str = "Pipes";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Bed>().writes::<Water>().edges::<Flow>();
        uses.conserves(Budget::volume::<Water>(1e-12));
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        // The fastest oscillation, of neighbours against each other, must be seen twice.
        let squared = self.cross_section * GRAVITY * lattice.directions() as f64;
        let longest = (2.0 * lattice.spacing() / squared).sqrt();
        if self.step_s <= longest {
            return Ok(());
        }
        let message = format!("{} s is too long for stable flow", self.step_s);
        Err(Problem::new("step_s", message, format!("at most {longest:.3} s on this lattice")))
    }
}

impl Plugin for Pipes {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, (accelerate, run).chain());
    }
}

/// Levels drive the flows over the edges of every node, but no node gives more than it has.
fn accelerate(
    settings: Res<Settings<Pipes>>,
    space: Res<Space>,
    bed: Field<Bed>,
    water: Field<Water>,
    mut flow: ResMut<OnEdges<Flow>>,
) {
    let (bed, water) = (bed.values(), water.values());
    let area = space.spacing().powi(2);
    let push = settings.step_s * settings.cross_section * area * GRAVITY;
    let friction = settings.persistence.powf(settings.step_s);
    let level = |node: usize| bed[node] + water[node];
    for (node, depth) in water.iter().enumerate() {
        let flows = flow.leaving_mut(node);
        for edge in space.neighbours(node) {
            let flow = &mut flows[usize::from(edge.direction)];
            *flow = friction * *flow + push * (level(node) - level(edge.node)) / edge.distance;
        }
        let leaves = flows.iter().map(|flow| flow.max(0.0)).sum::<f64>() * settings.step_s;
        let share = (depth * area / leaves).min(1.0);
        flows.iter_mut().filter(|flow| **flow > 0.0).for_each(|flow| *flow *= share);
    }
}

/// What leaves one node comes in at the other: the flow over the reverse of the edge.
fn run(
    settings: Res<Settings<Pipes>>,
    space: Res<Space>,
    mut flow: ResMut<OnEdges<Flow>>,
    mut water: FieldMut<Water>,
) {
    let flow = flow.values_mut();
    let depth_m = settings.step_s / space.spacing().powi(2);
    for (node, water) in water.values_mut().iter_mut().enumerate() {
        for edge in space.neighbours(node) {
            let slot = space.slot(node, &edge);
            if flow[slot] < 0.0 {
                flow[slot] = -flow[space.reverse_slot(&edge)];
            }
            *water -= depth_m * flow[slot];
        }
        // Rounding may leave a node that gave everything a hair below zero.
        *water = water.max(0.0);
    }
}
