//! The processes `SandLike`, `CorrosionLike` and `Sandpile`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::{Connectivity, Lattice};
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, FieldMut, NodeField, Sand, stored_values};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::sandpile::{
    AbelianSandpile, Avalanche, CorrosionLike, CorrosionState, SandLike, SandState, SandpileError,
    SizeStatistics, exact::mean_avalanche_size,
};

/// Events of the latest iteration: slips, blocks or topplings, and avalanches of a sandpile.
#[derive(Resource, Clone, Debug, Default)]
pub struct AvalancheRecord {
    /// Events of the latest iteration.
    pub events: u64,
    /// Sizes of all avalanches of a sandpile since the warm-up.
    pub sizes: SizeStatistics,
    /// Mean size of an avalanche in the critical state, where it is known exactly.
    pub exact_mean: Option<f64>,
}

impl AvalancheRecord {
    /// Counts an avalanche of the latest iteration, in the statistics too once the warm-up is over.
    pub(super) fn count(&mut self, size: u64, is_warm: bool) {
        self.events += size;
        if is_warm {
            self.sizes.record(size);
        }
    }
}

impl Keep for AvalancheRecord {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.value("events", &self.events);
        to.keep("sizes", &self.sizes);
        to.value("exact mean", &self.exact_mean.map(f64::to_bits));
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let exact_mean: Option<u64> = from.value("exact mean")?;
        Ok(Self {
            events: from.value("events")?,
            sizes: from.keep("sizes")?,
            exact_mean: exact_mean.map(f64::from_bits),
        })
    }
}

impl Process for SandLike {
    const NAME: &'static str = "SandLike";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>()
            .keeps::<RestingSand>()
            .keeps::<AvalancheRecord>()
            .conserves(Budget::volume::<Sand>(1e-12))
            .scratch(24);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.state(lattice).map(|_| ()).map_err(|error| refusal(&error))
    }
}

impl Plugin for SandLike {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(AvalancheRecord::default())
            .add_systems(Begin, rest_sand)
            .add_systems(Iterate, slip);
    }
}

/// Which sand is shaken.
#[derive(Resource)]
struct RestingSand(SandState);

impl Keep for RestingSand {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        self.0.save(to);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        Keep::restore(from).map(Self)
    }
}

fn rest_sand(
    mut commands: Commands,
    settings: Res<Settings<SandLike>>,
    space: Res<Space>,
    mut fault: ResMut<Fault>,
) {
    match settings.state(&space) {
        Ok(state) => commands.insert_resource(RestingSand(state)),
        Err(error) => fault.raise(error.to_string()),
    }
}

fn slip(
    settings: Res<Settings<SandLike>>,
    space: Res<Space>,
    mut state: ResMut<RestingSand>,
    mut record: ResMut<AvalancheRecord>,
    mut fault: ResMut<Fault>,
    mut sand: FieldMut<Sand>,
) {
    match settings.step(&space, &mut state.0, sand.values_mut()) {
        Ok(slips) => record.events = slips as u64,
        Err(error) => fault.raise(error.to_string()),
    }
}

impl Process for CorrosionLike {
    const NAME: &'static str = "CorrosionLike";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Bed>()
            .keeps::<Rock>()
            .keeps::<AvalancheRecord>()
            .conserves(Budget::volume::<Bed>(1e-12))
            .scratch(16);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.state(lattice, 0).map(|_| ()).map_err(|error| refusal(&error))
    }
}

impl Plugin for CorrosionLike {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(AvalancheRecord::default())
            .add_systems(Begin, fresh_rock)
            .add_systems(Iterate, corrode);
    }
}

/// What is left of the rock.
#[derive(Resource)]
struct Rock(CorrosionState);

impl Keep for Rock {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        self.0.save(to);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        Keep::restore(from).map(Self)
    }
}

fn fresh_rock(
    mut commands: Commands,
    settings: Res<Settings<CorrosionLike>>,
    space: Res<Space>,
    clock: Res<Clock>,
    mut fault: ResMut<Fault>,
) {
    match settings.state(&space, clock.seed) {
        Ok(state) => commands.insert_resource(Rock(state)),
        Err(error) => fault.raise(error.to_string()),
    }
}

