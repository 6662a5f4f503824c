//! The process `CaveGrowth`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Commands;
use bevy_ecs::world::World;
use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{Field, FieldMut, stored_values};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::{Porosity, Pressure};
use super::{CavePlaces, openings, refusal};
use crate::courses::CourseScale;
use crate::erosion::Dissolution;
use crate::growth::{ChannelGrowth, GrowthLaw, Motion};
use crate::pressure::Rates;
use crate::record::CaveRecord;
use crate::water::{PoreWater, UNIT};
use crate::{CaveError, CaveSink, CaveSource};

/// Channels that grow from sources to sinks, link up and capture each other: the second stage of a
/// cave.
///
/// An iteration: sources bring water; it flows to neighbours of lower pressure that have room; sinks
/// take it; where it flowed, rock dissolves. Voxels of at least `passage_porosity` are passages. In
/// rock pressure rises from the sinks by `rock_rate_per_m`, along passages by `channel_rate_per_m` only:
/// where a passage opens, pressure falls around it like an avalanche and leads other channels there.
///
/// > pressure: the greatest field with `p(N) <= p(S) + k d(S, N)`, 0 at sinks, at most what it was
/// > before breakthrough
///
/// > erosion: `dP/dt = min(w_0 f, 1 - P)`, `f = (w_a f_a + f_c)^m`
///
/// with f_c the water that a voxel received as a share of its volume, and f_a what the voxels that it
/// leads to contribute. On a plane the domain is a section through the rock: north is up.
///
/// Conserves water exactly (whole units of 2^-26 of a voxel) and rock to rounding; what was dissolved is
/// in the ledger. Pressure is the same, bit for bit, in whatever order it is computed.
///
/// # Limits
/// Needs a field `porosity` from 0 to 1. Sources and sinks share no voxel. Pressure has no time: it
/// follows erosion at once.
///
/// # Source
/// Thesis, section 5.2.2 (listings 5.2 and 5.3, equations 5.1 and 5.2, table 5.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveGrowth {
    /// Where water comes in.
    pub sources: Vec<CaveSource>,
    /// Where it leaves.
    pub sinks: Vec<CaveSink>,
    /// What makes water move.
    pub motion: WaterMotion,
    /// Rate P_rate at which pressure rises in rock, a metre.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "1/m", "x-source" = "thesis, table 5.1"))]
    pub rock_rate_per_m: f64,
    /// Rate at which pressure rises between voxels of passages, a metre; at most that of rock.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "1/m", "x-source" = "thesis, table 5.1"))]
    pub channel_rate_per_m: f64,
    /// Thickness of rock that a sink or a passage may drain: pressure at sources before breakthrough,
    /// over the rate of rock.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m", "x-source" = "chosen: see the calibration of caves"))]
    pub drainage_radius_m: f64,
    /// Share of that pressure by which it falls from the sources to the ends of their zones.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: see the calibration of caves"))]
    pub initial_fall: f64,
    /// Exponent of the differences of pressure by which water is shared among neighbours: 1 weighs by
    /// the difference.
    #[schemars(range(min = 1, max = 64), extend("x-source" = "chosen: see the calibration of caves"))]
    pub weight_exponent: u32,
    /// Porosity w_0 that a flow of 1 adds in an iteration.
    #[schemars(range(min = 0.0, max = 1e3), extend("x-source" = "thesis, table 5.1"))]
    pub erosion_rate: f64,
    /// Weight w_a of contributed flow.
    #[schemars(range(min = 0.0, max = 1e3), extend("x-source" = "thesis, table 5.1"))]
    pub contributed_weight: f64,
    /// Exponent m of the flow.
    #[schemars(range(min = 0.01, max = 10.0), extend("x-source" = "thesis, table 5.1"))]
    pub flow_exponent: f64,
    /// Part of its flow that a voxel contributes to each neighbour that leads to it.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: see the calibration of caves"))]
    pub contributed_fraction: f64,
    /// Porosity from which a voxel is part of a passage.
    #[schemars(range(min = 1e-3, max = 1.0), extend("x-source" = "chosen: see the calibration of caves"))]
    pub passage_porosity: f64,
    /// Sweeps of water an iteration: in each, water moves by one voxel.
    #[schemars(range(min = 1, max = 32), extend("x-source" = "thesis, listing 5.3"))]
    pub sweeps: u32,
    /// Rise of a course that counts as a phreatic loop.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m", "x-source" = "chosen: two voxels of the thesis' caves"))]
    pub least_rise_m: f64,
}

