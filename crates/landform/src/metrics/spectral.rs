//! How the spectrum of a field falls off.

use landform_analysis::{RadialSpectrum, SpectralFit, Spectrum};
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, heights, refusal};

/// How well the spectrum of a field falls off as a power of frequency: RMS and R2 of the thesis'
/// fit (section 2.1.6) and the waves that it rejects, the exponent beta of the radially averaged
/// power, and how many of the waves above half the Nyquist frequency are empty (less than a
/// thousandth of what a surface with H = 1 and the same strongest wave has there).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpectralFalloff {
    /// Name of the field.
    pub field: String,
}

impl Default for SpectralFalloff {
    fn default() -> Self {
        Self { field: "surface".to_owned() }
    }
}

impl Metric for SpectralFalloff {
    type Memory = ();
    const NAME: &'static str = "SpectralFalloff";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = heights(snapshot, &self.field)?;
        let spectrum =
            Spectrum::new(snapshot.lattice(), &heights).map_err(|error| refusal(&error))?;
        let mut values = Vec::new();
        // A level surface has no spectrum to fit: there is nothing to measure yet.
        if let Ok(fit) = SpectralFit::new(&spectrum) {
            values.push(("spectral_rms".to_owned(), fit.rms));
            values.push(("spectral_r2".to_owned(), fit.r_squared));
            values.push(("spectral_rejected_percent".to_owned(), 100.0 * fit.rejected_share));
        }
        if let Ok(exponent) = RadialSpectrum::usual(&spectrum).exponent() {
            values.push(("spectral_beta".to_owned(), exponent.beta));
        }
        if let Some(share) = spectrum.empty_share() {
            values.push(("spectral_empty_percent".to_owned(), 100.0 * share));
        }
        Ok(values)
    }
}
