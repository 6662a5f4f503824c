//! Metrics: numbers measured while a run goes on, and the series they form.

mod group;
mod meter;
mod series;
mod statistic;

pub use group::{AgentCount, AgentStatistic};
pub use meter::Meter;
pub use series::{RowsKept, Series, csv_header, csv_line};
pub use statistic::{FieldStatistic, Region, Statistic};

pub(crate) use meter::Opened;

use landform_graph::Lattice;

use crate::agent::GroupUse;
use crate::checkpoint::Keep;
use crate::parameters::{Parameters, Problem};
use crate::snapshot::Snapshot;

/// A metric, chosen by name in a scenario.
pub trait Metric: Parameters {
    /// What it remembers from one measurement to the next, `()` for nothing. Checkpoints save it.
    type Memory: Keep + Default + Send + Sync + 'static;

    /// Name in scenarios.
    const NAME: &'static str;

    /// Fields that the metric needs, so that a wrong name is refused before the run.
    fn fields(&self) -> Vec<String> {
        Vec::new()
    }

    /// Groups of agents that the metric needs, and quantities of theirs, so that a wrong name is
    /// refused before the run.
    fn groups(&self) -> Vec<GroupUse> {
        Vec::new()
    }

    /// Refuses before the run what the ranges of single parameters do not show.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter, what was expected and what to do.
    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        Ok(())
    }

    /// Named values at this moment; an empty list when there is nothing to measure yet. The
    /// names carry their unit (`crest_spacing_m`) and stay the same over the run.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter (an unknown field, say).
    fn measure(
        &self,
        memory: &mut Self::Memory,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem>;
}

/// The name of a column with the unit of its values, if they have one.
fn with_unit(name: String, unit: &str) -> String {
    match unit {
        "1" => name,
        unit => format!("{name}_{unit}"),
    }
}
