//! How many grains the sites of a sandpile hold.

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::field::stored_values;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::plugin::Grains;

/// Grains at the sites of a `Sandpile`: their mean number, 17/8 on a large pile, and the shares of the sites
/// with 0, 1, 2 and 3 of them (Priezzhev 1994), all measurements so far together, away from the
/// borders.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GrainShares {
    /// Iterations of the stage before measurements count.
    pub warm_up_iterations: u64,
    /// Width of the border whose sites are left out, as a share of the map.
    #[schemars(range(min = 0.0, max = 0.49))]
    pub margin: f64,
}

impl Default for GrainShares {
    fn default() -> Self {
        Self { warm_up_iterations: 0, margin: 0.25 }
    }
}

/// Sites with 0, 1, 2, and 3 or more grains, of all measurements.
#[derive(Clone, Debug, Default)]
pub struct GrainCounts([u64; 4]);

impl Keep for GrainCounts {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("sites", &self.0);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let mut sites = [0; 4];
        sites.copy_from_slice(from.array_of("sites", 4)?);
        Ok(Self(sites))
    }
}

impl GrainCounts {
    fn count(&mut self, lattice: &Lattice, grains: &[u32], margin: f64) {
        let [width, height, _] = lattice.size();
        let inner = |size: usize| {
            let left_out = (margin * size as f64) as usize;
            left_out..size - left_out
        };
        for row in inner(height) {
            for column in inner(width) {
                self.0[grains[column + width * row].min(3) as usize] += 1;
            }
        }
    }
}

impl Metric for GrainShares {
    type Memory = GrainCounts;
    const NAME: &'static str = "GrainShares";

    fn fields(&self) -> Vec<String> {
        vec!["grains".to_owned()]
    }

    fn measure(
        &self,
        counts: &mut GrainCounts,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        if snapshot.clock().iteration > self.warm_up_iterations {
            let grains = stored_values::<Grains>(snapshot.world());
            counts.count(snapshot.lattice(), grains, self.margin);
        }
        let all = counts.0.iter().sum::<u64>();
        if all == 0 {
            return Ok(Vec::new());
        }
        let share = |count: u64| count as f64 / all as f64;
        let mean: f64 = (0..4).map(|grains| grains as f64 * share(counts.0[grains])).sum();
        let shares = counts.0.iter().enumerate();
        let shares =
            shares.map(|(grains, &count)| (format!("grains_{grains}_share"), share(count)));
        Ok([("grains_mean".to_owned(), mean)].into_iter().chain(shares).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn sites_at_the_border_are_left_out() {
        let lattice = Lattice::plane([8, 4], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut grains = vec![3; 32];
        grains[8 + 2..8 + 6].copy_from_slice(&[0, 1, 1, 2]);
        let mut counts = GrainCounts::default();
        counts.count(&lattice, &grains, 0.25);
        assert_eq!(counts.0, [1, 2, 1, 4]);
        counts.count(&lattice, &grains, 0.0);
        assert_eq!(counts.0, [2, 4, 2, 32]);
    }
}
