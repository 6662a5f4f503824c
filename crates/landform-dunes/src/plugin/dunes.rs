//! The process `Dunes`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use landform_graph::Lattice;
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut, Sand};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::counts::DuneCounts;
use crate::dunes::{
    AvalancheSettings, DuneError, DuneSettings, Engine, Protection, ProtectionSettings, Refinement,
    Rose, Shadow, ShadowSettings, Shelter, TickCounts, TransportSettings, Wind,
};

/// Wind-blown dunes: slabs of sand that hop downwind over a hard bed, avalanches at repose.
///
/// Werner's model (1995) as the thesis extends it (section 4.1). At each iteration every node is
/// polled once. A slab that the wind can reach is lifted and hops downwind by `wind_strength_m`
/// until it stays: surely in shelter, with a probability on sand and on bare ground elsewhere.
/// Sand steeper than repose slides. Shelter is the geometric shadow or the thesis' protection.
/// Conserves sand to 1e-12 but for what crosses open borders, which the ledger books.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dunes {
    /// The winds and how often each blows.
    #[schemars(extend("x-source" = "thesis, table 4.2: one wind, +-15 degrees, 3 directions"))]
    pub winds: Vec<Wind>,
    /// Height of a slab of sand; at most tan(repose) times the spacing.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, table 4.2"))]
    pub slab_m: f64,
    /// Length of a hop; one node at least.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, table 4.2"))]
    pub wind_strength_m: f64,
    /// Probability that a slab that lands on sand in the wind stays.
    #[schemars(range(min = 1e-6, max = 1.0), extend("x-source" = "Werner 1995"))]
    pub deposit_on_sand: f64,
    /// Probability that a slab that lands on bare ground in the wind stays.
    #[schemars(range(min = 1e-6, max = 1.0), extend("x-source" = "Werner 1995"))]
    pub deposit_on_bare: f64,
    /// Whether the wind lifts slabs in shelter too, as in Werner's own program.
    #[schemars(extend("x-source" = "thesis 2.3.1: it does not"))]
    pub lift_in_shelter: bool,
    /// Steepest slope at which sand rests.
    #[schemars(range(min = 0.1, max = 89.0), extend("x-unit" = "degrees", "x-source" = "thesis 4.1.2: dry sand"))]
    pub repose_deg: f64,
    /// What keeps the wind from a node.
    pub shelter: ShelterKind,
    /// Slabs an iteration that enter over the open borders that the wind blows in over.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub feed_slabs: f64,
    /// A run of full slabs and then phases of ever lower ones, after which the process has
    /// finished; slabs keep their height for ever when it is missing.
    #[schemars(extend("x-source" = "thesis 4.1.1"))]
    pub refinement: Option<Refinement>,
}

/// What keeps the wind from a node.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum ShelterKind {
    /// Higher ground upwind, by a geometric test along the wind (Werner; thesis 4.1.1).
    Shadow(ShadowSettings),
    /// The sand in a cone upwind, kept up to date by events (thesis 4.1.2).
    Protection(ProtectionSettings),
}

impl Default for Dunes {
    fn default() -> Self {
        let transport = TransportSettings::default();
        Self {
            winds: vec![Wind::default()],
            slab_m: transport.slab_m,
            wind_strength_m: transport.hop_m,
            deposit_on_sand: transport.deposit_on_sand,
            deposit_on_bare: transport.deposit_on_bare,
            lift_in_shelter: transport.lift_in_shelter,
            repose_deg: AvalancheSettings::default().repose_deg,
            shelter: ShelterKind::Shadow(ShadowSettings::default()),
            feed_slabs: transport.feed_slabs_per_tick,
            refinement: None,
        }
    }
}

impl Dunes {
    /// The settings of the kernels.
    pub fn settings(&self) -> DuneSettings {
        DuneSettings {
            rose: Rose { winds: self.winds.clone() },
            transport: TransportSettings {
                slab_m: self.slab_m,
                hop_m: self.wind_strength_m,
                deposit_on_sand: self.deposit_on_sand,
                deposit_on_bare: self.deposit_on_bare,
                lift_in_shelter: self.lift_in_shelter,
                feed_slabs_per_tick: self.feed_slabs,
                ..TransportSettings::default()
            },
            avalanche: AvalancheSettings {
                repose_deg: self.repose_deg,
                ..AvalancheSettings::default()
            },
        }
    }

    fn state(&self, lattice: &Lattice, seed: u64) -> Result<DuneState, DuneError> {
        let settings = self.settings();
        let shelter = match &self.shelter {
            ShelterKind::Shadow(shadow) => AnyShelter::Shadow(Shadow::new(shadow.clone())?),
            ShelterKind::Protection(protection) => AnyShelter::Protection(Box::new(
                Protection::new(protection.clone(), &settings.rose, lattice)?,
            )),
        };
        Ok(DuneState { engine: Engine::new(lattice.clone(), settings, seed)?, shelter })
    }
}

