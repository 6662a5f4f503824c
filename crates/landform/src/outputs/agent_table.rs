//! The agents of a group as a table.

use std::io::Write;
use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::{IfExists, write_atomically};
use landform_sim::agent::{GroupSnapshot, GroupUse, UnknownQuantity};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::explain::file_problem;

/// The agents of a group as comma-separated values, one a line and in node order: where each of
/// them stands, since which iteration, and every quantity that it knows.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AgentTable {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the group.
    pub group: String,
    /// When it is written.
    pub when: When,
}

impl Default for AgentTable {
    fn default() -> Self {
        Self { file: "agents.csv".into(), group: String::new(), when: When::End }
    }
}

impl FileOutput for AgentTable {
    const NAME: &'static str = "AgentTable";
    const KIND: &'static str = "table";
    const EXTENSIONS: &'static [&'static str] = &["csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn groups(&self) -> Vec<GroupUse> {
        vec![GroupUse { group: self.group.clone(), quantity: None }]
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let group = snapshot
            .group(&self.group)
            .map_err(|error| Problem::new("group", error.to_string(), "a group of the run"))?;
        let quantities = group.listing().quantities();
        let values = quantities.iter().map(|(name, _)| group.values(name));
        let values = values.collect::<Result<Vec<_>, UnknownQuantity>>();
        let values = values.map_err(|error| Problem::new("group", error.to_string(), ""))?;
        write_atomically(path, IfExists::Replace, |file| {
            table(file, snapshot.lattice(), &group, &values)
        })
        .map_err(|error| file_problem("file", &error))
    }
}

/// Writes the header and a line for each agent.
fn table(
    file: &mut impl Write,
    lattice: &Lattice,
    group: &GroupSnapshot<'_>,
    values: &[Vec<f64>],
) -> std::io::Result<()> {
    let flat = lattice.depth() == 1;
    write!(file, "node,column,row{},since", if flat { "" } else { ",layer" })?;
    for (name, unit) in group.listing().quantities() {
        match unit {
            "1" => write!(file, ",{name}")?,
            unit => write!(file, ",{name}_{unit}")?,
        }
    }
    writeln!(file)?;
    for (index, member) in group.members().iter().enumerate() {
        let [column, row, layer] = lattice.coordinates(member.node);
        write!(file, "{},{column},{row}", member.node)?;
        if !flat {
            write!(file, ",{layer}")?;
        }
        write!(file, ",{}", member.since)?;
        for quantity in values {
            write!(file, ",{:?}", quantity[index])?;
        }
        writeln!(file)?;
    }
    Ok(())
}
