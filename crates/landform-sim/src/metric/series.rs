//! The values of metrics over the iterations of a run.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::checkpoint::{Damage, Keep, Loader, Saver};

/// Which rows of a series stay in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RowsKept {
    /// All of them.
    #[default]
    All,
    /// The latest one: whoever needs the others writes them down as they come.
    Latest,
}

/// Values of named metrics over the iterations of a run.
///
/// Beside the rows it keeps what rules on metrics look at: of each metric the latest values, as
/// many as the longest rule needs, and the least and the greatest of all earlier ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    names: Vec<String>,
    columns: Vec<Column>,
    rows: Vec<Row>,
    kept: RowsKept,
    window: usize,
}

/// An iteration, and a value for each of the first names, `None` where nothing was measured.
type Row = (u64, Vec<Option<f64>>);

/// What rules need to know of one metric.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Column {
    /// The latest values, latest last.
    recent: VecDeque<f64>,
    /// Iterations that were done at the latest value.
    tick: u64,
    /// Least and greatest value before the latest one.
    earlier: Option<[f64; 2]>,
}

impl Column {
    fn push(&mut self, tick: u64, value: f64, window: usize) {
        if let Some(&previous) = self.recent.back() {
            let [least, most] = self.earlier.unwrap_or([previous; 2]);
            self.earlier = Some([least.min(previous), most.max(previous)]);
        }
        self.tick = tick;
        self.recent.push_back(value);
        while self.recent.len() > window.max(1) {
            self.recent.pop_front();
        }
    }
}

impl Series {
    /// An empty series that keeps the latest `window` values of each metric for rules.
    pub fn new(window: usize) -> Self {
        Self { window, ..Self::default() }
    }

    /// Decides which rows stay in memory from now on.
    pub fn keep(&mut self, kept: RowsKept) {
        self.kept = kept;
    }

    /// Adds the values measured after `tick` iterations.
    pub fn push(&mut self, tick: u64, values: Vec<(String, f64)>) {
        let mut row = vec![None; self.names.len()];
        for (name, value) in values {
            let column = self.column(&name).unwrap_or_else(|| {
                self.names.push(name);
                self.columns.push(Column::default());
                row.push(None);
                self.names.len() - 1
            });
            row[column] = Some(value);
            self.columns[column].push(tick, value, self.window);
        }
        if self.kept == RowsKept::Latest {
            self.rows.clear();
        }
        self.rows.push((tick, row));
    }

    /// Names of the metrics in the order they first appeared.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The rows in memory: iteration and a value for each name, `None` where nothing was
    /// measured.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = (u64, Vec<Option<f64>>)> + '_ {
        self.rows.iter().map(|(tick, row)| {
            let value = |column| row.get(column).copied().flatten();
            (*tick, (0..self.names.len()).map(value).collect())
        })
    }

    /// Iterations that were done at the latest measurement.
    pub fn latest_tick(&self) -> Option<u64> {
        self.rows.last().map(|(tick, _)| *tick)
    }

    /// The latest value of a metric.
    pub fn latest(&self, name: &str) -> Option<f64> {
        self.columns[self.column(name)?].recent.back().copied()
    }

    /// The latest value of a metric if it was measured after `tick` iterations.
    pub fn fresh(&self, name: &str, tick: u64) -> Option<f64> {
        self.column(name).filter(|&column| self.columns[column].tick == tick)?;
        self.latest(name)
    }

    /// Least and greatest value of a metric before its latest one.
    pub fn earlier_range(&self, name: &str) -> Option<[f64; 2]> {
        self.columns[self.column(name)?].earlier
    }

    /// The latest `count` values of a metric, latest last; `None` while there are fewer. `count`
    /// is at most the window of the series.
    pub fn recent(&self, name: &str, count: usize) -> Option<impl Iterator<Item = f64> + '_> {
        let recent = &self.columns[self.column(name)?].recent;
        recent.len().checked_sub(count).map(|start| recent.range(start..).copied())
    }

    /// The values of a metric in the rows in memory, latest last.
    pub fn values(&self, name: &str) -> Vec<f64> {
        let Some(column) = self.column(name) else { return Vec::new() };
        self.rows.iter().filter_map(|(_, row)| row.get(column).copied().flatten()).collect()
    }

    /// The rows in memory as comma-separated values with a header, empty where nothing was
    /// measured.
    pub fn to_csv(&self) -> String {
        let rows = self.rows().map(|(tick, row)| csv_line(tick, &row));
        csv_header(&self.names) + &rows.collect::<String>()
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }
}

