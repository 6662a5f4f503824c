//! What was measured in a run.

use crate::checkpoint::{Damage, Keep, Loader, Saver};

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

/// One array of iterations, one of values row by row, and one that says which of them were
/// measured.
impl Keep for Series {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        let values = || self.rows().flat_map(|(_, row)| row);
        to.value("names", &self.names);
        to.owned("ticks", self.rows.iter().map(|(tick, _)| *tick).collect());
        to.owned("values", values().map(|value| value.unwrap_or(f64::NAN)).collect());
        to.owned("measured", values().map(|value| u8::from(value.is_some())).collect());
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let names: Vec<String> = from.value("names")?;
        let ticks = from.array::<u64>("ticks")?;
        let cells = ticks.len().saturating_mul(names.len());
        let values = from.array_of::<f64>("values", cells)?;
        let measured = from.array_of::<u8>("measured", cells)?;
        let row = |row: usize| {
            let cells = row * names.len()..(row + 1) * names.len();
            cells.map(|cell| (measured[cell] == 1).then_some(values[cell])).collect()
        };
        let rows = ticks.iter().enumerate().map(|(index, &tick)| (tick, row(index))).collect();
        Ok(Self { names, rows })
    }
}
