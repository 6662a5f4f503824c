//! The process `LevelSetHeights`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::clock::Clock;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::groups::{LevelSetNumber, OnLevelSet};
use crate::interior::{
    Course, LevelSets, LevelSetsError, Relaxation, RelaxationLimits, SeaFloor, hermite,
    lay_sea_floor, relax_bending, terraces,
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
    /// The surface of least bending energy whose contours run where the coasts ran, between the
    /// nodes of land and sea: without the treads of nodes that lie on level sets.
    Contours,
}

impl Interpolation {
    fn course(self) -> Course {
        if self == Self::Contours { Course::Outside } else { Course::Through }
    }
}

/// Makes ground of level sets, in one iteration: writes the field `bed` (thesis, sections 4.2.4
/// and 4.3.4, figures 4.8 and 4.16).
///
/// Level set n lies at n times `interval_m`; the ground between two of them keeps between their
/// heights, so that level sets never cross. Level set 0 is the sea at 0 m, or its floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LevelSetHeights {
    /// Height from one level set to the next.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, listing 4.1, line 13"))]
    pub interval_m: f64,
    /// How the heights between are found.
    pub interpolation: Interpolation,
    /// How the floor of the sea falls away from the shore; a level sea at 0 m when missing.
    pub sea_floor: Option<SeaFloor>,
}

impl Default for LevelSetHeights {
    fn default() -> Self {
        Self { interval_m: 20.0, interpolation: Interpolation::Bending, sea_floor: None }
    }
}

impl Process for LevelSetHeights {
    const NAME: &'static str = "LevelSetHeights";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<LevelSetNumber>()
            .reads::<OnLevelSet>()
            .writes::<Bed>()
            .keeps::<HeightsRecord>()
            .scratch(HEIGHTS_BYTES);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if !(1e-9..=1e9).contains(&self.interval_m) {
            let message = format!("level sets cannot be {} m apart", self.interval_m);
            return Err(Problem::new("interval_m", message, "0.000000001 to 1000000000"));
        }
        if let Some(floor) = self.sea_floor.filter(|floor| !floor.is_valid()) {
            let SeaFloor { slope, depth_m } = floor;
            let message = format!("a sea floor with a slope of {slope}, {depth_m} m deep");
            let allowed = "a slope of 0 to 1000, a depth of 0.000000001 to 1000000000";
            return Err(Problem::new("sea_floor", message, allowed));
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
const HEIGHTS_BYTES: usize = 1000;

impl Plugin for LevelSetHeights {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, interpolate);
    }
}

/// How heights were made.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightsRecord {
    /// Height from one level set to the next in metres.
    pub interval_m: f64,
    /// Where level sets run.
    pub course: Course,
    /// What relaxation did, if there was any.
    pub relaxation: Option<Relaxation>,
    /// Number of the stage.
    pub stage: usize,
}

/// Gives heights to the nodes.
fn interpolate(
    mut commands: Commands,
    settings: Res<Settings<LevelSetHeights>>,
    (space, clock): (Res<Space>, Res<Clock>),
    mut fault: ResMut<Fault>,
    (band, on_level): (Field<LevelSetNumber>, Field<OnLevelSet>),
    mut bed: FieldMut<Bed>,
) {
    let interval_m = settings.interval_m;
    let levels = LevelSets { band: band.values(), on_level: on_level.values(), interval_m };
    match settings.heights(&space, &levels) {
        Ok((heights, relaxation)) => {
            bed.values_mut().copy_from_slice(&heights);
            let (course, stage) = (settings.interpolation.course(), clock.stage);
            commands.insert_resource(HeightsRecord { interval_m, course, relaxation, stage });
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

impl LevelSetHeights {
    /// Heights of the nodes, and what relaxation did.
    fn heights(
        &self,
        lattice: &Lattice,
        levels: &LevelSets<'_>,
    ) -> Result<(Vec<f64>, Option<Relaxation>), LevelSetsError> {
        let mut relaxation = None;
        let mut heights = match self.interpolation {
            Interpolation::Terraces => terraces(lattice, levels)?,
            _ => hermite(lattice, levels)?,
        };
        if matches!(self.interpolation, Interpolation::Bending | Interpolation::Contours) {
            let (course, limits) = (self.interpolation.course(), RelaxationLimits::default());
            relaxation = Some(relax_bending(lattice, levels, course, limits, &mut heights)?);
        }
        if let Some(floor) = self.sea_floor {
            lay_sea_floor(lattice, levels, floor, &mut heights)?;
        }
        Ok((heights, relaxation))
    }
}
