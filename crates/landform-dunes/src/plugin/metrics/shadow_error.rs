//! How well protection stands in for a test of visibility.

use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{measured, refusal, surface};
use crate::dunes::{
    FlankSettings, Protection, ProtectionSettings, Rose, ShadowError, VisibilitySettings, Wind,
    flanks, geometric_shadow, shadow_error,
};

/// Share of nodes where shelter by protection disagrees with geometric visibility, with and
/// without the peaks and troughs of the dunes (thesis, table 4.1b).
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProtectionError {
    /// The wind; the test of visibility looks along each of its directions.
    pub wind: Wind,
    /// The cone of protection.
    pub protection: ProtectionSettings,
    /// The test of visibility.
    pub visibility: VisibilitySettings,
    /// What is left when peaks and troughs are left out.
    pub flanks: FlankSettings,
}

impl Metric for ProtectionError {
    type Memory = ();
    const NAME: &'static str = "ProtectionError";

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        // The kernels check their settings; on level ground they are done at once.
        self.error(lattice, &vec![0.0; lattice.node_count()]).map(|_| ())
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let error = self.error(snapshot.lattice(), &surface(snapshot)?)?;
        Ok(measured([
            ("protection_error_percent", Some(error.all_percent)),
            ("protection_error_on_flanks_percent", error.flanks_percent),
            ("protection_error_reduction_percent", error.reduction_percent),
            ("peaks_and_troughs_percent", Some(error.left_out_percent)),
        ]))
    }
}

impl ProtectionError {
    fn error(&self, lattice: &Lattice, surface: &[f64]) -> Result<ShadowError, Problem> {
        let rose = Rose { winds: vec![self.wind.clone()] };
        let mut emergent = vec![false; surface.len()];
        let mut protection =
            Protection::new(self.protection.clone(), &rose, lattice).map_err(refusal)?;
        protection.update(0, surface).map_err(refusal)?;
        protection.mark(0, &mut emergent);
        let geometric =
            geometric_shadow(lattice, surface, &rose, &self.visibility).map_err(refusal)?;
        let flanks =
            flanks(lattice, surface, self.wind.towards_deg, &self.flanks).map_err(refusal)?;
        shadow_error(&emergent, &geometric, &flanks).map_err(refusal)
    }
}
