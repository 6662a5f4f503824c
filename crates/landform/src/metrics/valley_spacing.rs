//! How far apart valleys are.

use landform_analysis::valley_spacing;
use landform_graph::Lattice;
use landform_rivers::water::{Side, nodes_beside};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, heights};

/// Spacing of the valleys of a slope that falls to sides of the map: `valley_spacing_m`, along lines
/// parallel to them, and `valley_amplitude_m`, the standard deviation of heights along the lines. A valley
/// is the lowest point between two crests that rise above it by half that deviation. Without valleys, or
/// where the amplitude is below `least_amplitude_m`, there is no spacing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ValleySpacing {
    /// Name of the field.
    pub field: String,
    /// The sides that valleys run to.
    pub feet: Vec<Side>,
    /// Distance of the nearest line to a foot, as a share of the map.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub from: f64,
    /// Distance of the farthest line.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub to: f64,
    /// Least amplitude of valleys.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub least_amplitude_m: f64,
}

impl Default for ValleySpacing {
    fn default() -> Self {
        Self {
            field: "bed".to_owned(),
            feet: vec![Side::South, Side::North],
            from: 0.35,
            to: 0.45,
            least_amplitude_m: 1.0,
        }
    }
}

impl Metric for ValleySpacing {
    type Memory = ();
    const NAME: &'static str = "ValleySpacing";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = heights(snapshot, &self.field)?;
        let measured = self.spacing(snapshot.lattice(), &heights);
        let spacing = measured.filter(|found| found.amplitude_m >= self.least_amplitude_m);
        Ok(columns([
            ("valley_spacing_m", spacing.map(|found| found.spacing_m)),
            ("valley_amplitude_m", measured.map(|found| found.amplitude_m)),
        ]))
    }
}

impl ValleySpacing {
    fn spacing(
        &self,
        lattice: &Lattice,
        heights: &[f64],
    ) -> Option<landform_analysis::ValleySpacing> {
        let mut lines: Vec<Vec<f64>> = Vec::new();
        let mut closed = true;
        for &foot in &self.feet {
            let depth = foot.depth(lattice);
            let last = (depth - 1) as f64;
            let [from, to] = [(self.from * last).ceil(), (self.to * last).floor()];
            for distance in from as usize..=to as usize {
                let nodes = nodes_beside(lattice, foot, distance.min(depth - 1));
                lines.push(nodes.into_iter().map(|node| heights[node]).collect());
            }
            let along = usize::from(!matches!(foot, Side::North | Side::South));
            closed &= lattice.is_periodic(along);
        }
        valley_spacing(lines.iter().map(Vec::as_slice), lattice.spacing(), closed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    /// Valleys every 80 m run to the south; the lines in the middle of the map are level.
    #[test]
    fn spacing_is_that_along_the_side() {
        let boundary = [Boundary::Periodic, Boundary::Open];
        let lattice = Lattice::plane([64, 41], 10.0, Connectivity::Eight, boundary).unwrap();
        let height = |node: usize| {
            let [x, y, _] = lattice.coordinates(node).map(|at| at as f64);
            let depth = if (y - 20.0).abs() > 5.0 { 10.0 } else { 0.0 };
            depth * (std::f64::consts::TAU * x / 8.0).sin()
        };
        let heights: Vec<f64> = (0..lattice.node_count()).map(height).collect();
        let lower = ValleySpacing { from: 0.1, to: 0.3, ..Default::default() };
        let found = lower.spacing(&lattice, &heights).unwrap();
        assert!((found.spacing_m - 80.0).abs() < 1e-9);
        assert!((found.amplitude_m - 50.0_f64.sqrt()).abs() < 1e-6);
        let middle = ValleySpacing { from: 0.45, to: 0.55, ..Default::default() };
        assert_eq!(middle.spacing(&lattice, &heights), None);
        let east = ValleySpacing { feet: vec![Side::East], ..Default::default() };
        // Lines along the crests, which run from north to south, dip once: into the level middle.
        let across = east.spacing(&lattice, &heights).unwrap();
        assert!(across.spacing_m >= 410.0, "{across:?}");
    }
}
