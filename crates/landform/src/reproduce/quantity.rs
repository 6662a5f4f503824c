//! How a number is taken from the runs of one seed.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::Law;
use super::law::exponent;

/// Metrics by stage of one run.
pub(super) type StageMetrics = BTreeMap<String, BTreeMap<String, f64>>;

/// The runs of every name.
pub(super) type Runs<'a> = BTreeMap<&'a str, Vec<StageMetrics>>;

/// How a number is taken from the runs of one seed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub enum Quantity {
    /// A metric of a run.
    Metric(Source),
    /// The metric of one run divided by that of another.
    Ratio(Source, Source),
    /// The metric of one run less that of another.
    Difference(Source, Source),
    /// The metric of one run and that of another together: of two stages that are 1 or 0, whether it
    /// is one of them.
    Sum(Source, Source),
    /// The smallest metric of the runs of one name: see [`RunEntry::over`](super::RunEntry::over).
    Smallest(Source),
    /// The largest metric of the runs of one name.
    Largest(Source),
    /// The exponent of the power that fits metrics best against the numbers before them, by least
    /// squares of logarithms.
    Exponent(Vec<(f64, Source)>),
    /// The first metric divided by what the law says for the second one.
    ByLaw(Source, Source, Law),
}

/// A metric of a run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Name of the run.
    pub run: String,
    /// Name of the stage at whose end it is measured; `initial` for the state before the first
    /// iteration.
    pub stage: String,
    /// Name of the metric in the series.
    pub metric: String,
}

impl Quantity {
    /// The metrics that it is made of.
    pub(super) fn sources(&self) -> Vec<&Source> {
        match self {
            Self::Metric(source) | Self::Smallest(source) | Self::Largest(source) => vec![source],
            Self::Ratio(first, second)
            | Self::Difference(first, second)
            | Self::Sum(first, second)
            | Self::ByLaw(first, second, _) => vec![first, second],
            Self::Exponent(points) => points.iter().map(|(_, source)| source).collect(),
        }
    }

    /// Whether it is taken over several runs of one name.
    pub(super) fn is_extreme(&self) -> bool {
        matches!(self, Self::Smallest(_) | Self::Largest(_))
    }

    /// What is wrong with it, whatever the runs come to.
    pub(super) fn problem(&self) -> Option<&'static str> {
        let Self::Exponent(points) = self else { return None };
        let places: Vec<[f64; 2]> = points.iter().map(|(x, _)| [*x, 1.0]).collect();
        exponent(&places).is_none().then_some("an Exponent wants two different numbers above 0")
    }

    /// The number.
    ///
    /// # Errors
    /// A message that names a metric which the runs do not have, or which has no logarithm.
    pub(super) fn of(&self, runs: &Runs<'_>) -> Result<f64, String> {
        let first = |source: &Source| source.all(runs).map(|values| values[0]);
        Ok(match self {
            Self::Metric(source) => first(source)?,
            Self::Ratio(of, to) => first(of)? / first(to)?,
            Self::Difference(of, less) => first(of)? - first(less)?,
            Self::Sum(one, other) => first(one)? + first(other)?,
            Self::Smallest(source) => source.all(runs)?.into_iter().fold(f64::INFINITY, f64::min),
            Self::Largest(source) => {
                source.all(runs)?.into_iter().fold(f64::NEG_INFINITY, f64::max)
            }
            Self::Exponent(points) => {
                let point = |(x, source): &(f64, Source)| Ok([*x, first(source)?]);
                let points = points.iter().map(point).collect::<Result<Vec<_>, String>>()?;
                let why = || format!("no power goes through {points:?}: all must be above 0");
                exponent(&points).ok_or_else(why)?
            }
            Self::ByLaw(of, at, law) => first(of)? / law.at(first(at)?),
        })
    }
}

impl Source {
    /// The metric of all runs of the name, at least one.
    fn all(&self, runs: &Runs<'_>) -> Result<Vec<f64>, String> {
        let Self { run, stage, metric } = self;
        let runs = runs.get(run.as_str()).map_or(&[][..], Vec::as_slice);
        let find = |run: &StageMetrics| run.get(stage)?.get(metric).copied();
        let values: Option<Vec<f64>> = runs.iter().map(find).collect();
        values.filter(|values| !values.is_empty()).ok_or_else(|| {
            format!("the run `{run}` has no metric `{metric}` at the end of a stage `{stage}`")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(run: &str) -> Source {
        Source { run: run.into(), stage: "s".into(), metric: "m".into() }
    }

    #[test]
    fn quantities_are_taken_over_runs() {
        let run = |value: f64| {
            let metrics = BTreeMap::from([("m".to_owned(), value)]);
            StageMetrics::from([("s".to_owned(), metrics)])
        };
        let runs = Runs::from([("a", vec![run(3.0), run(5.0), run(2.0)]), ("b", vec![run(4.0)])]);
        let [a, b] = ["a", "b"].map(source);
        for (asked, expected) in [
            (Quantity::Smallest(a.clone()), 2.0),
            (Quantity::Largest(a.clone()), 5.0),
            (Quantity::Difference(b.clone(), b.clone()), 0.0),
            (Quantity::Sum(b.clone(), b.clone()), 8.0),
            (Quantity::Ratio(b.clone(), b.clone()), 1.0),
            (Quantity::ByLaw(b.clone(), a, Law::Hyperbola(8.0, 1.0)), 2.0),
        ] {
            assert_eq!(asked.of(&runs), Ok(expected), "{asked:?}");
        }
        let flat = Quantity::Exponent(vec![(1.0, b.clone()), (2.0, b)]);
        assert!(flat.of(&runs).is_ok_and(|found| found.abs() < 1e-12));
        let none = Quantity::Metric(source("c")).of(&runs);
        assert!(none.is_err_and(|why| why.contains("`c` has no metric `m`")));
    }

    #[test]
    fn exponents_want_different_places() {
        let at = |places: &[f64]| {
            Quantity::Exponent(places.iter().map(|&x| (x, source("a"))).collect()).problem()
        };
        assert!(at(&[1.0, 2.0]).is_none());
        for places in [&[][..], &[1.0], &[3.0, 3.0], &[0.0, 1.0], &[-1.0, 1.0]] {
            assert!(at(places).is_some(), "{places:?}");
        }
    }
}
