//! When an output is due.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Moment;
use crate::code::Code;
use crate::parameters::Problem;
use crate::snapshot::Snapshot;

/// When an output is due.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum When {
    /// After the last iteration.
    #[default]
    End,
    /// Before the first iteration.
    Start,
    /// Before the first iteration and at the end of each stage.
    StageEnds,
    /// Before the first iteration and after every so many iterations.
    Every(u64),
    /// At the first measurement of a metric that is below a value.
    Below {
        /// Name of the metric as it stands in the series.
        metric: String,
        /// The value.
        value: f64,
        /// Whether it is due at every such measurement and not only at the first one.
        #[serde(default)]
        while_it_holds: bool,
    },
    /// At the first measurement of a metric that is above a value.
    Above {
        /// Name of the metric as it stands in the series.
        metric: String,
        /// The value.
        value: f64,
        /// Whether it is due at every such measurement and not only at the first one.
        #[serde(default)]
        while_it_holds: bool,
    },
    /// Whenever any of several is due, once for an iteration.
    Any(Vec<When>),
}

impl When {
    /// Whether the output is due now. What was due after an iteration is not due once more when
    /// that iteration turns out to be the last one of its stage or of the run.
    pub fn is_due(&self, moment: Moment, snapshot: &Snapshot<'_>) -> bool {
        let earlier: &[Moment] = match moment {
            Moment::Start | Moment::Iteration => &[],
            Moment::StageEnd => &[Moment::Iteration],
            Moment::End => &[Moment::Iteration, Moment::StageEnd],
        };
        self.names(moment, snapshot) && !earlier.iter().any(|&each| self.names(each, snapshot))
    }

    /// Whether this moment is one of those that are named.
    fn names(&self, moment: Moment, snapshot: &Snapshot<'_>) -> bool {
        let measured = matches!(moment, Moment::Start | Moment::Iteration);
        match self {
            Self::End => moment == Moment::End,
            Self::Start => moment == Moment::Start,
            Self::StageEnds => matches!(moment, Moment::Start | Moment::StageEnd),
            Self::Every(count) => measured && snapshot.clock().tick.is_multiple_of((*count).max(1)),
            Self::Below { metric, value, while_it_holds } => {
                measured && holds(snapshot, metric, *while_it_holds, |each| each < *value)
            }
            Self::Above { metric, value, while_it_holds } => {
                measured && holds(snapshot, metric, *while_it_holds, |each| each > *value)
            }
            Self::Any(several) => several.iter().any(|when| when.names(moment, snapshot)),
        }
    }

    /// Whether it may be due more than once.
    fn repeats(&self) -> bool {
        match self {
            Self::End | Self::Start => false,
            Self::Below { while_it_holds, .. } | Self::Above { while_it_holds, .. } => {
                *while_it_holds
            }
            Self::StageEnds | Self::Every(_) | Self::Any(_) => true,
        }
    }

    /// The name of the file that is due now, below the output folder: `file`, or where there
    /// may be several of them `file` with the number of iterations in it.
    pub fn file_name(&self, file: &Path, snapshot: &Snapshot<'_>) -> PathBuf {
        if !self.repeats() {
            return file.to_owned();
        }
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        file.with_file_name(format!("{stem}_{:06}.{extension}", snapshot.clock().tick))
    }

    /// Names of the metrics that decide.
    pub fn metrics(&self) -> Vec<String> {
        match self {
            Self::Below { metric, .. } | Self::Above { metric, .. } => vec![metric.clone()],
            Self::Any(several) => several.iter().flat_map(Self::metrics).collect(),
            Self::End | Self::Start | Self::StageEnds | Self::Every(_) => Vec::new(),
        }
    }

    /// Refuses what is never due or says nothing.
    ///
    /// # Errors
    /// The [`Problem`] is one of the parameter `when`.
    pub fn check(&self) -> Result<(), Problem> {
        let refuse = |message: &str, expected: &str| {
            Err(Problem::new("when", message, expected).code(Code::Never))
        };
        match self {
            Self::Every(0) => refuse("it is due every 0 iterations", "at least 1"),
            Self::Any(several) if several.is_empty() => {
                refuse("it is never due", "at least one moment")
            }
            Self::Any(several) => several.iter().try_for_each(Self::check),
            _ => Ok(()),
        }
    }
}

/// Whether `metric` was measured now and `test` holds, for the first time or not.
fn holds(
    snapshot: &Snapshot<'_>,
    metric: &str,
    repeatedly: bool,
    test: impl Fn(f64) -> bool,
) -> bool {
    let series = snapshot.series();
    let earlier = || series.earlier_range(metric).is_some_and(|range| range.into_iter().any(&test));
    series.fresh(metric, snapshot.clock().tick).is_some_and(&test) && (repeatedly || !earlier())
}
