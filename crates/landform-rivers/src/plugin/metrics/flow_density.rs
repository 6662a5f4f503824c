//! How much flows through a place.

use landform_graph::Lattice;
use landform_sim::field::stored_values;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_sim::sums::sum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::named;
use crate::plugin::{Flow, refusal};
use crate::water::Place;

/// Flow through a disc: `NAME_flow_density`, the mean flow of its nodes over that of the whole map, 1
/// where flow is as everywhere. Nothing while no water flows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlowDensity {
    /// Name of the place in the column.
    pub name: String,
    /// Its middle: share of the width from west to east, of the height from south to north.
    pub center: [f64; 2],
    /// Its radius.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for FlowDensity {
    fn default() -> Self {
        Self { name: "place".to_owned(), center: [0.5; 2], radius_m: 50.0 }
    }
}

impl FlowDensity {
    fn nodes(&self, lattice: &Lattice) -> Result<Vec<usize>, Problem> {
        let place = Place { center: self.center, radius_m: self.radius_m };
        place.nodes(lattice).map_err(|error| refusal(&error, "center"))
    }
}

impl Metric for FlowDensity {
    type Memory = ();
    const NAME: &'static str = "FlowDensity";

    fn fields(&self) -> Vec<String> {
        vec!["flow".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        super::check_plane(lattice)?;
        self.nodes(lattice).map(|_| ())
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let flow = stored_values::<Flow>(snapshot.world());
        let nodes = self.nodes(snapshot.lattice())?;
        let inside: Vec<f64> = nodes.iter().map(|&node| flow[node]).collect();
        let everywhere = sum(flow) / flow.len() as f64;
        let density = (everywhere > 0.0).then(|| sum(&inside) / nodes.len() as f64 / everywhere);
        Ok(named([(&format!("{}_flow_density", self.name), density)]))
    }
}
