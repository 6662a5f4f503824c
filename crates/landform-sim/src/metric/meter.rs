//! Metrics at work, without their types.

use super::Metric;
use crate::checkpoint::{Damage, Keep, Loader, Saver};
use crate::parameters::Problem;
use crate::snapshot::Snapshot;

/// A [`Metric`] at work, with what it remembers.
pub trait Meter {
    /// See [`Metric::measure`].
    ///
    /// # Errors
    /// As the metric says.
    fn measure(&mut self, snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem>;

    /// Saves what it remembers.
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>);

    /// Remembers what was saved.
    ///
    /// # Errors
    /// What is missing or cannot be used.
    fn restore(&mut self, from: &Loader<'_>) -> Result<(), Damage>;
}

/// A metric and its memory.
pub(crate) struct Opened<M: Metric> {
    pub(crate) metric: M,
    pub(crate) memory: M::Memory,
}

impl<M: Metric> Meter for Opened<M> {
    fn measure(&mut self, snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        self.metric.measure(&mut self.memory, snapshot)
    }

    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        self.memory.save(to);
    }

    fn restore(&mut self, from: &Loader<'_>) -> Result<(), Damage> {
        self.memory = M::Memory::restore(from)?;
        Ok(())
    }
}
