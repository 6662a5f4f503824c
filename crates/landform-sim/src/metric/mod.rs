//! Metrics: numbers measured while a run goes on, and the series they form.

mod statistic;

pub use statistic::{FieldStatistic, Statistic};

use landform_graph::Lattice;

use crate::parameters::{Parameters, Problem};
use crate::snapshot::Snapshot;

/// A metric, chosen by name in a scenario. It may keep what it needs between measurements.
pub trait Metric: Parameters {
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
    fn measure(&mut self, snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem>;
}

/// Values of named metrics over the iterations of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    names: Vec<String>,
    rows: Vec<(u64, Vec<Option<f64>>)>,
}

impl Series {
    /// Adds the values measured after `tick` iterations.
    pub fn push(&mut self, tick: u64, values: Vec<(String, f64)>) {
        let mut row = vec![None; self.names.len()];
        for (name, value) in values {
            match self.names.iter().position(|known| *known == name) {
                Some(column) => row[column] = Some(value),
                None => {
                    self.names.push(name);
                    row.push(Some(value));
                }
            }
        }
        self.rows.push((tick, row));
    }

    /// Names of the metrics in the order they first appeared.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The rows: iteration and a value for each name, `None` where nothing was measured.
    pub fn rows(&self) -> impl Iterator<Item = (u64, Vec<Option<f64>>)> + '_ {
        self.rows.iter().map(|(tick, row)| {
            let value = |column| row.get(column).copied().flatten();
            (*tick, (0..self.names.len()).map(value).collect())
        })
    }

    /// The latest value of a metric.
    pub fn latest(&self, name: &str) -> Option<f64> {
        let column = self.names.iter().position(|known| known == name)?;
        self.rows.iter().rev().find_map(|(_, row)| row.get(column).copied().flatten())
    }

    /// The values of a metric over time, latest last.
    pub fn values(&self, name: &str) -> Vec<f64> {
        let Some(column) = self.names.iter().position(|known| known == name) else {
            return Vec::new();
        };
        self.rows.iter().filter_map(|(_, row)| row.get(column).copied().flatten()).collect()
    }

    /// The series as comma-separated values with a header, empty where nothing was measured.
    pub fn to_csv(&self) -> String {
        let mut text = format!("iteration,{}\n", self.names.join(","));
        for (tick, row) in self.rows() {
            let values = row.iter().map(|value| value.map_or(String::new(), |v| format!("{v:?}")));
            text.push_str(&format!("{tick},{}\n", values.collect::<Vec<_>>().join(",")));
        }
        text
    }
}