/// What makes water move through pores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum WaterMotion {
    /// It goes to lower pressure, up or down (thesis, section 5.2.2).
    #[default]
    Pressure,
    /// It only falls, as water columns on terrain do (thesis, section 5.1 and figure 5.2).
    Falling,
}

impl Default for CaveGrowth {
    fn default() -> Self {
        let source =
            CaveSource { center: [0.0, 0.5, 1.0], size_m: [0.0; 3], pressure: 1.0, strength: 1.0 };
        Self {
            sources: vec![source],
            sinks: vec![CaveSink { center: [1.0, 0.5, 0.0], size_m: [0.0; 3] }],
            motion: WaterMotion::Pressure,
            rock_rate_per_m: 0.5,
            channel_rate_per_m: 0.001,
            drainage_radius_m: 60.0,
            initial_fall: 0.5,
            weight_exponent: 4,
            erosion_rate: 0.15,
            contributed_weight: 0.25,
            flow_exponent: 1.0,
            contributed_fraction: 0.1,
            passage_porosity: 0.35,
            sweeps: 1,
            least_rise_m: 2.0,
        }
    }
}

impl CaveGrowth {
    fn law(&self) -> GrowthLaw {
        let rates =
            Rates { rock_per_m: self.rock_rate_per_m, channel_per_m: self.channel_rate_per_m };
        let motion = match self.motion {
            WaterMotion::Pressure => Motion::Pressure {
                rates,
                exponent: self.weight_exponent,
                most: self.rock_rate_per_m * self.drainage_radius_m,
                fall: self.initial_fall,
            },
            WaterMotion::Falling => Motion::Falling,
        };
        let dissolution = Dissolution {
            rate: self.erosion_rate,
            contributed_weight: self.contributed_weight,
            exponent: self.flow_exponent,
            contributed_fraction: self.contributed_fraction,
        };
        GrowthLaw { motion, dissolution, passage: self.passage_porosity, sweeps: self.sweeps }
    }

    fn scale(&self, lattice: &Lattice) -> CourseScale {
        let spacing = lattice.spacing();
        let (apart_m, near_m) = (8.0 * spacing, 3.0 * spacing);
        CourseScale { least_rise_m: self.least_rise_m, apart_m, near_m }
    }
}

impl Process for CaveGrowth {
    const NAME: &'static str = "CaveGrowth";

    fn declare(&self, uses: &mut Declaration) {
        let came =
            "water that came into the voxel in the latest iteration, as a share of its volume";
        uses.writes::<Porosity>()
            .derives("pore_water", "1", "share of the voxel that water fills", |world| {
                shares(world, PoreWater::content_shares)
            })
            .derives("pore_flow", "1", came, |world| shares(world, PoreWater::flow_shares))
            .writes::<Pressure>()
            .rebuilds::<CaveWorks>()
            .rebuilds::<CavePlaces>()
            .keeps::<CaveWater>()
            .keeps::<CaveHistory>()
            .conserves(volume("pore water", water_m3))
            .conserves(volume("voids", voids_m3))
            .scratch(ChannelGrowth::BYTES);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let law = self.law();
        if let Motion::Pressure { rates, .. } = law.motion {
            rates.check().map_err(|error| refusal(&error, "channel_rate_per_m"))?;
        }
        law.dissolution.check().map_err(|error| refusal(&error, ""))?;
        openings(lattice, &self.sources, &self.sinks).map(|_| ())
    }
}

/// An account of volumes, conserved to rounding.
fn volume(account: &'static str, measure: fn(&World) -> f64) -> Budget {
    Budget { account, unit: "m3", tolerance: 1e-9, measure, magnitude: measure }
}

fn voids_m3(world: &World) -> f64 {
    sum(stored_values::<Porosity>(world)) * world.resource::<Space>().spacing().powi(3)
}

