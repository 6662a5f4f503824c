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
/// direction, the angle between it and the wind (90 degrees across the wind, 0 along it), how much they
/// agree, and the number of their ends a kilometre of crest.
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

impl Crests {
    /// Angle between a direction and the wind, whichever way both point, from 0 to 90 degrees.
    fn to_wind_deg(&self, direction_deg: f64) -> f64 {
        let apart = (direction_deg - self.towards_deg).rem_euclid(180.0);
        apart.min(180.0 - apart)
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
            (
                "crest_angle_to_wind_deg",
                orientation.map(|crests| self.to_wind_deg(crests.towards_deg)),
            ),
            ("crest_coherence", orientation.map(|crests| crests.coherence)),
            ("crest_ends_per_km", ends.map_err(refusal)?.map(|ends| 1000.0 * ends)),
        ]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crests_make_an_angle_of_at_most_a_right_one_with_the_wind() {
        for (towards_deg, direction_deg, expected) in
            [(0.0, 90.0, 90.0), (0.0, 178.0, 2.0), (-30.0, 60.0, 90.0), (350.0, 5.0, 15.0)]
        {
            let crests = Crests { towards_deg, ..Crests::default() };
            assert!((crests.to_wind_deg(direction_deg) - expected).abs() < 1e-12);
        }
    }
}