/// One array of iterations, one of values row by row, and one that says which of them were
/// measured; what rules look at is kept as text.
impl Keep for Series {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        let values = || self.rows().flat_map(|(_, row)| row);
        to.value("names", &self.names);
        to.value("columns", &self.columns);
        to.value("kept", &(self.kept, self.window));
        to.owned("ticks", self.rows.iter().map(|(tick, _)| *tick).collect());
        to.owned("values", values().map(|value| value.unwrap_or(f64::NAN)).collect());
        to.owned("measured", values().map(|value| u8::from(value.is_some())).collect());
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let names: Vec<String> = from.value("names")?;
        let columns: Vec<Column> = from.value("columns")?;
        if columns.len() != names.len() {
            return Err(from.refuse("columns", "they do not fit the names"));
        }
        let (kept, window) = from.value("kept")?;
        let ticks = from.array::<u64>("ticks")?;
        let cells = ticks.len().saturating_mul(names.len());
        let values = from.array_of::<f64>("values", cells)?;
        let measured = from.array_of::<u8>("measured", cells)?;
        let row = |row: usize| {
            let cells = row * names.len()..(row + 1) * names.len();
            cells.map(|cell| (measured[cell] == 1).then_some(values[cell])).collect()
        };
        let rows = ticks.iter().enumerate().map(|(index, &tick)| (tick, row(index))).collect();
        Ok(Self { names, columns, rows, kept, window })
    }
}

/// The first line of a series as comma-separated values.
pub fn csv_header(names: &[String]) -> String {
    format!("iteration,{}\n", names.join(","))
}

/// A line of a series as comma-separated values, empty where nothing was measured.
pub fn csv_line(tick: u64, row: &[Option<f64>]) -> String {
    let values = row.iter().map(|value| value.map_or(String::new(), |value| format!("{value:?}")));
    format!("{tick},{}\n", values.collect::<Vec<_>>().join(","))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checkpoint::Checkpoint;

    fn named(values: &[(&str, f64)]) -> Vec<(String, f64)> {
        values.iter().map(|&(name, value)| (name.to_owned(), value)).collect()
    }

    #[test]
    fn late_columns_are_empty_in_earlier_rows() {
        let mut series = Series::new(1);
        series.push(0, named(&[("a", 1.0)]));
        series.push(5, named(&[("a", 2.0), ("b", f64::NAN)]));
        series.push(9, named(&[("b", 0.1)]));
        assert_eq!(series.to_csv(), "iteration,a,b\n0,1.0,\n5,2.0,NaN\n9,,0.1\n");
        assert_eq!(series.latest("a"), Some(2.0));
        assert_eq!((series.fresh("a", 9), series.fresh("b", 9)), (None, Some(0.1)));
        assert_eq!(series.latest("c"), None);
    }

    #[test]
    fn rules_see_the_same_whichever_rows_are_kept() {
        let mut all = Series::new(3);
        let mut latest = Series::new(3);
        latest.keep(RowsKept::Latest);
        for (tick, value) in [4.0, 1.0, 3.0, 2.0, 5.0].into_iter().enumerate() {
            for series in [&mut all, &mut latest] {
                series.push(tick as u64, named(&[("a", value)]));
            }
        }
        for series in [&all, &latest] {
            assert_eq!(series.recent("a", 3).unwrap().collect::<Vec<_>>(), [3.0, 2.0, 5.0]);
            assert!(series.recent("a", 4).is_none());
            assert_eq!(series.earlier_range("a"), Some([1.0, 4.0]));
            assert_eq!(series.latest("a"), Some(5.0));
        }
        assert_eq!((all.rows().count(), latest.rows().count()), (5, 1));
    }

    #[test]
    fn a_series_comes_back_from_a_checkpoint() {
        for kept in [RowsKept::All, RowsKept::Latest] {
            let mut series = Series::new(2);
            series.keep(kept);
            series.push(0, named(&[("a", 0.1), ("b", f64::INFINITY)]));
            for tick in 1..5 {
                series.push(tick, named(&[("a", (tick as f64).sqrt())]));
            }
            let mut checkpoint = Checkpoint::default();
            checkpoint.saver("").keep("series", &series);
            assert_eq!(checkpoint.loader("").keep("series"), Ok(series.clone()));
        }
    }
}
