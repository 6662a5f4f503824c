//! The process `Protochannels`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::FieldMut;
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use landform_sim::random::RandomStream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::{Porosity, PressureZone, ProtochannelCount};
use super::{CavePlaces, openings};
use crate::error::check_values;
use crate::growth::Openings;
use crate::stage_one::{
    NO_SOURCE, Network, Preference, Zones, pressure_zones, protochannels, protosinks,
};
use crate::{CaveError, CaveSource};

/// Protochannels: the vestigial channels that grow from sources before anything breaks through, the
/// first stage of a cave.
///
/// Every source claims the rock that is nearest to it, distances weighted by its pressure. On the
/// boundary of its zone lie protosinks, chosen at random; the largest flow to them through the pores is
/// found, the lesser porosity of two neighbours being what may flow between them, and channels follow
/// it from the protosinks back to their source. They get a porosity of their own.
///
/// All happens in one iteration; further ones find the same channels again.
///
/// # Limits
/// Needs a field `porosity` from 0 to 1. Memory: 4 bytes a voxel and direction.
///
/// # Source
/// Thesis, section 5.2.1 (listing 5.1, figures 5.3 and 5.5).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Protochannels {
    /// Where water comes in.
    pub sources: Vec<CaveSource>,
    /// Protosinks of each source.
    #[schemars(range(min = 0, max = 1000000), extend("x-source" = "chosen: the thesis says a set"))]
    pub protosinks: u32,
    /// Direction in which channels grow: the protosinks cluster there. On all sides when missing.
    #[schemars(extend("x-source" = "thesis, section 5.2.1"))]
    pub preference: Option<Preference>,
    /// Distance from a source, weighted by pressure, at which its protosinks lie at most; the whole
    /// zone when missing.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m"))]
    pub reach_m: Option<f64>,
    /// Porosity of protochannels where the rock has less: below that of passages.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: see the calibration of caves"))]
    pub porosity: f64,
}

impl Default for Protochannels {
    fn default() -> Self {
        let middle =
            CaveSource { center: [0.5; 3], size_m: [0.0; 3], pressure: 1.0, strength: 1.0 };
        Self {
            sources: vec![middle],
            protosinks: 60,
            preference: None,
            reach_m: None,
            porosity: 0.25,
        }
    }
}

impl Process for Protochannels {
    const NAME: &'static str = "Protochannels";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Porosity>()
            .writes::<PressureZone>()
            .writes::<ProtochannelCount>()
            .keeps::<ProtochannelTally>()
            .rebuilds::<CavePlaces>()
            .scratch(26 * 4 + 64);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        openings(lattice, &self.sources, &[]).map(|_| ())
    }

    fn iterations(&self) -> Option<u64> {
        Some(1)
    }
}

impl Plugin for Protochannels {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, mark_places)
            .add_systems(Iterate, lay_channels);
    }
}

/// How many protochannels there are.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProtochannelTally {
    /// Protosinks.
    pub wanted: u64,
    /// Protosinks that a channel leads to.
    pub reached: u64,
}

fn mark_places(
    mut commands: Commands,
    (settings, space): (Res<Settings<Protochannels>>, Res<Space>),
) {
    commands.insert_resource(CavePlaces::of(&space, &settings.sources, &[]));
    commands.insert_resource(ProtochannelTally::default());
}

fn lay_channels(
    settings: Res<Settings<Protochannels>>,
    space: Res<Space>,
    clock: Res<Clock>,
    (mut tally, mut fault): (ResMut<ProtochannelTally>, ResMut<Fault>),
    mut porosity: FieldMut<Porosity>,
    (mut zone, mut count): (FieldMut<PressureZone>, FieldMut<ProtochannelCount>),
) {
    let random = RandomStream::new(clock.seed, "protosinks");
    match settings.network(&space, porosity.values(), &random) {
        Ok((zones, network)) => {
            let reached = network.paths.len() as u64;
            *tally = ProtochannelTally { wanted: reached + network.missed as u64, reached };
            let number = |owner: u32| if owner == NO_SOURCE { 0.0 } else { f64::from(owner) + 1.0 };
            for (node, &channels) in network.channels.iter().enumerate() {
                zone.values_mut()[node] = number(zones.owner[node]);
                count.values_mut()[node] = f64::from(channels);
                if channels > 0 {
                    let value = &mut porosity.values_mut()[node];
                    *value = value.max(settings.porosity);
                }
            }
        }
        Err(message) => fault.raise(message),
    }
}

impl Protochannels {
    /// Zones and channels of the settings in rock of this porosity.
    fn network(
        &self,
        lattice: &Lattice,
        porosity: &[f64],
        random: &RandomStream,
    ) -> Result<(Zones, Network), String> {
        let told = |error: CaveError| error.to_string();
        check_values("porosity", porosity, lattice.node_count(), [0.0, 1.0]).map_err(told)?;
        let openings = openings(lattice, &self.sources, &[]).map_err(|problem| problem.message)?;
        let seeds = openings.seeds();
        let open = |node: usize| porosity[node] > 0.0;
        let zones = pressure_zones(lattice, open, &seeds).map_err(told)?;
        let sinks = self.sinks(lattice, &zones, &openings, open, random);
        let network = protochannels(lattice, porosity, &zones, &seeds, &sinks).map_err(told)?;
        Ok((zones, network))
    }

    /// Protosinks with the numbers of their sources.
    fn sinks(
        &self,
        lattice: &Lattice,
        zones: &Zones,
        openings: &Openings,
        open: impl Fn(usize) -> bool + Copy,
        random: &RandomStream,
    ) -> Vec<(usize, u32)> {
        let limits = (self.protosinks as usize, self.reach_m.unwrap_or(f64::INFINITY));
        let of_source = |(number, nodes): (usize, &Vec<usize>)| {
            let source = (number as u32, nodes[nodes.len() / 2]);
            let preference = self.preference.as_ref();
            protosinks(lattice, zones, source, limits, preference, open, random)
                .into_iter()
                .map(move |node| (node, number as u32))
        };
        openings.sources.iter().enumerate().flat_map(of_source).collect()
    }
}