impl Process for Dunes {
    const NAME: &'static str = "Dunes";

    fn declare(&self, uses: &mut Declaration) {
        let shelter_bytes = match self.shelter {
            ShelterKind::Shadow(_) => 16,
            ShelterKind::Protection(_) => 40 * self.winds.len(),
        };
        uses.reads_or_zero::<Bed>()
            .writes::<Sand>()
            .keeps::<DuneCounts>()
            .rebuilds::<DuneState>()
            .conserves(Budget::volume::<Sand>(1e-12))
            .scratch(ENGINE_BYTES + shelter_bytes);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.state_check(lattice).map_err(|error| refusal(&error))
    }

    fn iterations(&self) -> Option<u64> {
        self.refinement.map(|refinement| refinement.ticks())
    }
}

/// Bytes a node that the engine works in.
const ENGINE_BYTES: usize = 24;

impl Plugin for Dunes {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .insert_resource(DuneCounts::default())
            .add_systems(Begin, begin)
            .add_systems(Iterate, blow);
    }
}

/// What the process keeps between iterations; all of it follows from parameters and fields.
#[derive(Resource)]
struct DuneState {
    engine: Engine,
    shelter: AnyShelter,
}

enum AnyShelter {
    Shadow(Shadow),
    Protection(Box<Protection>),
}

impl AnyShelter {
    fn as_dyn(&mut self) -> &mut dyn Shelter {
        match self {
            Self::Shadow(shadow) => shadow,
            Self::Protection(protection) => protection.as_mut(),
        }
    }
}

/// Makes the engine; sand that is too steep at the start comes to rest.
fn begin(
    mut commands: bevy_ecs::system::Commands,
    settings: Res<Settings<Dunes>>,
    space: Res<Space>,
    clock: Res<Clock>,
    mut fault: ResMut<Fault>,
    bed: Field<Bed>,
    mut sand: FieldMut<Sand>,
) {
    let state = settings.state(&space, clock.seed).and_then(|mut state| {
        state.engine.settle(bed.values(), sand.values_mut())?;
        Ok(state)
    });
    match state {
        Ok(state) => commands.insert_resource(state),
        Err(error) => fault.raise(error.to_string()),
    }
}

/// One iteration of wind.
fn blow(
    settings: Res<Settings<Dunes>>,
    clock: Res<Clock>,
    space: Res<Space>,
    mut state: ResMut<DuneState>,
    mut counts: ResMut<DuneCounts>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    bed: Field<Bed>,
    mut sand: FieldMut<Sand>,
) {
    let DuneState { engine, shelter } = &mut *state;
    let share = settings.refinement.map_or(1.0, |phases| phases.slab_share(clock.iteration));
    let tick = engine
        .set_slab_m(settings.slab_m * share)
        .and_then(|()| engine.tick(bed.values(), sand.values_mut(), clock.tick, shelter.as_dyn()));
    match tick {
        Ok(tick) => {
            let slab_m3 = engine.slab_m() * space.spacing().powi(2);
            book(&tick, slab_m3, &mut ledger);
            if tick.avalanches.iter().any(|avalanche| !avalanche.settled) {
                fault.raise("the sand does not come to rest; use a lower slab or a higher repose");
            }
            counts.0 = tick;
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// Books the sand that crossed open borders.
fn book(tick: &TickCounts, slab_m3: f64, ledger: &mut Ledger) {
    const BORDERS: [&str; 4] = ["west border", "east border", "north border", "south border"];
    for (border, &slabs) in BORDERS.iter().zip(&tick.transport.left) {
        if slabs > 0 {
            ledger.leave("sand", border, slabs as f64 * slab_m3);
        }
    }
    if tick.transport.fed > 0 {
        ledger.enter("sand", "upwind feed", tick.transport.fed as f64 * slab_m3);
    }
}

impl Dunes {
    /// Checks everything that [`Dunes::state`] would, without its memory.
    fn state_check(&self, lattice: &Lattice) -> Result<(), DuneError> {
        let settings = self.settings();
        settings.validate(lattice)?;
        match &self.shelter {
            ShelterKind::Shadow(shadow) => Shadow::new(shadow.clone()).map(|_| ()),
            ShelterKind::Protection(protection) => {
                Protection::new(protection.clone(), &settings.rose, lattice).map(|_| ())
            }
        }
    }
}

/// A refusal by the kernels, at the parameter it is about.
pub(super) fn refusal(error: &DuneError) -> Problem {
    let parameter = match error {
        DuneError::SlabTooHigh { .. } => "slab_m",
        DuneError::NoWind => "winds",
        DuneError::NoInlet(_) => "feed_slabs",
        DuneError::Unstable { .. } => "diffusivity_m2",
        _ => "",
    };
    Problem::new(parameter, error.to_string(), "")
}
