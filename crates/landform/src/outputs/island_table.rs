//! The islands of a coast as a table.

use std::io::Write;
use std::path::{Path, PathBuf};

use landform_coast::coast::{Island, islands, spacings};
use landform_coast::plugin::Land;
use landform_graph::Lattice;
use landform_io::{IfExists, write_atomically};
use landform_sim::field::{NodeField, stored_values};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::explain::file_problem;

/// The islands of the field `land` as comma-separated values, the largest first: area, length of
/// the shore (lakes included) and the mean place of the nodes, in metres from the south-western
/// node.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct IslandTable {
    /// File name below the output folder.
    pub file: PathBuf,
    /// When it is written.
    pub when: When,
}

impl Default for IslandTable {
    fn default() -> Self {
        Self { file: "islands.csv".into(), when: When::End }
    }
}

impl FileOutput for IslandTable {
    const NAME: &'static str = "IslandTable";
    const KIND: &'static str = "table";
    const EXTENSIONS: &'static [&'static str] = &["csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![Land::NAME.to_owned()]
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let lattice = snapshot.lattice();
        let mut islands = islands(lattice, stored_values::<Land>(snapshot.world()));
        // Islands of one size stay in node order.
        islands.sort_by_key(|island| std::cmp::Reverse(island.nodes.len()));
        write_atomically(path, IfExists::Replace, |file| table(file, lattice, &islands))
            .map_err(|error| file_problem("file", &error))
    }
}

/// Writes the header and a row for each island.
fn table(file: &mut impl Write, lattice: &Lattice, islands: &[Island]) -> std::io::Result<()> {
    writeln!(file, "island,area_m2,shore_m,x_m,y_m")?;
    let spacing = lattice.spacing();
    for (index, island) in islands.iter().enumerate() {
        let count = island.nodes.len() as f64;
        let places = island.nodes.iter().map(|&node| lattice.position(node as usize));
        let [x, y] = places.fold([0.0; 2], |[x, y], place| [x + place.x, y + place.y]);
        let (area, shore) = (count * spacing * spacing, spacings(island.shore) * spacing);
        writeln!(file, "{},{area:?},{shore:?},{:?},{:?}", index + 1, x / count, y / count)?;
    }
    Ok(())
}
