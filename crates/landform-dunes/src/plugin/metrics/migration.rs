//! How fast dunes move.

use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{measured, refusal, surface};
use crate::dunes::drift_m;

/// Speed of the dunes along the wind, from the shift at which the surface correlates best with
/// the one measured before.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Migration {
    /// Direction that the wind blows to, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "degrees"))]
    pub towards_deg: f64,
    /// Largest shift that is looked for between two measurements; below half the spacing of
    /// the crests, which all look alike.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub furthest_m: f64,
}

impl Default for Migration {
    fn default() -> Self {
        Self { towards_deg: 0.0, furthest_m: 100.0 }
    }
}

/// The surface that was measured before, and when.
#[derive(Clone, Debug, Default)]
pub struct Before(Option<(u64, Vec<f64>)>);

impl Keep for Before {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.value("tick", &self.0.as_ref().map(|(tick, _)| *tick));
        to.array("surface", self.0.as_ref().map_or(&[][..], |(_, surface)| surface));
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let tick: Option<u64> = from.value("tick")?;
        let surface = from.array("surface")?.to_vec();
        Ok(Self(tick.map(|tick| (tick, surface))))
    }
}

impl Metric for Migration {
    type Memory = Before;
    const NAME: &'static str = "Migration";

    fn measure(
        &self,
        before: &mut Before,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let surface = surface(snapshot)?;
        let tick = snapshot.clock().tick;
        let mut speed = None;
        if let Some((before_tick, before)) = &before.0 {
            let shift =
                drift_m(snapshot.lattice(), before, &surface, self.towards_deg, self.furthest_m);
            let ticks = tick.saturating_sub(*before_tick).max(1) as f64;
            speed = shift.map_err(refusal)?.map(|shift| shift / ticks);
        }
        before.0 = Some((tick, surface));
        Ok(measured([("migration_m_per_iteration", speed)]))
    }
}
