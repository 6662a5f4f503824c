//! Rain: drops that run downhill, as agents of one group.

use landform::prelude::*;
use landform::sim::random::unit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

// ANCHOR: group
/// The drops that run over the ground: at most one at a node.
pub struct Drops;

impl AgentGroup for Drops {
    /// Nothing: a drop knows only where it is, which is its node.
    type State = ();
    /// Drops that came to an end so far.
    type Globals = u64;
    const NAME: &'static str = "drops";
}
// ANCHOR_END: group

// ANCHOR: field
/// How many drops have run over a node.
pub struct Tracks;

impl NodeField for Tracks {
    type Value = u32;
    const NAME: &'static str = "tracks";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "drops that have run over the node";
}
// ANCHOR_END: field

/// Drops of rain that run downhill and leave tracks until they reach a hollow or a border.
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
/// Every drop runs one step, the likelier the steeper; where the next node is taken it waits.
fn run(
    clock: Res<Clock>,
    space: Res<Space>,
    bed: Field<Bed>,
    mut tracks: FieldMut<Tracks>,
    mut drops: Agents<Drops>,
) {
    let random = RandomStream::new(clock.seed, "ways of drops");
    let (bed, tracks) = (bed.values(), tracks.values_mut());
    drops.view().visit(|drops, node| {
        let ways = space.neighbours(node).enumerate().map(|(number, edge)| {
            let [word, ..] = random.block(clock.tick, node, number as u32);
            let fall = (bed[node] - bed[edge.node]) / edge.distance;
            (fall * unit(word), edge.node)
        });
        let way = ways.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|way| way.0 > 0.0);
        let Some((_, below)) = way else {
            *drops.globals_mut() += u64::from(drops.deregister(node));
            return;
        };
        if drops.move_to(node, below) {
            tracks[node] += 1;
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
        drops.register(word as usize % space.node_count(), ());
    }
}
// ANCHOR_END: fall
