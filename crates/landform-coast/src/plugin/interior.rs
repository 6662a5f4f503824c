//! The process `IslandInterior`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::agent::Agents;
use landform_sim::fault::Fault;
use landform_sim::field::FieldMut;
use landform_sim::ledger::Ledger;
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::erosion::{follow, refusal, settle};
use super::groups::{
    CoastAgents, CoastMarks, Eroded, LAND_BUDGET, Land, LevelSetNumber, OnLevelSet, Resistance,
    coast_surface, node_area_m2,
};
use crate::coast::{CoastSettings, Perimeter, Weakening};
use crate::interior::{FrontFields, FrontRecord, FrontSettings, Fronts};

/// Erosion that goes on inland from a coast and leaves former coasts behind as level sets, until
/// nothing is left to erode (thesis, section 4.2.4 and listing 4.1).
///
/// An iteration is one of the coast model. When a front comes further than `threshold_nodes` from
/// the last level set, whatever still stands on that level set falls, and the coast as it then is
/// becomes the next one. When nothing falls, the force grows by a share of `raise` until something
/// does; with the next level set it is as it was. The fields `level_set` and `on_level_set` say
/// where level sets run; the process `LevelSetHeights` makes ground of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct IslandInterior {
    /// Force of the sea f on a coast of no length.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub force: f64,
    /// How strongly shore weakens the sea: g.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub attenuation: f64,
    /// Which shore weakens the sea at a place.
    #[schemars(extend("x-source" = "thesis 4.3.4: the local perimeter"))]
    pub perimeter: Perimeter,
    /// How rock resists the less, the more of it lies bare.
    pub weakening: Weakening,
    /// Edges from the last level set after which the next is marked.
    #[schemars(range(min = 1, max = 1_000_000), extend("x-source" = "thesis, listing 4.1, line 7"))]
    pub threshold_nodes: u32,
    /// Share by which the force grows at each iteration that moves nothing.
    #[schemars(range(min = 1e-4, max = 10.0), extend("x-source" = "thesis, listing 4.1, line 11"))]
    pub raise: f64,
}

impl Default for IslandInterior {
    fn default() -> Self {
        let front = FrontSettings::default();
        Self {
            force: 0.4,
            attenuation: 0.15,
            perimeter: Perimeter::Near { radius_m: 200.0 },
            weakening: Weakening::default(),
            threshold_nodes: front.threshold,
            raise: front.raise,
        }
    }
}

impl IslandInterior {
    fn coast(&self) -> CoastSettings {
        CoastSettings {
            force: self.force,
            attenuation: self.attenuation,
            perimeter: self.perimeter,
            weakening: self.weakening,
            wear: None,
            regions: Vec::new(),
            region_map: Vec::new(),
        }
    }

    fn front(&self) -> FrontSettings {
        FrontSettings { threshold: self.threshold_nodes, raise: self.raise }
    }
}

impl Process for IslandInterior {
    const NAME: &'static str = "IslandInterior";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<Land>()
            .reads::<Resistance>()
            .writes::<Land>()
            .writes::<Resistance>()
            .writes::<LevelSetNumber>()
            .writes::<OnLevelSet>()
            .group::<CoastMarks>()
            .group::<CoastAgents>()
            .group::<Eroded>()
            .keeps::<InteriorRecord>()
            .rebuilds::<InteriorState>()
            .derives("coast_surface", "m", "land above the sea, to look at", coast_surface)
            .conserves(LAND_BUDGET)
            .scratch(INTERIOR_BYTES);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.coast().validate(lattice).map_err(|error| refusal(&error))?;
        if !(1e-4..=10.0).contains(&self.raise) || self.threshold_nodes == 0 {
            let (name, message) = match self.threshold_nodes {
                0 => ("threshold_nodes", "a level set at every iteration".to_owned()),
                _ => ("raise", format!("the force cannot grow by a share of {}", self.raise)),
            };
            return Err(Problem::new(name, message, "a raise of 0.0001 to 10, a threshold from 1"));
        }
        if self.force < 1e-6 {
            let message = format!("a force of {} moves nothing", self.force);
            return Err(Problem::new("force", message, "0.000001 or more"));
        }
        Ok(())
    }
}

/// Bytes a node that the fronts work in.
const INTERIOR_BYTES: usize = 40;

impl Plugin for IslandInterior {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, survey).add_systems(Iterate, advance);
    }
}

/// What the fronts have done so far.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InteriorRecord(pub FrontRecord);

/// The fronts at work; all of it follows from parameters, fields and record.
#[derive(Resource)]
pub(super) struct InteriorState(pub(super) Fronts);

/// Fields of the fronts as systems get them.
type Fields<'w, 's> = (
    FieldMut<'w, 's, Land>,
    FieldMut<'w, 's, Resistance>,
    FieldMut<'w, 's, LevelSetNumber>,
    FieldMut<'w, 's, OnLevelSet>,
);

/// Lends the fields to the kernels.
fn lend<'a>((land, resistance, band, on_level): &'a mut Fields<'_, '_>) -> FrontFields<'a> {
    FrontFields {
        land: land.values_mut(),
        resistance: resistance.values_mut(),
        band: band.values_mut(),
        on_level: on_level.values_mut(),
    }
}

/// Finds the fronts, and puts the agents of the coast there.
fn survey(
    mut commands: Commands,
    settings: Res<Settings<IslandInterior>>,
    space: Res<Space>,
    record: Option<Res<InteriorRecord>>,
    mut fault: ResMut<Fault>,
    mut fields: Fields<'_, '_>,
    (marks, coast): (Agents<CoastMarks>, Agents<CoastAgents>),
) {
    let mut fields = lend(&mut fields);
    let (rules, front) = (settings.coast(), settings.front());
    let found = match record {
        Some(record) => Fronts::resume(&space, rules, front, &fields, record.0),
        None => Fronts::new(&space, rules, front, &mut fields),
    };
    let state = match found {
        Ok(state) => state,
        Err(error) => return fault.raise(error.to_string()),
    };
    settle(state.coast(), space.spacing(), marks, coast);
    commands.insert_resource(InteriorRecord(state.record()));
    commands.insert_resource(InteriorState(state));
}

/// One iteration of the fronts.
fn advance(
    space: Res<Space>,
    mut state: ResMut<InteriorState>,
    mut record: ResMut<InteriorRecord>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    mut fields: Fields<'_, '_>,
    (mut marks, mut coast, mut eroded): (Agents<CoastMarks>, Agents<CoastAgents>, Agents<Eroded>),
) {
    let mut fallen = 0;
    let step = state.0.step(&mut lend(&mut fields), |front, events| {
        fallen += events.eroded.len();
        follow(front, events, space.spacing(), (&mut marks, &mut coast, &mut eroded));
    });
    if let Err(error) = step {
        return fault.raise(error.to_string());
    }
    record.0 = state.0.record();
    if fallen > 0 {
        ledger.leave("land", "sea", fallen as f64 * node_area_m2(&space));
    }
}
