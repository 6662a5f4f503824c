//! The processes `RicePile` and `SlidingSlabs`: piles in one dimension, one on every row of the map.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{FieldMut, NodeField};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::sandpiles::count_grains;
use super::{AvalancheRecord, Grains};
use crate::sandpile::{OsloPile, SandpileError, SlabPile};

/// How often a column of rice has toppled.
pub struct Topplings;

impl NodeField for Topplings {
    type Value = u32;
    const NAME: &'static str = "topplings";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "how often the top grain of the column has moved on";
    const LEAST: f64 = 0.0;
}

/// The Oslo rice pile (Christensen et al. 1996), a pile on every row of the map: a wall in the west, where
/// grains are added, an open end in the east.
///
/// Where a column stands more than 1 or 2 grains above the next, by a threshold that is drawn anew
/// whenever it topples, its top grain moves on. In the critical state the mean avalanche is as many moves
/// as there are columns, exactly. Grains are conserved but for those that fall off, which the ledger
/// books.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RicePile {
    /// Grains that are added to every row in an iteration.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub grains_per_iteration: u64,
    /// Iterations before avalanches are recorded: the critical state takes about 0.9 squared columns of
    /// grains a row.
    pub warm_up_iterations: u64,
}

/// Duran's pile of slabs that drag along those underneath (thesis, section 2.2; the local limited model
/// of Kadanoff, Nagel, Wu and Zhou 1989), a pile on every row of the map: a wall in the west, an open end
/// in the east.
///
/// Slabs are added to random columns. Where a column stands more than `slabs_together` slabs above the
/// next, so many of them move on. In the critical state the mean avalanche is (columns + 1) / 2 moves by
/// `slabs_together`, exactly. Slabs are conserved but for those that fall off, which the ledger books.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SlidingSlabs {
    /// Slabs that slide together, and the greatest fall at rest.
    #[schemars(range(min = 1, max = 1000), extend("x-source" = "thesis 2.2"))]
    pub slabs_together: u32,
    /// Slabs that are added to every row in an iteration.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub grains_per_iteration: u64,
    /// Iterations before avalanches are recorded: the critical state takes about half the squared columns
    /// of slabs a row for every slab that slides.
    pub warm_up_iterations: u64,
}

impl Default for RicePile {
    fn default() -> Self {
        Self { grains_per_iteration: 1000, warm_up_iterations: 0 }
    }
}

impl Default for SlidingSlabs {
    fn default() -> Self {
        Self { slabs_together: 2, grains_per_iteration: 1000, warm_up_iterations: 0 }
    }
}

impl Process for RicePile {
    const NAME: &'static str = "RicePile";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Grains>()
            .writes::<Topplings>()
            .keeps::<AvalancheRecord>()
            .rebuilds::<RicePiles>()
            .conserves(grain_budget())
            .scratch(24);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        refuse_ring(lattice)
    }
}

impl Process for SlidingSlabs {
    const NAME: &'static str = "SlidingSlabs";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Grains>()
            .keeps::<AvalancheRecord>()
            .rebuilds::<SlabPiles>()
            .conserves(grain_budget())
            .scratch(16);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        refuse_ring(lattice)
    }
}

fn grain_budget() -> Budget {
    Budget {
        account: "grains",
        unit: "1",
        tolerance: 0.0,
        measure: count_grains,
        magnitude: count_grains,
    }
}

/// Refuses rows without an end.
fn refuse_ring(lattice: &Lattice) -> Result<(), Problem> {
    match lattice.is_periodic(0) {
        false => Ok(()),
        true => {
            let message = "rows are rings, so grains could never leave them";
            Err(Problem::new("", message, "`boundary: (Open, Open)` in the domain"))
        }
    }
}

impl Plugin for RicePile {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(AvalancheRecord::default())
            .add_systems(Begin, heap_rice)
            .add_systems(Iterate, add_rice);
    }
}

impl Plugin for SlidingSlabs {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(AvalancheRecord::default())
            .add_systems(Begin, heap_slabs)
            .add_systems(Iterate, add_slabs);
    }
}

/// A pile for every row; all that matters later lies in the fields.
#[derive(Resource)]
struct RicePiles(Vec<OsloPile>);

/// A pile for every row; all that matters later lies in the field.
#[derive(Resource)]
struct SlabPiles(Vec<SlabPile>);

