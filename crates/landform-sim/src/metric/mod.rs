//! Metrics: numbers measured while a run goes on, and the series they form.

mod meter;
mod series;
mod statistic;

pub use meter::Meter;
pub use series::Series;
pub use statistic::{FieldStatistic, Statistic};

pub(crate) use meter::Opened;

use landform_graph::Lattice;

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
