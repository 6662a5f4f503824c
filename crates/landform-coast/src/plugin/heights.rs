//! The process `LevelSetHeights`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::groups::{LevelSetNumber, OnLevelSet};
use crate::interior::{
    LevelSets, LevelSetsError, Relaxation, RelaxationLimits, hermite, relax_bending, terraces,
};

/// How heights between level sets are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Interpolation {
    /// The height of the lower of the two nearest level sets: flat steps (figure 4.16, top).
    Terraces,
    /// Cubics from level set to level set with one slope at each (figure 4.16, middle).
    Hermite,
    /// The surface of least bending energy, from the Hermite one (figure 4.16, bottom).
    #[default]
    Bending,
}

/// Makes ground of level sets, in one iteration: writes the field `bed` (thesis, sections 4.2.4
/// and 4.3.4, figures 4.8 and 4.16).
///
/// Level set n lies at n times `interval_m`; the ground between two of them keeps between their
/// heights, so that level sets never cross.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LevelSetHeights {
    /// Height from one level set to the next.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, listing 4.1, line 13"))]
    pub interval_m: f64,
    /// How the heights between are found.
    pub interpolation: Interpolation,
}

impl Default for LevelSetHeights {
    fn default() -> Self {
        Self { interval_m: 20.0, interpolation: Interpolation::Bending }
    }
}

impl Process for LevelSetHeights {
    const NAME: &'static str = "LevelSetHeights";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<LevelSetNumber>()
            .reads::<OnLevelSet>()
            .writes::<Bed>()
            .keeps::<RelaxationRecord>()
            .scratch(HEIGHTS_BYTES);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if !(1e-9..=1e9).contains(&self.interval_m) {
            let message = format!("level sets cannot be {} m apart", self.interval_m);
            return Err(Problem::new("interval_m", message, "0.000000001 to 1000000000"));
        }
        if lattice.connectivity().is_volume() {
            return Err(Problem::new("", "level sets of heights lie on a plane", "a 2-D domain"));
        }
        Ok(())
    }

    fn iterations(&self) -> Option<u64> {
        Some(1)
    }
}

/// Bytes a node that interpolation works in.
const HEIGHTS_BYTES: usize = 160;

impl Plugin for LevelSetHeights {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, interpolate);
    }
}

/// What relaxation did, if there was any.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RelaxationRecord(pub Option<Relaxation>);

/// Gives heights to the nodes.
fn interpolate(
    mut commands: Commands,
    settings: Res<Settings<LevelSetHeights>>,
    space: Res<Space>,
    mut fault: ResMut<Fault>,
    (band, on_level): (Field<LevelSetNumber>, Field<OnLevelSet>),
    mut bed: FieldMut<Bed>,
) {
    let interval_m = settings.interval_m;
    let levels = LevelSets { band: band.values(), on_level: on_level.values(), interval_m };
    match heights(&space, &levels, settings.interpolation) {
        Ok((heights, relaxation)) => {
            bed.values_mut().copy_from_slice(&heights);
            commands.insert_resource(RelaxationRecord(relaxation));
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// Heights by one of the interpolants, and what relaxation did.
fn heights(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    interpolation: Interpolation,
) -> Result<(Vec<f64>, Option<Relaxation>), LevelSetsError> {
    match interpolation {
        Interpolation::Terraces => Ok((terraces(lattice, levels)?, None)),
        Interpolation::Hermite => Ok((hermite(lattice, levels)?, None)),
        Interpolation::Bending => {
            let mut heights = hermite(lattice, levels)?;
            let limits = RelaxationLimits::default();
            let relaxation = relax_bending(lattice, levels, limits, &mut heights)?;
            Ok((heights, Some(relaxation)))
        }
    }
}