fn heap_rice(
    mut commands: Commands,
    space: Res<Space>,
    clock: Res<Clock>,
    mut record: ResMut<AvalancheRecord>,
    mut fault: ResMut<Fault>,
    mut grains: FieldMut<Grains>,
    mut topplings: FieldMut<Topplings>,
) {
    record.exact_mean = Some(space.width() as f64);
    let rows = grains.values_mut().chunks(space.width());
    let rows = rows.zip(topplings.values_mut().chunks(space.width())).enumerate();
    let pile = |(row, (grains, topplings)): (usize, (&[u32], &[u32]))| {
        OsloPile::standing(grains, topplings, row as u32, clock.seed)
    };
    match rows.map(pile).collect::<Result<Vec<_>, SandpileError>>() {
        Ok(piles) => commands.insert_resource(RicePiles(piles)),
        Err(error) => fault.raise(error.to_string()),
    }
}

fn heap_slabs(
    mut commands: Commands,
    settings: Res<Settings<SlidingSlabs>>,
    space: Res<Space>,
    mut record: ResMut<AvalancheRecord>,
    mut fault: ResMut<Fault>,
    mut grains: FieldMut<Grains>,
) {
    record.exact_mean = Some(SlabPile::mean_slides(space.width(), settings.slabs_together));
    let rows = grains.values_mut().chunks(space.width());
    let pile = |grains: &[u32]| SlabPile::standing(grains, settings.slabs_together);
    match rows.map(pile).collect::<Result<Vec<_>, SandpileError>>() {
        Ok(piles) => commands.insert_resource(SlabPiles(piles)),
        Err(error) => fault.raise(error.to_string()),
    }
}

fn add_rice(
    settings: Res<Settings<RicePile>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut piles: ResMut<RicePiles>,
    mut record: ResMut<AvalancheRecord>,
    mut ledger: ResMut<Ledger>,
    mut grains: FieldMut<Grains>,
    mut topplings: FieldMut<Topplings>,
) {
    record.events = 0;
    let mut gone = [0; 2];
    let rows = grains.values_mut().chunks_mut(space.width());
    for (pile, row) in piles.0.iter_mut().zip(rows) {
        let before = pile.ledger();
        for _ in 0..settings.grains_per_iteration {
            record.count(pile.add(), clock.iteration >= settings.warm_up_iterations);
        }
        book(&mut gone, before, pile.ledger());
        row.iter_mut().zip(pile.heights()).for_each(|(row, height)| *row = height as u32);
    }
    let counts = piles.0.iter().flat_map(OsloPile::topplings);
    topplings.values_mut().iter_mut().zip(counts).for_each(|(of, count)| *of = *count as u32);
    ledger.enter("grains", "added", gone[0] as f64);
    ledger.leave("grains", "east border", gone[1] as f64);
}

fn add_slabs(
    settings: Res<Settings<SlidingSlabs>>,
    space: Res<Space>,
    clock: Res<Clock>,
    mut piles: ResMut<SlabPiles>,
    mut record: ResMut<AvalancheRecord>,
    mut ledger: ResMut<Ledger>,
    mut grains: FieldMut<Grains>,
) {
    let stream = RandomStream::new(clock.seed, "sliding slabs");
    let first = clock.tick * settings.grains_per_iteration;
    record.events = 0;
    let mut gone = [0; 2];
    let rows = grains.values_mut().chunks_mut(space.width());
    for (number, (pile, row)) in piles.0.iter_mut().zip(rows).enumerate() {
        let before = pile.ledger();
        for slab in first..first + settings.grains_per_iteration {
            let slides = pile.add_at_random(&stream, slab, number);
            record.count(slides, clock.iteration >= settings.warm_up_iterations);
        }
        book(&mut gone, before, pile.ledger());
        row.iter_mut().zip(pile.heights()).for_each(|(row, height)| *row = height as u32);
    }
    ledger.enter("grains", "added", gone[0] as f64);
    ledger.leave("grains", "east border", gone[1] as f64);
}

/// Adds what a pile took and lost in an iteration.
fn book(gone: &mut [u64; 2], before: [u64; 2], after: [u64; 2]) {
    (0..2).for_each(|side| gone[side] += after[side] - before[side]);
}