fn corrode(
    settings: Res<Settings<CorrosionLike>>,
    space: Res<Space>,
    mut state: ResMut<Rock>,
    mut record: ResMut<AvalancheRecord>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    mut bed: FieldMut<Bed>,
) {
    match settings.step(&space, &mut state.0, bed.values_mut()) {
        Ok(blocks) => {
            record.events = blocks as u64;
            let block_m3 = settings.block_m * space.spacing().powi(2);
            ledger.leave("bed", "disintegrated", blocks as f64 * block_m3);
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// Number of grains at a site of a sandpile.
pub struct Grains;

impl NodeField for Grains {
    type Value = u32;
    const NAME: &'static str = "grains";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of grains at the site";
    const LEAST: f64 = 0.0;
}

/// The classical sandpile (Bak, Tang and Wiesenfeld 1987): grains fall at random, a site with
/// four topples to its neighbours and over open borders.
///
/// The touchstone of self-organised criticality (thesis, section 2.2): its mean avalanche, its
/// density and its height probabilities are known exactly. Grains are conserved but for those
/// that fall off, which the ledger books.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sandpile {
    /// Grains that are added at random sites in an iteration.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub grains_per_iteration: u64,
    /// Iterations before avalanches are recorded: enough to reach the critical state takes
    /// about two grains and a half a site.
    pub warm_up_iterations: u64,
}

impl Default for Sandpile {
    fn default() -> Self {
        Self { grains_per_iteration: 1000, warm_up_iterations: 0 }
    }
}

impl Process for Sandpile {
    const NAME: &'static str = "Sandpile";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Grains>()
            .keeps::<AvalancheRecord>()
            .rebuilds::<Pile>()
            .conserves(Budget {
                account: "grains",
                unit: "1",
                tolerance: 0.0,
                measure: count_grains,
                magnitude: count_grains,
            })
            .scratch(16);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if lattice.connectivity() != Connectivity::Four {
            let message = format!("the lattice joins {:?}", lattice.connectivity());
            return Err(Problem::new("", message, "`connectivity: Four` in the domain"));
        }
        if lattice.is_periodic(0) || lattice.is_periodic(1) {
            let message = "the lattice is periodic, so grains could never leave it";
            return Err(Problem::new("", message, "`boundary: (Open, Open)` in the domain"));
        }
        Ok(())
    }
}

impl Plugin for Sandpile {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(AvalancheRecord::default())
            .add_systems(Begin, heap)
            .add_systems(Iterate, rain_grains);
    }
}

/// The pile, which holds nothing that matters later but the grains of the field.
#[derive(Resource)]
struct Pile(AbelianSandpile);

pub(super) fn count_grains(world: &bevy_ecs::world::World) -> f64 {
    stored_values::<Grains>(world).iter().map(|&grains| u64::from(grains)).sum::<u64>() as f64
}

fn heap(
    mut commands: Commands,
    space: Res<Space>,
    mut record: ResMut<AvalancheRecord>,
    mut fault: ResMut<Fault>,
    mut grains: FieldMut<Grains>,
) {
    let size = [space.width(), space.height()];
    record.exact_mean = (size[0] == size[1]).then(|| mean_avalanche_size(size[0]));
    match AbelianSandpile::with_grains(size, grains.values()) {
        Ok((pile, _)) => {
            grains.values_mut().copy_from_slice(&pile.grains());
            commands.insert_resource(Pile(pile));
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

fn rain_grains(
    settings: Res<Settings<Sandpile>>,
    clock: Res<Clock>,
    mut pile: ResMut<Pile>,
    mut record: ResMut<AvalancheRecord>,
    mut ledger: ResMut<Ledger>,
    mut grains: FieldMut<Grains>,
) {
    const BORDERS: [&str; 4] = ["north border", "east border", "south border", "west border"];
    let stream = RandomStream::new(clock.seed, "sandpile grains");
    let fallen_before = pile.0.ledger().fallen;
    let first = clock.tick * settings.grains_per_iteration;
    record.events = 0;
    for number in first..first + settings.grains_per_iteration {
        let Avalanche { size, .. } = pile.0.add_at_random(&stream, number);
        record.count(size, clock.iteration >= settings.warm_up_iterations);
    }
    ledger.enter("grains", "added", settings.grains_per_iteration as f64);
    let fallen = pile.0.ledger().fallen;
    for (border, (after, before)) in BORDERS.iter().zip(fallen.iter().zip(fallen_before)) {
        ledger.leave("grains", border, (after - before) as f64);
    }
    grains.values_mut().copy_from_slice(&pile.0.grains());
}

/// A refusal by the kernels, at the parameter it is about.
fn refusal(error: &SandpileError) -> Problem {
    let parameter = match error {
        SandpileError::Parameter { parameter, .. } => *parameter,
        _ => "",
    };
    Problem::new(parameter, error.to_string(), "")
}
