//! Rain: drops that run downhill, as agents of one group.

use landform::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

// ANCHOR: group
/// The drops that run over the ground: at most one at a node.
pub struct Drops;

impl AgentGroup for Drops {
    /// Steps that the drop has run.
    type State = u32;
    /// Steps of the drop that ran furthest.
    type Globals = u32;
    const NAME: &'static str = "drops";
}
// ANCHOR_END: group

// ANCHOR: field
/// How many drops have left a node for a lower one.
pub struct Tracks;

impl NodeField for Tracks {
    type Value = u32;
    const NAME: &'static str = "tracks";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "drops that have run over the node";
}
// ANCHOR_END: field

/// Drops of rain that run down the steepest edge and leave tracks, until they reach a hollow.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rain {
    /// Drops that fall in an iteration, each at a random node.
    #[schemars(range(min = 1, max = 1000000))]
    pub drops: usize,
}

impl Default for Rain {
    fn default() -> Self {
        Self { drops: 1000 }
    }
}

// ANCHOR: process
impl Process for Rain {
    const NAME: &'static str = "Rain";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<Bed>().writes::<Tracks>().group::<Drops>();
    }
}

impl Plugin for Rain {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, (run, fall).chain());
    }
}
// ANCHOR_END: process

// ANCHOR: run
/// Every drop runs one step; where the next node is taken it waits.
fn run(
    space: Res<Space>,
    bed: Field<Bed>,
    mut tracks: FieldMut<Tracks>,
    mut drops: Agents<Drops>,
) {
    let (bed, tracks) = (bed.values(), tracks.values_mut());
    drops.view().visit(|drops, node| {
        let fall = |edge: &landform::graph::Edge| (bed[node] - bed[edge.node]) / edge.distance;
        let steepest = space.neighbours(node).max_by(|a, b| fall(a).total_cmp(&fall(b)));
        match steepest.filter(|edge| fall(edge) > 0.0) {
            Some(edge) if drops.move_to(node, edge.node) => tracks[node] += 1,
            Some(_) => {}
            None => {
                drops.deregister(node);
            }
        }
    });
}
// ANCHOR_END: run

// ANCHOR: fall
/// New drops fall; they run from the next iteration on.
fn fall(
    settings: Res<Settings<Rain>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut drops: Agents<Drops>,
) {
    let random = RandomStream::new(clock.seed, "rain");
    let mut drops = drops.view();
    for drop in 0..settings.drops {
        let [word, ..] = random.block(clock.tick, drop, 0);
        drops.register(word as usize % space.node_count(), 0);
    }
}
// ANCHOR_END: fall
