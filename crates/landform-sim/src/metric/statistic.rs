//! A statistic of any field.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Metric;
use crate::parameters::Problem;
use crate::snapshot::Snapshot;
use crate::sums::sum;

/// What is computed of the values of a field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Statistic {
    /// Their sum.
    Sum,
    /// Their mean.
    #[default]
    Mean,
    /// The smallest.
    Minimum,
    /// The largest.
    Maximum,
    /// Their standard deviation (of the whole, not of a sample).
    StandardDeviation,
}

impl Statistic {
    /// The statistic of `values`; `None` when there are none.
    pub fn of(self, values: &[f64]) -> Option<f64> {
        let count = values.len() as f64;
        match self {
            _ if values.is_empty() => None,
            Self::Sum => Some(sum(values)),
            Self::Mean => Some(sum(values) / count),
            Self::Minimum => values.iter().copied().reduce(f64::min),
            Self::Maximum => values.iter().copied().reduce(f64::max),
            Self::StandardDeviation => {
                let mean = sum(values) / count;
                let squares: Vec<f64> = values.iter().map(|value| (value - mean).powi(2)).collect();
                Some((sum(&squares) / count).sqrt())
            }
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Sum => "sum",
            Self::Mean => "mean",
            Self::Minimum => "minimum",
            Self::Maximum => "maximum",
            Self::StandardDeviation => "standard_deviation",
        }
    }
}

/// A statistic of a field, over all nodes.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FieldStatistic {
    /// Name of the field.
    pub field: String,
    /// What is computed.
    pub statistic: Statistic,
}

impl Default for FieldStatistic {
    fn default() -> Self {
        Self { field: "surface".to_owned(), statistic: Statistic::Mean }
    }
}

impl Metric for FieldStatistic {
    type Memory = ();
    const NAME: &'static str = "FieldStatistic";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let unknown = |error: crate::field::UnknownField| {
            Problem::new("field", error.to_string(), "a field of the run")
        };
        let values = snapshot.field(&self.field).map_err(unknown)?;
        let unit = match snapshot.entry(&self.field).map_err(unknown)?.unit {
            "1" => String::new(),
            unit => format!("_{unit}"),
        };
        let name = format!("{}_{}{unit}", self.field, self.statistic.name());
        Ok(self.statistic.of(&values).map(|value| (name, value)).into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::Statistic;

    #[test]
    fn statistics_of_known_values() {
        let values = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        assert_eq!(Statistic::Sum.of(&values), Some(40.0));
        assert_eq!(Statistic::Mean.of(&values), Some(5.0));
        assert_eq!(Statistic::Minimum.of(&values), Some(2.0));
        assert_eq!(Statistic::Maximum.of(&values), Some(9.0));
        assert_eq!(Statistic::StandardDeviation.of(&values), Some(2.0));
        assert_eq!(Statistic::Mean.of(&[]), None);
    }
}
