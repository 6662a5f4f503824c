//! Caves as processes and metrics that scenarios may name.

mod fields;
mod growth;
mod metrics;
mod network_metrics;
mod places;
mod protochannels;

pub use fields::{Porosity, Pressure, PressureZone, ProtochannelCount};
pub use growth::{CaveGrowth, CaveHistory, CaveWater, WaterMotion};
pub use metrics::{CaveCourses, Passages};
pub use network_metrics::{PressureZones, ProtochannelSystems};
pub use places::CavePlaces;
pub use protochannels::{ProtochannelTally, Protochannels};

use landform_graph::Lattice;
use landform_sim::parameters::Problem;

use crate::growth::Openings;
use crate::place::box_nodes;
use crate::{CaveError, CaveSink, CaveSource};

/// A refusal by the kernels, at the parameter that it is about.
fn refusal(error: &CaveError, parameter: impl Into<String>) -> Problem {
    Problem::new(parameter, error.to_string(), "")
}

/// The voxels of sources and sinks.
fn openings(
    lattice: &Lattice,
    sources: &[CaveSource],
    sinks: &[CaveSink],
) -> Result<Openings, Problem> {
    let nodes = |list: &str, number: usize, center: [f64; 3], size_m: [f64; 3]| {
        box_nodes(lattice, center, size_m)
            .map_err(|error| refusal(&error, format!("{list}[{number}]")))
    };
    let mut openings = Openings::default();
    for (number, source) in sources.iter().enumerate() {
        openings.sources.push(nodes("sources", number, source.center, source.size_m)?);
        openings.pressures.push(source.pressure);
        openings.strengths.push(source.strength);
    }
    for (number, sink) in sinks.iter().enumerate() {
        openings.sinks.extend(nodes("sinks", number, sink.center, sink.size_m)?);
    }
    openings.sinks.sort_unstable();
    openings.sinks.dedup();
    openings.check().map_err(|error| match error {
        CaveError::NoSource => refusal(&error, "sources").help("give at least one source"),
        _ => refusal(&error, "sources"),
    })?;
    Ok(openings)
}