fn water_m3(world: &World) -> f64 {
    let units = world.get_resource::<CaveWater>().map_or(0, |water| water.0.total());
    units as f64 / UNIT * world.resource::<Space>().spacing().powi(3)
}

/// A field of the water; nothing before a cave has any.
fn shares(world: &World, of: fn(&PoreWater) -> Vec<f64>) -> Vec<f64> {
    match world.get_resource::<CaveWater>() {
        Some(water) => of(&water.0),
        None => vec![0.0; world.resource::<Space>().node_count()],
    }
}

impl Plugin for CaveGrowth {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, lay_out)
            .add_systems(Iterate, (grow, tell).chain());
    }
}

/// The cave at work; all of it follows from parameters, lattice and fields.
#[derive(Resource)]
pub(super) struct CaveWorks {
    pub(super) growth: ChannelGrowth,
    pub(super) scale: CourseScale,
}

/// The water in the pores: of which the fields `pore_water` and `pore_flow` are made when somebody looks.
/// It stays when a stage ends.
#[derive(Resource)]
pub struct CaveWater(
    /// What voxels contain, and what came into them.
    pub PoreWater,
);

impl Keep for CaveWater {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        self.0.save(to);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        Ok(Self(PoreWater::restore(from)?))
    }
}

/// What happened so far.
#[derive(Resource, Default, Serialize, Deserialize)]
pub struct CaveHistory(
    /// Events, and which sources drain.
    pub CaveRecord,
);

fn lay_out(
    mut commands: Commands,
    (settings, space): (Res<Settings<CaveGrowth>>, Res<Space>),
    mut fault: ResMut<Fault>,
    (porosity, water): (Field<Porosity>, Option<Res<CaveWater>>),
    mut pressure: FieldMut<Pressure>,
) {
    let made = || -> Result<(ChannelGrowth, Vec<f64>), String> {
        let told = |error: CaveError| error.to_string();
        let openings = openings(&space, &settings.sources, &settings.sinks)
            .map_err(|problem| problem.message)?;
        let (rock, law) = (porosity.values(), settings.law());
        let mut growth = ChannelGrowth::new(&space, law, openings, rock).map_err(told)?;
        let first = growth.first_pressure(&space, rock).map_err(told)?;
        Ok((growth, first))
    };
    match made() {
        Ok((growth, first)) => {
            pressure.values_mut().copy_from_slice(&first);
            commands.insert_resource(CaveWorks { growth, scale: settings.scale(&space) });
            commands.insert_resource(CaveHistory::default());
            commands.insert_resource(CavePlaces::of(&space, &settings.sources, &settings.sinks));
            if water.is_none() {
                commands.insert_resource(CaveWater(PoreWater::dry(space.node_count())));
            }
        }
        Err(message) => fault.raise(message),
    }
}

/// An iteration.
fn grow(
    (mut works, mut water, space): (ResMut<CaveWorks>, ResMut<CaveWater>, Res<Space>),
    (mut ledger, mut fault): (ResMut<Ledger>, ResMut<Fault>),
    (mut porosity, mut pressure): (FieldMut<Porosity>, FieldMut<Pressure>),
) {
    let (growth, water) = (&mut works.growth, &mut water.0);
    match growth.step(&space, water, porosity.values_mut(), pressure.values_mut()) {
        Ok(turnover) => {
            let voxel_m3 = space.spacing().powi(3);
            ledger.enter("pore water", "sources", turnover.fed * voxel_m3);
            ledger.leave("pore water", "sinks", turnover.drained * voxel_m3);
            ledger.enter("voids", "dissolution", turnover.dissolved * voxel_m3);
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// Looks for what the iteration joined.
fn tell(
    (mut works, mut history): (ResMut<CaveWorks>, ResMut<CaveHistory>),
    (space, clock): (Res<Space>, Res<Clock>),
    pressure: Field<Pressure>,
) {
    let CaveWorks { growth, scale } = &mut *works;
    let (passages, openings) = growth.passages();
    let (sources, sinks) = (&openings.sources, &openings.sinks);
    let state = (passages, pressure.values());
    history.0.survey(&space, state, (sources, sinks), *scale, clock.iteration + 1);
}
