//! What a target file says.

use std::path::PathBuf;

use serde::Deserialize;

use super::{PlotEntry, Quantity};

/// A figure or table of the thesis, or of another source, with its numbers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Name in the thesis, or another source: `table 4.1`.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// What the numbers beside ours are from: a heading of the table.
    #[serde(default = "thesis")]
    pub source: String,
    /// Number of seeds.
    pub seeds: u64,
    /// What is taken of the numbers of all seeds.
    #[serde(default)]
    pub average: Average,
    /// Pictures in a row of one figure of the first pictures of all runs; no such figure when 0.
    #[serde(default)]
    pub columns: usize,
    /// The scenarios to run.
    #[serde(default)]
    pub runs: Vec<RunEntry>,
    /// The files of measured data to analyse, which the user has to bring.
    #[serde(default)]
    pub analyses: Vec<AnalysisEntry>,
    /// The numbers.
    pub targets: Vec<Target>,
    /// Plots of the numbers, panels of one picture.
    #[serde(default)]
    pub plots: Vec<PlotEntry>,
}

fn thesis() -> String {
    "thesis".to_owned()
}

/// One number for those of several seeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Average {
    /// The one in the middle, which single odd runs do not change.
    #[default]
    Median,
    /// The arithmetic mean, as published means want it.
    Mean,
}

impl Average {
    /// The average of some numbers; none of none.
    pub fn of(self, values: &[f64]) -> Option<f64> {
        match self {
            Self::Median => {
                let mut sorted = values.to_vec();
                sorted.sort_by(f64::total_cmp);
                sorted.get(sorted.len() / 2).copied()
            }
            Self::Mean if values.is_empty() => None,
            Self::Mean => Some(values.iter().sum::<f64>() / values.len() as f64),
        }
    }
}

/// A scenario to run with every seed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunEntry {
    /// Name within the file.
    pub name: String,
    /// The scenario, relative to the target file.
    pub scenario: PathBuf,
    /// Changes of the scenario, each `PATH=VALUE` as `--set` takes it.
    #[serde(default)]
    pub set: Vec<String>,
    /// A parameter that runs of this name differ in; a single run when missing.
    #[serde(default)]
    pub over: Option<Over>,
}

/// A raster of measured heights to analyse.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnalysisEntry {
    /// Name within the file: its numbers belong to a run of this name and the stage `analysis`.
    pub name: String,
    /// The raster, relative to the folder of data that the user names.
    pub file: PathBuf,
}

/// Runs of one name at equal distances of a parameter, each with a seed of its own.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Over {
    /// Path of the parameter in the scenario, as `--set` takes it.
    pub path: String,
    /// Its value in the first run.
    pub from: f64,
    /// Its value in the last run.
    pub to: f64,
    /// Number of runs.
    pub count: u64,
}

/// A run that an entry asks for: changes of its scenario, and its seed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Copy {
    /// Changes as path and value.
    pub set: Vec<(String, String)>,
    /// The seed.
    pub seed: u64,
}

impl RunEntry {
    /// The runs that `seed` stands for: one with that seed, or several with seeds that no other
    /// `seed` stands for.
    ///
    /// # Errors
    /// A message when a change is no path and value, or there are no runs.
    pub(super) fn copies(&self, seed: u64) -> Result<Vec<Copy>, String> {
        let change = |text: &String| match text.split_once('=') {
            Some((path, value)) => Ok((path.to_owned(), value.to_owned())),
            None => Err(format!("the run `{}`: `{text}` is no PATH=VALUE", self.name)),
        };
        let set: Vec<(String, String)> = self.set.iter().map(change).collect::<Result<_, _>>()?;
        let Some(over) = &self.over else { return Ok(vec![Copy { set, seed }]) };
        if !(1..=Over::MOST).contains(&over.count) {
            let (name, most) = (&self.name, Over::MOST);
            return Err(format!("the run `{name}`: `over` wants a `count` from 1 to {most}"));
        }
        let copy = |index: u64| {
            let value = (over.path.clone(), format!("{:?}", over.value(index)));
            let set = set.iter().cloned().chain([value]).collect();
            Copy { set, seed: (seed - 1) * over.count + index + 1 }
        };
        Ok((0..over.count).map(copy).collect())
    }
}

impl Over {
    /// Most runs of one name.
    const MOST: u64 = 10_000;

    /// Value of the parameter in a run.
    fn value(&self, index: u64) -> f64 {
        let share = index as f64 / self.count.saturating_sub(1).max(1) as f64;
        self.from + share * (self.to - self.from)
    }
}

/// One number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// What it is, in words.
    pub name: String,
    /// How it is taken from the runs.
    pub value: Quantity,
    /// The thesis' number, or that of the source.
    #[serde(default)]
    pub thesis: Option<f64>,
    /// What counts as reproduced.
    pub band: Band,
    /// What is known about a difference.
    #[serde(default)]
    pub reason: String,
}

/// What counts as reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub enum Band {
    /// Nothing: the number is printed beside the thesis' own.
    Printed,
    /// A number from the first to the second.
    Within(f64, f64),
    /// At least this.
    AtLeast(f64),
    /// At most this.
    AtMost(f64),
}

impl Band {
    /// Whether a number lies in the band; `None` when there is no band.
    pub fn holds(self, value: f64) -> Option<bool> {
        match self {
            Self::Printed => None,
            Self::Within(low, high) => Some((low..=high).contains(&value)),
            Self::AtLeast(least) => Some(value >= least),
            Self::AtMost(most) => Some(value <= most),
        }
    }
}

impl std::fmt::Display for Band {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Printed => write!(f, "printed"),
            Self::Within(low, high) => write!(f, "{low} to {high}"),
            Self::AtLeast(least) => write!(f, "at least {least}"),
            Self::AtMost(most) => write!(f, "at most {most}"),
        }
    }
}
