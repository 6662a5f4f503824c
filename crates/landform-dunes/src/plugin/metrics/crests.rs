//! Spacing, direction and ends of crests.

use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{measured, refusal, surface};
use crate::dunes::{
    correlation_spacing_m, crest_ends_per_m, crest_orientation, crossing_spacing_m,
};

/// Crests: their spacing along the wind by up-crossings of the mean and by autocorrelation, their
/// direction and how much they agree, and the number of their ends a kilometre of crest.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Crests {
    /// Direction that the wind blows to, counter-clockwise from east.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "degrees"))]
    pub towards_deg: f64,
    /// Least height of a crest above its troughs.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m"))]
    pub swing_m: f64,
}

impl Default for Crests {
    fn default() -> Self {
        Self { towards_deg: 0.0, swing_m: 5.0 }
    }
}

impl Metric for Crests {
    type Memory = ();
    const NAME: &'static str = "Crests";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let surface = surface(snapshot)?;
        let lattice = snapshot.lattice();
        let crossing = crossing_spacing_m(lattice, &surface, self.towards_deg).map_err(refusal)?;
        let correlation =
            correlation_spacing_m(lattice, &surface, self.towards_deg).map_err(refusal)?;
        let orientation = crest_orientation(lattice, &surface).map_err(refusal)?;
        let ends = crest_ends_per_m(lattice, &surface, self.towards_deg, self.swing_m);
        Ok(measured([
            ("crest_spacing_m", crossing),
            ("crest_correlation_spacing_m", correlation),
            ("crest_direction_deg", orientation.map(|crests| crests.towards_deg)),
            ("crest_coherence", orientation.map(|crests| crests.coherence)),
            ("crest_ends_per_km", ends.map_err(refusal)?.map(|ends| 1000.0 * ends)),
        ]))
    }
}
