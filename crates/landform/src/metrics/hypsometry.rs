//! How much of a field lies above each height.

use landform_analysis::{self as analysis, HypsometricCurve, HypsometricForm, HypsometricStage};
use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, map_heights};

/// Hypsometry of a field (thesis, section 2.4.1): the integral, Strahler's a/d and z and the
/// misfit of his model curve (equation 2.9), the stage of erosion as one column a stage that is
/// 1 or 0, whether the curve is convex throughout, and the largest difference in relative height
/// from the curve that was measured first. Nothing while the field is flat.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Hypsometry {
    /// Name of the field.
    pub field: String,
}

impl Default for Hypsometry {
    fn default() -> Self {
        Self { field: "surface".to_owned() }
    }
}

/// Relative heights of the first curve that was measured, none before.
#[derive(Clone, Debug, Default)]
pub struct FirstCurve(Vec<f64>);

impl FirstCurve {
    /// Largest difference of a curve from the first one, which the first becomes itself.
    fn change(&mut self, curve: &HypsometricCurve) -> f64 {
        let heights: Vec<f64> = curve.points().map(|[_, height]| height).collect();
        if self.0.is_empty() {
            self.0.clone_from(&heights);
        }
        let differences = heights.iter().zip(&self.0).map(|(now, first)| (now - first).abs());
        differences.fold(0.0, f64::max)
    }
}

impl Keep for FirstCurve {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("heights", &self.0);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        Ok(Self(from.array("heights")?.to_vec()))
    }
}

impl Metric for Hypsometry {
    type Memory = FirstCurve;
    const NAME: &'static str = "Hypsometry";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)
    }

    fn measure(
        &self,
        first: &mut FirstCurve,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let Ok(curve) = HypsometricCurve::new(&map_heights(snapshot, &self.field)?) else {
            return Ok(Vec::new());
        };
        let mut values = hypsometry_columns(&analysis::Hypsometry::new(&curve));
        values.push(("hypsometry_change".to_owned(), first.change(&curve)));
        Ok(values)
    }
}

/// What a curve is in columns, but for its change.
pub(crate) fn hypsometry_columns(found: &analysis::Hypsometry) -> Vec<(String, f64)> {
    let is = |yes: bool| Some(f64::from(u8::from(yes)));
    let stage = |stage: HypsometricStage| is(found.stage == stage);
    columns([
        ("hypsometry_integral", Some(found.integral)),
        ("hypsometry_a_over_d", Some(found.a_over_d)),
        ("hypsometry_z", Some(found.z)),
        ("hypsometry_misfit", Some(found.misfit)),
        ("hypsometry_inequilibrium", stage(HypsometricStage::Inequilibrium)),
        ("hypsometry_equilibrium", stage(HypsometricStage::Equilibrium)),
        ("hypsometry_monadnock", stage(HypsometricStage::Monadnock)),
        ("hypsometry_unusual", stage(HypsometricStage::Unusual)),
        ("hypsometry_convex", is(found.form == HypsometricForm::Convex)),
    ])
}
