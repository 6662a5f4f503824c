//! The shape of the passages of a volume in numbers.

use landform_analysis::caves::{CaveField, CaveIndices, CaveNetwork, NetworkShape, OBSERVED};
use landform_analysis::voxels::VoxelSet;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Morphometric indices of the passages, and the shape of the network of their centreline: length,
/// area, volume, density, coverage, porosity, width, and the measures of Collon et al. 2017. The
/// network is that of legs as a surveyor would set them. With `near_m` the three indices that hang on
/// the cave field are also given for the whole rectangle (`cave_rectangle_…`). Nothing is measured
/// without passages.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveShape {
    /// Name of the field.
    pub field: String,
    /// Voxels of at least this value are passages.
    pub at_least: f64,
    /// The cave field is what lies this near to a passage in plan, within the rectangle around the
    /// cave; the whole rectangle when missing.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m", "x-source" = "thesis 5.4.2"))]
    pub near_m: Option<f64>,
}

impl Default for CaveShape {
    fn default() -> Self {
        Self { field: "porosity".to_owned(), at_least: 0.5, near_m: None }
    }
}

impl Metric for CaveShape {
    type Memory = ();
    const NAME: &'static str = "CaveShape";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let values = snapshot
            .field(&self.field)
            .map_err(|error| Problem::new("field", error.to_string(), "a field of the run"))?;
        let lattice = snapshot.lattice();
        let spacing_m = lattice.spacing();
        let set = VoxelSet::at_least(lattice.size(), &values, self.at_least);
        let rectangle = CaveIndices::of(&set, spacing_m, CaveField::Rectangle);
        let network = CaveNetwork::of_passages(&set, spacing_m);
        let (Ok(network), Ok(rectangle)) = (network, rectangle) else {
            return Ok(Vec::new());
        };
        let near =
            self.near_m.map(|near_m| rectangle.within(CaveField::Near(near_m), &set, spacing_m));
        let indices = near.as_ref().unwrap_or(&rectangle);
        let shape = NetworkShape::of(&network.resampled(spacing_m));
        let totals = indices.totals;
        let mut numbers = vec![
            ("length_m", totals.length_m),
            ("area_m2", totals.area_m2),
            ("plan_area_m2", totals.plan_area_m2),
            ("volume_m3", totals.volume_m3),
            ("field_m2", totals.field_m2),
            ("network_density", indices.network_density),
            ("coverage_percent", indices.areal_coverage_percent),
            ("porosity_percent", indices.porosity_percent),
            ("length_to_width", indices.length_to_width),
            ("width_m", indices.width_m),
            ("loops", shape.cyclomatic_number as f64),
            ("parts", shape.components as f64),
        ];
        if near.is_some() {
            numbers.extend([
                ("rectangle_density", rectangle.network_density),
                ("rectangle_coverage_percent", rectangle.areal_coverage_percent),
                ("rectangle_porosity_percent", rectangle.porosity_percent),
            ]);
        }
        let measures = OBSERVED.iter().filter_map(|of| Some((of.name, shape.value(of.name)?)));
        numbers.extend(measures);
        Ok(numbers.into_iter().map(|(name, value)| (format!("cave_{name}"), value)).collect())
    }
}
