//! Numbers and statistics of agents.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Metric, Statistic, with_unit};
use crate::agent::{GroupSnapshot, GroupUse};
use crate::code::Code;
use crate::parameters::Problem;
use crate::snapshot::Snapshot;

/// How many agents a group has, and how many were born and died since the run began.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgentCount {
    /// Name of the group.
    pub group: String,
}

impl Metric for AgentCount {
    type Memory = ();
    const NAME: &'static str = "AgentCount";

    fn groups(&self) -> Vec<GroupUse> {
        vec![GroupUse { group: self.group.clone(), quantity: None }]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let tally = group(snapshot, &self.group)?.tally();
        let counts = [("count", tally.members), ("births", tally.births), ("deaths", tally.deaths)];
        let named = |(what, count)| (format!("{}_{what}", self.group), count as f64);
        Ok(counts.map(named).into())
    }
}

/// A statistic of a quantity that the agents of a group know; nothing while there is no agent.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgentStatistic {
    /// Name of the group.
    pub group: String,
    /// Name of the quantity.
    pub quantity: String,
    /// What is computed.
    #[serde(default)]
    pub statistic: Statistic,
}

impl Metric for AgentStatistic {
    type Memory = ();
    const NAME: &'static str = "AgentStatistic";

    fn groups(&self) -> Vec<GroupUse> {
        vec![GroupUse { group: self.group.clone(), quantity: Some(self.quantity.clone()) }]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let unknown = |error: crate::agent::UnknownQuantity| {
            Problem::new("quantity", error.to_string(), "a quantity of the group")
                .code(Code::NotInRun)
        };
        let group = group(snapshot, &self.group)?;
        let (_, unit) = group.listing().quantity(&self.quantity).map_err(unknown)?;
        let values = group.values(&self.quantity).map_err(unknown)?;
        let name = format!("{}_{}_{}", self.group, self.quantity, self.statistic.name());
        let value = self.statistic.of(&values);
        Ok(value.map(|value| (with_unit(name, unit), value)).into_iter().collect())
    }
}

fn group<'a>(snapshot: &Snapshot<'a>, name: &str) -> Result<GroupSnapshot<'a>, Problem> {
    let unknown = |error: crate::agent::UnknownGroup| {
        Problem::new("group", error.to_string(), "a group of the run").code(Code::NotInRun)
    };
    snapshot.group(name).map_err(unknown)
}
