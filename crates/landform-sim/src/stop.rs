//! Stop rules: when a stage is over.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::code::Code;
use crate::metric::Series;
use crate::parameters::Problem;

/// When a stage is over.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Stop {
    /// When every process that has an end has reached it.
    #[default]
    Finished,
    /// After a number of iterations of the stage.
    Iterations(u64),
    /// When a metric falls below a value.
    Below {
        /// Name of the metric as it stands in the series.
        metric: String,
        /// The value.
        value: f64,
    },
    /// When a metric rises above a value.
    Above {
        /// Name of the metric as it stands in the series.
        metric: String,
        /// The value.
        value: f64,
    },
    /// When a metric has changed by less than a share of itself over its latest measurements.
    Steady {
        /// Name of the metric as it stands in the series.
        metric: String,
        /// Largest change, as a share of the metric's value.
        change: f64,
        /// Number of measurements, at least two.
        measurements: usize,
    },
    /// When any of several rules says so.
    Any(Vec<Stop>),
}

impl Stop {
    /// Why the stage is over after `iteration` iterations, `tick` of the whole run, if it is.
    /// `ends` are the ends of the stage's processes. Metrics that were measured earlier say
    /// nothing about now.
    pub(crate) fn reason(
        &self,
        [iteration, tick]: [u64; 2],
        ends: &[u64],
        series: &Series,
    ) -> Option<String> {
        match self {
            Self::Finished => ends
                .iter()
                .max()
                .filter(|&&end| iteration >= end)
                .map(|_| "the processes have finished".to_owned()),
            Self::Iterations(count) => {
                (iteration >= *count).then(|| format!("{count} iterations are done"))
            }
            Self::Below { metric, value } => {
                let latest = series.fresh(metric, tick).filter(|latest| latest < value)?;
                Some(format!("{metric} = {latest} fell below {value}"))
            }
            Self::Above { metric, value } => {
                let latest = series.fresh(metric, tick).filter(|latest| latest > value)?;
                Some(format!("{metric} = {latest} rose above {value}"))
            }
            Self::Steady { metric, change, measurements } => {
                series.fresh(metric, tick)?;
                let none = [f64::INFINITY, f64::NEG_INFINITY];
                let widen = |[low, high]: [f64; 2], value: f64| [value.min(low), value.max(high)];
                let [low, high] = series.recent(metric, *measurements)?.fold(none, widen);
                (high - low <= change * high.abs().max(low.abs()))
                    .then(|| format!("{metric} is steady at {high}"))
            }
            Self::Any(rules) => {
                rules.iter().find_map(|rule| rule.reason([iteration, tick], ends, series))
            }
        }
    }

    /// Iterations after which the rule stops the stage at the latest, if that is known.
    pub(crate) fn latest_end(&self, ends: &[u64]) -> Option<u64> {
        match self {
            Self::Finished => ends.iter().max().copied(),
            Self::Iterations(count) => Some(*count),
            Self::Any(rules) => rules.iter().filter_map(|rule| rule.latest_end(ends)).min(),
            _ => None,
        }
    }

    /// Number of measurements that the rule looks at.
    pub(crate) fn measurements(&self) -> usize {
        match self {
            Self::Steady { measurements, .. } => *measurements,
            Self::Any(rules) => rules.iter().map(Self::measurements).max().unwrap_or(1),
            _ => 1,
        }
    }

    /// Names of the metrics that the rule looks at.
    pub(crate) fn metrics(&self) -> Vec<&str> {
        match self {
            Self::Finished | Self::Iterations(_) => Vec::new(),
            Self::Below { metric, .. }
            | Self::Above { metric, .. }
            | Self::Steady { metric, .. } => vec![metric],
            Self::Any(rules) => rules.iter().flat_map(Self::metrics).collect(),
        }
    }

    /// Refuses rules that can never stop a stage or stop it before it does anything.
    pub(crate) fn check(&self, ends: &[u64]) -> Result<(), Problem> {
        let refuse = |message: &str, expected: &str| {
            Err(Problem::new("stop", message, expected).code(Code::Never))
        };
        match self {
            Self::Finished if ends.is_empty() => refuse(
                "the stage never ends: none of its processes has an end of its own",
                "a stop rule such as `stop: Iterations(100)`",
            ),
            Self::Finished if ends.iter().max() == Some(&0) => {
                refuse("the processes have nothing to do", "a process with at least one iteration")
            }
            Self::Iterations(0) => refuse("the stage has zero iterations", "at least one"),
            Self::Below { value, .. } | Self::Above { value, .. } if !value.is_finite() => {
                refuse("the value is never reached", "a finite `value`")
            }
            Self::Steady { measurements: 0 | 1, .. } => {
                refuse("one measurement cannot be steady", "`measurements` of at least 2")
            }
            Self::Steady { change, .. } if !(change.is_finite() && *change >= 0.0) => {
                refuse("no change is that small", "a finite `change` of at least 0")
            }
            Self::Any(rules) if rules.is_empty() => refuse("no rule is given", "at least one rule"),
            Self::Any(rules) => rules.iter().try_for_each(|rule| rule.check(ends)),
            _ => Ok(()),
        }
    }
}
