//! A statistic of any field.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Metric, with_unit};
use crate::field::UnknownField;
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

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Sum => "sum",
            Self::Mean => "mean",
            Self::Minimum => "minimum",
            Self::Maximum => "maximum",
            Self::StandardDeviation => "standard_deviation",
        }
    }
}

/// The nodes that a statistic looks at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Region {
    /// All of them.
    #[default]
    Everywhere,
    /// Those where a field is above a value.
    Above {
        /// Name of the field.
        field: String,
        /// The value.
        value: f64,
    },
    /// Those where a field is below a value.
    Below {
        /// Name of the field.
        field: String,
        /// The value.
        value: f64,
    },
}

impl Region {
    /// The values of nodes in the region, in node order.
    fn of(&self, values: Vec<f64>, snapshot: &Snapshot<'_>) -> Result<Vec<f64>, UnknownField> {
        let within = |field: &str, test: &dyn Fn(f64) -> bool| {
            let field = snapshot.field(field)?;
            let pairs = values.iter().zip(field);
            Ok(pairs.filter(|&(_, each)| test(each)).map(|(&value, _)| value).collect())
        };
        match self {
            Self::Everywhere => Ok(values),
            Self::Above { field, value } => within(field, &|each| each > *value),
            Self::Below { field, value } => within(field, &|each| each < *value),
        }
    }

    /// What follows the name of a statistic of the region.
    fn suffix(&self) -> String {
        match self {
            Self::Everywhere => String::new(),
            Self::Above { field, value } => format!("_where_{field}_above_{value}"),
            Self::Below { field, value } => format!("_where_{field}_below_{value}"),
        }
    }
}

/// A statistic of a field, over all nodes or over those where a field is above or below a value.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FieldStatistic {
    /// Name of the field.
    pub field: String,
    /// What is computed.
    pub statistic: Statistic,
    /// The nodes that are looked at; where there are none, nothing is measured.
    pub over: Region,
}

impl Default for FieldStatistic {
    fn default() -> Self {
        Self { field: "surface".to_owned(), statistic: Statistic::Mean, over: Region::Everywhere }
    }
}

impl Metric for FieldStatistic {
    type Memory = ();
    const NAME: &'static str = "FieldStatistic";

    fn fields(&self) -> Vec<String> {
        let over = match &self.over {
            Region::Everywhere => None,
            Region::Above { field, .. } | Region::Below { field, .. } => Some(field.clone()),
        };
        over.into_iter().chain([self.field.clone()]).collect()
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let unknown =
            |error: UnknownField| Problem::new("field", error.to_string(), "a field of the run");
        let unit = snapshot.entry(&self.field).map_err(unknown)?.unit;
        let values = snapshot.field(&self.field).map_err(unknown)?;
        let values = self.over.of(values, snapshot).map_err(unknown)?;
        let name = with_unit(format!("{}_{}", self.field, self.statistic.name()), unit);
        let name = name + &self.over.suffix();
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
