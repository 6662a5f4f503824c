//! The process `CoastErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::agent::Agents;
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{Field, FieldMut};
use landform_sim::ledger::Ledger;
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::groups::{
    CoastAgents, CoastMarks, CoastRegion, Eroded, LAND_BUDGET, Land, Resistance, coast_surface,
    node_area_m2,
};
use crate::coast::{
    Coast, CoastError, CoastSettings, Events, Perimeter, Region, Weakening, Wear, spacings,
};

/// The sea erodes a coast whose shore, growing longer, weakens the sea.
///
/// Sapoval's model (2004) as the thesis extends it (section 4.2). A land node beside the sea
/// belongs to the coast. It falls when what exposure leaves of its `resistance` is below the force
/// of the sea, F = f / (1 + g L), with L the `perimeter`: the whole shore beside its first
/// length, or the shore within a radius beside a straight one. Nodes that fall lay bare what lies
/// behind them, in avalanches, until the coast rests. With `wear`, rock gives way in time and
/// weakens the rock around it when it falls, and coasts stay smoother. The field `land` becomes 0
/// where the sea takes over; the ledger books the area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CoastErosion {
    /// Force of the sea f on a coast of no length, in the unit of `resistance`.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-source" = "thesis, table 4.3 (a)"))]
    pub force: f64,
    /// How strongly shore weakens the sea: g. A smaller one makes coasts more folded.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-source" = "thesis, table 4.3 (a)"))]
    pub attenuation: f64,
    /// Which shore weakens the sea at a place.
    #[schemars(extend("x-source" = "thesis, equations 2.8 and 4.2"))]
    pub perimeter: Perimeter,
    /// How rock resists the less, the more of it the sea has laid bare.
    #[schemars(extend("x-source" = "thesis 4.2.1: in proportion to the missing neighbours"))]
    pub weakening: Weakening,
    /// Rock that gives way in time, and weakens the rock around it when it falls; the coast
    /// never rests then. None when missing.
    #[schemars(extend("x-source" = "thesis 4.2.3"))]
    pub wear: Option<Wear>,
    /// Parts of the map where the coast has numbers of its own.
    #[schemars(extend("x-source" = "thesis 4.2.4"))]
    pub regions: Vec<Region>,
}

impl Default for CoastErosion {
    fn default() -> Self {
        let settings = CoastSettings::default();
        Self {
            force: settings.force,
            attenuation: settings.attenuation,
            perimeter: settings.perimeter,
            weakening: settings.weakening,
            wear: settings.wear,
            regions: settings.regions,
        }
    }
}

impl CoastErosion {
    /// The settings of the kernels.
    pub fn settings(&self) -> CoastSettings {
        CoastSettings {
            force: self.force,
            attenuation: self.attenuation,
            perimeter: self.perimeter,
            weakening: self.weakening,
            wear: self.wear,
            regions: self.regions.clone(),
            region_map: Vec::new(),
        }
    }

    /// Whether a region is found on the map of regions.
    fn has_region_map(&self) -> bool {
        self.regions.iter().any(|region| region.place.is_numbered())
    }
}

impl Process for CoastErosion {
    const NAME: &'static str = "CoastErosion";

    fn declare(&self, uses: &mut Declaration) {
        let perimeter_bytes = match self.perimeter {
            Perimeter::Whole => 0,
            Perimeter::Near { .. } => 4,
            Perimeter::Contiguous { .. } => 1,
        };
        // Both are asked for: a map without land or rock would be a mistake.
        uses.reads::<Land>()
            .reads::<Resistance>()
            .writes::<Land>()
            .writes::<Resistance>()
            .group::<CoastMarks>()
            .group::<CoastAgents>()
            .group::<Eroded>()
            .keeps::<CoastRecord>()
            .rebuilds::<CoastState>()
            .derives("coast_surface", "m", "land above the sea, to look at", coast_surface)
            .conserves(LAND_BUDGET)
            .scratch(COAST_BYTES + perimeter_bytes);
        if self.has_region_map() {
            uses.reads::<CoastRegion>().rebuilds::<RegionMap>();
        }
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.settings().validate(lattice).map_err(|error| refusal(&error))
    }
}

/// Bytes a node that the coast works in beside perimeters.
const COAST_BYTES: usize = 8;

impl Plugin for CoastErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, survey).add_systems(Iterate, erode);
        if self.has_region_map() {
            app.add_systems(Begin, read_region_map.before(survey));
        }
    }
}

/// What a coast was at the beginning, and what happened in the latest iteration.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CoastRecord {
    /// Shore at the beginning, in parts of a spacing ([`crate::coast::PARTS`]).
    pub initial_shore: u64,
    /// Land nodes at the beginning.
    pub initial_land: u64,
    /// Nodes that fell in the latest iteration; none before the first one.
    pub events: Option<u64>,
    /// Number of the stage.
    pub stage: usize,
}

/// The coast at work; all of it follows from parameters and fields.
#[derive(Resource)]
pub(super) struct CoastState(pub(super) Coast);

