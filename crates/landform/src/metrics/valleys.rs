//! Where valleys begin.

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{FlowDirections, fill_depressions};
use landform_graph::Lattice;
use landform_rivers::erosion::compact_laplacian;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, grid, heights, refusal};

/// Heads of valleys of a field: `valley_heads`, how many. A valley is made of the nodes that drain at
/// least `least_nodes` (D8, depressions filled) on ground that is concave by more than
/// `least_curvature_per_m`; its heads are those that none of its nodes drains to. Ground that diffusion
/// keeps convex has few, whatever it drains. The border is a foot, no valley.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ValleyHeads {
    /// Name of the field.
    pub field: String,
    /// Nodes that the head of a valley drains.
    #[schemars(range(min = 1))]
    pub least_nodes: u32,
    /// Least Laplacian of a valley.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "1/m"))]
    pub least_curvature_per_m: f64,
}

impl Default for ValleyHeads {
    fn default() -> Self {
        Self { field: "bed".to_owned(), least_nodes: 16, least_curvature_per_m: 0.01 }
    }
}

impl Metric for ValleyHeads {
    type Memory = ();
    const NAME: &'static str = "ValleyHeads";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = heights(snapshot, &self.field)?;
        let count = self.heads(snapshot.lattice(), &grid(snapshot)?, &heights);
        let count = count.map_err(|error| refusal(&error))?;
        Ok(columns([("valley_heads", Some(count as f64))]))
    }
}

impl ValleyHeads {
    /// The number of heads.
    fn heads(&self, lattice: &Lattice, grid: &Grid, heights: &[f64]) -> Result<usize, GridError> {
        let directions = FlowDirections::over_filled(grid, &fill_depressions(grid, heights)?)?;
        let cells = directions.contributing_cells();
        let least = self.least_curvature_per_m * lattice.spacing().powi(2);
        let in_valley = |node: usize| {
            let drains = cells[node] >= self.least_nodes && !grid.is_edge(node);
            drains && laplacian(lattice, heights, node) > least
        };
        let mut heads: Vec<bool> = (0..heights.len()).map(in_valley).collect();
        let valleys = heads.clone();
        for node in (0..heights.len()).filter(|&node| valleys[node]) {
            if let Some(next) = directions.receiver(node) {
                heads[next] = false;
            }
        }
        Ok(heads.iter().filter(|&&head| head).count())
    }
}

/// Laplacian of the heights at a node that is not on the border, times the spacing squared.
fn laplacian(lattice: &Lattice, heights: &[f64], node: usize) -> f64 {
    const STEPS: [[isize; 2]; 8] =
        [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];
    let origin = lattice.coordinates(node);
    let around = STEPS.map(|[x, y]| lattice.offset(origin, [x, y, 0]).unwrap_or(node));
    compact_laplacian(heights[node], &around.map(|beside| heights[beside]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    /// A slope with straight valleys along it has a head for each; a convex one has none.
    #[test]
    fn heads_are_counted_where_the_ground_is_concave() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([40, 60], 10.0, Connectivity::Eight, open).unwrap();
        let grid = Grid::new([40, 60], [10.0; 2]).unwrap();
        let heads = |height: &dyn Fn(f64, f64) -> f64| {
            let heights: Vec<f64> = (0..lattice.node_count())
                .map(|node| {
                    let [x, y, _] = lattice.coordinates(node).map(|at| at as f64);
                    height(x, y)
                })
                .collect();
            ValleyHeads::default().heads(&lattice, &grid, &heights).unwrap()
        };
        let valleys = |x: f64, y: f64| 300.0 - 3.0 * y + 4.0 * (x % 10.0 - 5.0).abs();
        assert_eq!(heads(&valleys), 4);
        assert_eq!(heads(&|x: f64, y: f64| 300.0 - 0.03 * y * y - 0.02 * (x - 20.0).powi(2)), 0);
    }
}
