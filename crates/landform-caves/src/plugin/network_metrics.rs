//! Metrics of protochannels and of the zones that they grow in.

use std::ops::ControlFlow;

use landform_graph::{BreadthFirst, Edge, Lattice, Reach};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ProtochannelTally;

fn field(snapshot: &Snapshot<'_>, name: &str) -> Result<Vec<f64>, Problem> {
    snapshot.field(name).map_err(|error| Problem::new("", error.to_string(), ""))
}

/// How much of the domain each source claims: `zone_1_percent` and on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PressureZones {}

impl Metric for PressureZones {
    type Memory = ();
    const NAME: &'static str = "PressureZones";

    fn fields(&self) -> Vec<String> {
        vec!["pressure_zone".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let zone = field(snapshot, "pressure_zone")?;
        let most = zone.iter().copied().fold(0.0, f64::max).min(1000.0) as u32;
        let percent = |number: u32| {
            let nodes = zone.iter().filter(|value| **value == f64::from(number)).count();
            (format!("zone_{number}_percent"), 100.0 * nodes as f64 / zone.len().max(1) as f64)
        };
        Ok((1..=most).map(percent).collect())
    }
}

/// Protochannels: `protochannel_voxels`; `protochannel_systems` that hang together; `protosinks`, and
/// `protochannels_traced` to so many of them; `shared_percent` of the voxels that carry several
/// channels, the stems of branches; and `clumped_percent`, voxels all neighbours of which, or all but a
/// quarter, are protochannels too.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProtochannelSystems {}

impl Metric for ProtochannelSystems {
    type Memory = ();
    const NAME: &'static str = "ProtochannelSystems";

    fn fields(&self) -> Vec<String> {
        vec!["protochannels".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let channels = field(snapshot, "protochannels")?;
        let lattice = snapshot.lattice();
        let inside: Vec<usize> = (0..channels.len()).filter(|&node| channels[node] > 0.0).collect();
        if inside.is_empty() {
            return Ok(Vec::new());
        }
        let tally = snapshot.world().get_resource::<ProtochannelTally>();
        let ProtochannelTally { wanted, reached } = tally.copied().unwrap_or_default();
        let percent = |count: usize| 100.0 * count as f64 / inside.len() as f64;
        let shared = inside.iter().filter(|&&node| channels[node] > 1.0).count();
        let clumped = inside.iter().filter(|&&node| is_clumped(lattice, &channels, node)).count();
        let values = [
            ("protochannel_voxels", inside.len() as f64),
            ("protochannel_systems", systems(lattice, &channels, &inside) as f64),
            ("protosinks", wanted as f64),
            ("protochannels_traced", reached as f64),
            ("shared_percent", percent(shared)),
            ("clumped_percent", percent(clumped)),
        ];
        Ok(values.map(|(name, value)| (name.to_owned(), value)).into())
    }
}

/// Whether at least three quarters of the neighbours of a voxel are protochannels.
fn is_clumped(lattice: &Lattice, channels: &[f64], node: usize) -> bool {
    let (mut all, mut taken) = (0, 0);
    for edge in lattice.neighbours(node) {
        all += 1;
        taken += usize::from(channels[edge.node] > 0.0);
    }
    4 * taken >= 3 * all
}

/// Number of parts that hang together.
fn systems(lattice: &Lattice, channels: &[f64], inside: &[usize]) -> usize {
    let mut seen = vec![false; channels.len()];
    let mut search = BreadthFirst::new();
    let mut count = 0;
    for &node in inside {
        if !seen[node] {
            count += 1;
            let filter = |_: usize, edge: &Edge| channels[edge.node] > 0.0;
            search.search(lattice, &[node], Reach::UNLIMITED, filter, |visit| {
                seen[visit.node] = true;
                ControlFlow::<()>::Continue(())
            });
        }
    }
    count
}
