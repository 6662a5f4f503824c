//! What a sweep file says, and how it is read.

use std::path::{Path, PathBuf};

use landform_sim::parameters::Problem;
use landform_sim::scenario::ScenarioSource;
use landform_sim::text::{Source, ron_diagnostic};
use ron::extensions::Extensions;
use ron::value::RawValue;
use serde::{Deserialize, Serialize};

/// Many runs of one scenario.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Sweep {
    /// What it shows, in a line.
    #[serde(default)]
    pub title: String,
    /// The scenario, relative to the sweep file.
    pub scenario: PathBuf,
    /// Changes of the scenario that all runs share.
    #[serde(default)]
    pub set: Vec<Change>,
    /// What differs between runs: every combination of the points of these blocks.
    #[serde(default)]
    pub vary: Vec<Vary>,
    /// Runs at each point, which differ in their seed only.
    #[serde(default)]
    pub seeds: Seeds,
    /// Seed of the samples, and of the seeds that [`Seeds::Count`] gives.
    #[serde(default)]
    pub seed: u64,
    /// What is plotted; every metric against the first parameter when empty.
    #[serde(default)]
    pub plots: Vec<PlotEntry>,
}

/// A change that all runs share.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Change {
    /// Path of the value in the scenario, as `--set` takes it.
    pub path: String,
    /// The value.
    pub value: Box<RawValue>,
}

/// A block of parameters that vary together.
#[derive(Deserialize)]
pub(crate) enum Vary {
    /// Every combination of the values.
    Grid(Vec<Listed>),
    /// First values together, then the second ones and so on.
    Zip(Vec<Listed>),
    /// Random points.
    Random {
        /// Number of points.
        samples: usize,
        /// The parameters.
        parameters: Vec<Sampled>,
    },
    /// Random points of which each parameter has one in each of as many equal parts of its range
    /// (McKay, Beckman and Conover 1979).
    LatinHypercube {
        /// Number of points.
        samples: usize,
        /// The parameters.
        parameters: Vec<Sampled>,
    },
}

/// A parameter with a list of values.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Listed {
    /// Path of the value in the scenario, as `--set` takes it.
    pub path: String,
    /// Name in the table and in plots; the end of the path when empty.
    #[serde(default)]
    pub name: String,
    /// The values.
    pub values: Vec<Box<RawValue>>,
}

/// A parameter with a range to draw from.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Sampled {
    /// Path of the value in the scenario, as `--set` takes it.
    pub path: String,
    /// Name in the table and in plots; the end of the path when empty.
    #[serde(default)]
    pub name: String,
    /// The range.
    pub from: Range,
}

/// A range to draw from.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) enum Range {
    /// Numbers from the first up to the second, all equally likely.
    Uniform(f64, f64),
    /// Numbers from the first up to the second, whose logarithms are equally likely.
    LogUniform(f64, f64),
    /// Whole numbers from the first to the second, both included.
    Integer(i64, i64),
}

/// Seeds of the runs at a point.
#[derive(Clone, Debug, Deserialize)]
pub(crate) enum Seeds {
    /// So many runs, each with a seed that no other run of the sweep has.
    Count(u64),
    /// These seeds, the same ones at every point.
    List(Vec<u64>),
}

impl Default for Seeds {
    fn default() -> Self {
        Self::Count(1)
    }
}

/// A panel of the plots.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlotEntry {
    /// Name of the metric.
    pub metric: String,
    /// Name of the parameter along the horizontal axis; the first one when empty.
    #[serde(default)]
    pub against: String,
    /// Name of the parameter that tells series apart; none when empty.
    #[serde(default)]
    pub by: String,
    /// Whether the horizontal axis is logarithmic.
    #[serde(default)]
    pub log_x: bool,
    /// Whether the vertical axis is logarithmic.
    #[serde(default)]
    pub log_y: bool,
}

/// The text of a sweep file.
pub(crate) struct SweepSource(ScenarioSource);

impl SweepSource {
    /// Reads the file at `path`.
    pub fn open(path: &Path) -> Result<Self, String> {
        ScenarioSource::open(path).map(Self)
    }

    /// A sweep given as text; `folder` holds relative paths.
    #[cfg(test)]
    pub fn from_text(text: &str, folder: &Path) -> Self {
        Self(ScenarioSource::from_text("test.sweep.ron", text, folder))
    }

    /// Folder of the file, for relative paths.
    pub fn folder(&self) -> &Path {
        self.0.folder()
    }

    /// Parses the sweep. What it says of the scenario is checked by [`super::prepare`].
    pub fn parse(&self, name: &Path) -> Result<Sweep, String> {
        let source = Source::new(name.display().to_string(), self.0.text());
        let options = ron::Options::default().with_default_extension(
            Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES,
        );
        options
            .from_str(source.text())
            .map_err(|error| ron_diagnostic(&source, &error).render(&source))
    }

    /// A problem as a message that points at its place in the file.
    pub fn render(&self, problem: &Problem) -> String {
        self.0.render(problem)
    }
}