/// The map of regions, where there is one.
#[derive(Resource)]
struct RegionMap(Vec<u8>);

/// Keeps the map of regions for [`survey`].
fn read_region_map(mut commands: Commands, map: Field<CoastRegion>) {
    commands.insert_resource(RegionMap(map.values().to_vec()));
}

/// Finds the coast and puts its agents there.
fn survey(
    mut commands: Commands,
    settings: Res<Settings<CoastErosion>>,
    space: Res<Space>,
    clock: Res<Clock>,
    record: Option<Res<CoastRecord>>,
    region_map: Option<Res<RegionMap>>,
    mut fault: ResMut<Fault>,
    (land, rock): (Field<Land>, Field<Resistance>),
    (marks, coast): (Agents<CoastMarks>, Agents<CoastAgents>),
) {
    let land = land.values();
    let mut settings = settings.settings();
    settings.region_map = region_map.map(|map| map.0.clone()).unwrap_or_default();
    let found = Coast::new(&space, settings, land, rock.values()).and_then(|coast| {
        // A run that is resumed, and a later stage, may find that the sea has taken all.
        if record.is_none() {
            coast.require_coast(land)?;
        }
        Ok(coast)
    });
    let state = match found {
        Ok(state) => state,
        Err(error) => return fault.raise(error.to_string()),
    };
    settle(&state, space.spacing(), marks, coast);
    commands.insert_resource(CoastRecord {
        initial_shore: state.shore().total(),
        initial_land: land.iter().filter(|&&land| land > 0).count() as u64,
        events: None,
        stage: clock.stage,
    });
    commands.insert_resource(CoastState(state));
}

/// Puts a pair of agents at every node of the coast, and removes them elsewhere.
pub(super) fn settle(
    state: &Coast,
    spacing_m: f64,
    mut marks: Agents<CoastMarks>,
    mut coast: Agents<CoastAgents>,
) {
    let (mut marks, mut coast) = (marks.view(), coast.view());
    for node in marks.nodes().filter(|&node| !state.is_coast(node)).collect::<Vec<_>>() {
        marks.deregister(node);
        coast.deregister(node);
    }
    for node in state.nodes() {
        let length_m = length_m(state, node, spacing_m);
        match marks.get_mut(node) {
            Some(length) => *length = length_m,
            None => {
                marks.register(node, length_m);
            }
        }
        coast.register(node, ());
    }
}

/// Length of the shore of a coast node in metres.
fn length_m(coast: &Coast, node: usize, spacing_m: f64) -> f64 {
    spacings(u64::from(coast.shore().length(node))) * spacing_m
}

/// One iteration of the sea.
fn erode(
    space: Res<Space>,
    mut state: ResMut<CoastState>,
    mut record: ResMut<CoastRecord>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    (mut land, mut rock): (FieldMut<Land>, FieldMut<Resistance>),
    (mut marks, mut coast, mut eroded): (Agents<CoastMarks>, Agents<CoastAgents>, Agents<Eroded>),
) {
    let step = state.0.step(land.values_mut(), rock.values_mut(), record.initial_shore);
    let events = match step {
        Ok(events) => events.clone(),
        Err(error) => return fault.raise(error.to_string()),
    };
    record.events = Some(events.eroded.len() as u64);
    let area_m2 = events.eroded.len() as f64 * node_area_m2(&space);
    if area_m2 > 0.0 {
        ledger.leave("land", "sea", area_m2);
    }
    follow(&state.0, &events, space.spacing(), (&mut marks, &mut coast, &mut eroded));
}

/// Coast agents hand their nodes to the artifacts of the sea, and others come to the nodes
/// behind.
pub(super) fn follow(
    state: &Coast,
    events: &Events,
    spacing_m: f64,
    (marks, coast, eroded): (
        &mut Agents<CoastMarks>,
        &mut Agents<CoastAgents>,
        &mut Agents<Eroded>,
    ),
) {
    let (mut marks, mut coast, mut eroded) = (marks.view(), coast.view(), eroded.view());
    for &node in &events.eroded {
        let node = node as usize;
        marks.deregister(node);
        coast.deregister(node);
        eroded.register(node, ());
    }
    for &node in &events.measured {
        let node = node as usize;
        let length_m = length_m(state, node, spacing_m);
        match marks.get_mut(node) {
            Some(length) => *length = length_m,
            None => {
                marks.register(node, length_m);
                coast.register(node, ());
            }
        }
    }
}

/// A refusal by the kernels, at the parameter it is about.
pub(super) fn refusal(error: &CoastError) -> Problem {
    let parameter = match error {
        CoastError::Range { name, .. } => name,
        CoastError::EmptyRegion(_) | CoastError::TooManyRegions(_) => "regions",
        _ => "",
    };
    let parameter = match parameter {
        "radius_m" => "",
        "rate" => "wear.rate",
        "polygon" => "regions",
        "weakening" => "wear",
        other => other,
    };
    Problem::new(parameter, error.to_string(), "")
}
