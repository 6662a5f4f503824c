//! How steep a dune field is and how much of the ground is bare.

use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{field, measured, refusal, surface};
use crate::dunes::{bare_percent, near_repose_percent, steepest_slopes};

/// Share of nodes whose steepest edge is near the slope of repose (thesis, table 4.1), and the
/// steepest edge of all.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NearRepose {
    /// Angle of repose.
    #[schemars(range(min = 0.1, max = 89.0), extend("x-unit" = "degrees"))]
    pub repose_deg: f64,
    /// How near, as a share of the tangent of the angle, above or below.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "thesis 4.1.2: 10 %"))]
    pub tolerance: f64,
}

impl Default for NearRepose {
    fn default() -> Self {
        Self { repose_deg: 33.0, tolerance: 0.1 }
    }
}

impl Metric for NearRepose {
    type Memory = ();
    const NAME: &'static str = "NearRepose";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let surface = surface(snapshot)?;
        let lattice = snapshot.lattice();
        let near = near_repose_percent(lattice, &surface, self.repose_deg, self.tolerance);
        let steepest = steepest_slopes(lattice, &surface).map_err(refusal)?;
        let steepest = steepest.into_iter().reduce(f64::max);
        Ok(measured([
            ("near_repose_percent", Some(near.map_err(refusal)?)),
            ("steepest_slope_deg", steepest.map(|tangent| tangent.atan().to_degrees())),
        ]))
    }
}

/// Share of nodes with less sand than a slab.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BareGround {
    /// Thickness below which ground is bare.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub thickness_m: f64,
}

impl Default for BareGround {
    fn default() -> Self {
        Self { thickness_m: 1.0 }
    }
}

impl Metric for BareGround {
    type Memory = ();
    const NAME: &'static str = "BareGround";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let sand = field(snapshot, "sand")?;
        Ok(measured([("bare_ground_percent", bare_percent(&sand, self.thickness_m))]))
    }
}
