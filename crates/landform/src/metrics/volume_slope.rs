//! How steep the function of an implicit volume is beside its bound.

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::random::{RandomStream, unit};
use landform_sim::snapshot::Snapshot;
use landform_synth::{ImplicitVolume, SynthError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::columns;

/// Slope of the function of an implicit volume between pairs of random places in the block: the
/// steepest, `volume_slope`, and that as a share of the bound that its tree states, its Lipschitz
/// constant: `volume_slope_share`, at most 1 if the bound holds. No share where there is no bound.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VolumeSlope {
    /// The volume: the same parameters as those of the initial condition. Files are relative to the
    /// folder that the program runs in.
    pub of: ImplicitVolume,
    /// Pairs of places: half of them anywhere, half of them near each other.
    #[schemars(range(min = 2, max = 1_000_000))]
    pub pairs: u32,
}

impl Default for VolumeSlope {
    fn default() -> Self {
        Self { of: ImplicitVolume::default(), pairs: 100_000 }
    }
}

impl Metric for VolumeSlope {
    type Memory = ();
    const NAME: &'static str = "VolumeSlope";

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let made = self.of.volume(Path::new(""), lattice.spacing(), 0);
        made.map(|_| ()).map_err(refusal)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let (lattice, seed) = (snapshot.lattice(), snapshot.clock().seed);
        let spacing_m = lattice.spacing();
        let volume = self.of.volume(Path::new(""), spacing_m, seed).map_err(refusal)?;
        let top = lattice.size().map(|nodes| nodes as f64 * spacing_m);
        let stream = RandomStream::new(seed, "VolumeSlope");
        let place = |pair: u32, end: u32| {
            let [east, north, up, _] = stream.block(u64::from(end), pair as usize, 0).map(unit);
            [east * top[0], north * top[1], up * top[2]]
        };
        let slope = |pair: u32| {
            let [a, far] = [place(pair, 0), place(pair, 1)];
            // The steepest places are steep over a short way alone.
            let share = if pair.is_multiple_of(2) { 1.0 } else { 1e-3 };
            let b: [f64; 3] = std::array::from_fn(|axis| a[axis] + share * (far[axis] - a[axis]));
            let away = (0..3).map(|axis| (b[axis] - a[axis]).powi(2)).sum::<f64>().sqrt();
            (volume.value(b) - volume.value(a)).abs() / away.max(f64::MIN_POSITIVE)
        };
        let steepest = (0..self.pairs).map(slope).fold(0.0, f64::max);
        let bound = volume.slope();
        let has_bound = bound.is_finite() && bound > 0.0;
        Ok(columns([
            ("volume_slope", Some(steepest)),
            ("volume_slope_share", has_bound.then_some(steepest / bound)),
        ]))
    }
}

fn refusal(error: SynthError) -> Problem {
    Problem::new("of", error.to_string(), "").code(error.code())
}
